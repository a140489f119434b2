#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "symbolic/print.h"
#include "symbolic/written_number.h"

namespace spacetime::symbolic {
namespace {

using Kind = Reading::Kind;

enum class Level : std::uint8_t { anything, disjunction, conjunction, negation, relation, sum, product, power, atom };

struct Formula {
  std::string latex;
  Level level = Level::atom;
};

constexpr std::size_t longest_line = 110;  // characters of LaTeX in a sum before it is broken: about a page's width

std::string bracketed(const std::string& latex) { return "\\left(" + latex + "\\right)"; }

std::string upright(std::string_view text) {
  std::string out = "\\mathrm{";
  for (const char c : text) out += c == '_' ? std::string("\\_") : std::string(1, c);
  return out + "}";
}

bool is_greek(std::string_view name) {
  static constexpr std::array<std::string_view, 20> letters{
      "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "kappa", "lambda",
      "mu",    "nu",   "xi",    "rho",   "sigma",   "tau",  "phi", "chi",   "psi",   "omega"};
  return std::ranges::find(letters, name) != letters.end();
}

// A symbol, what stands below it, and a dot for each derivative:  X of ball, q of arm.elbow, mu, x of 1, BasketX.
std::string symbol(std::string_view name, int dots) {
  std::string letter, below;
  const std::size_t dot = name.rfind('.');
  const std::string_view last = dot == std::string_view::npos ? name : name.substr(dot + 1);
  const bool numbered = last.size() > 1 && std::isalpha(static_cast<unsigned char>(last[0])) != 0 &&
                        std::ranges::all_of(last.substr(1), [](unsigned char c) { return std::isdigit(c) != 0; });
  if (last.size() == 1 || numbered) {
    letter = last.substr(0, 1);
    below = last.substr(1);
  } else if (is_greek(last)) {
    letter = "\\" + std::string(last);
  } else if (dot != std::string_view::npos) {
    letter = "q";
    below = upright(name);
  } else {
    letter = upright(last);
  }
  if (dot != std::string_view::npos && letter != "q")
    below += (below.empty() ? "" : ",") + upright(name.substr(0, dot));
  if (dot != std::string_view::npos && letter == "q" && below.empty()) below = upright(name);
  if (dots > 0) letter = (dots == 1 ? "\\dot{" : "\\ddot{") + letter + "}";
  return below.empty() ? letter : letter + "_{" + below + "}";
}

Formula number(double value) {
  if (value == std::numbers::e) return {"\\mathrm{e}", Level::atom};
  const Fraction fraction = fraction_of(std::fabs(value));
  if (fraction.below != 1)
    return {(value < 0 ? "-\\frac{" : "\\frac{") + written(fraction.above) + "}{" + written(fraction.below) + "}",
            Level::product};
  std::string digits = written(value);
  const std::size_t e = digits.find('e');
  if (e == std::string::npos) return {digits, value < 0 ? Level::product : Level::atom};
  const std::string exponent = std::to_string(std::stoi(digits.substr(e + 1)));
  return {digits.substr(0, e) + " \\cdot 10^{" + exponent + "}", Level::product};
}

class LatexPrinter {
 public:
  LatexPrinter(const Reading& reading, const std::string& part) : reading_(reading), formulas_(reading.items.size()) {
    for (const std::size_t item : reading.order) {
      Formula formula = made(reading.items[item]);
      if (reading.is_part(item)) {
        const std::string name = part + "_{" + std::to_string(reading.part_number[item] + 1) + "}";
        definitions_.push_back(name + " &= " + formula.latex);
        formula = {name, Level::atom};
      }
      formulas_[item] = std::move(formula);
    }
  }

  const std::vector<std::string>& definitions() const { return definitions_; }
  const std::string& used(std::size_t item) const { return formulas_[item].latex; }

 private:
  Formula made(const Reading::Item& item) const;
  Formula sum(const Reading::Item& item) const;
  Formula product(const Reading::Item& item) const;
  Formula power(const Reading::Item& item) const;
  Formula call(const Reading::Item& item) const;
  Formula joined(const Reading::Item& item, std::string_view between, Level level, Level left, Level right) const {
    return {operand(item, 0, left).append(between).append(operand(item, 1, right)), level};
  }
  const std::string& plain(const Reading::Item& item, std::size_t i) const {
    return formulas_[item.operands[i].item].latex;
  }
  std::string operand(const Reading::Item& item, std::size_t i, Level least) const {
    const Formula& formula = formulas_[item.operands[i].item];
    return formula.level < least ? bracketed(formula.latex) : formula.latex;
  }

  const Reading& reading_;
  std::vector<Formula> formulas_;  // by item; of a part its name
  std::vector<std::string> definitions_;
};

Formula LatexPrinter::made(const Reading::Item& item) const {
  switch (item.kind) {
    case Kind::number:
      return number(item.number);
    case Kind::pi:
      return item.number == 1 ? Formula{"\\pi", Level::atom}
                              : Formula{number(item.number).latex + " \\pi", Level::product};
    case Kind::input:
      return {symbol(item.name, static_cast<int>(item.number)), Level::atom};
    case Kind::sum:
      return sum(item);
    case Kind::product:
      return product(item);
    case Kind::negative:
      return {"-" + operand(item, 0, Level::product), Level::product};
    case Kind::power:
      return power(item);
    case Kind::call:
      return call(item);
    case Kind::less:
      return joined(item, " < ", Level::relation, Level::sum, Level::sum);
    case Kind::less_equal:
      return joined(item, " \\le ", Level::relation, Level::sum, Level::sum);
    case Kind::logical_and:
      return joined(item, " \\land ", Level::conjunction, Level::conjunction, Level::negation);
    case Kind::logical_or:
      return joined(item, " \\lor ", Level::disjunction, Level::disjunction, Level::conjunction);
    case Kind::logical_not:
      return {"\\lnot " + operand(item, 0, Level::atom), Level::negation};
  }
  return {};
}

Formula LatexPrinter::sum(const Reading::Item& item) const {
  std::string out = operand(item, 0, Level::product);
  for (std::size_t i = 1; i < item.operands.size(); ++i)
    out.append(item.operands[i].opposite ? " - " : " + ").append(operand(item, i, Level::product));
  return {std::move(out), Level::sum};
}

Formula LatexPrinter::product(const Reading::Item& item) const {
  const auto under = [&](const Reading::Operand& operand) { return operand.opposite; };
  const auto below = std::ranges::count_if(item.operands, under);
  const auto above = static_cast<std::ptrdiff_t>(item.operands.size()) - below;
  std::array<std::string, 2> sides;
  for (std::size_t i = 0; i < item.operands.size(); ++i) {
    const bool is_below = item.operands[i].opposite;
    std::string& side = sides[is_below ? 1 : 0];
    const bool alone = below > 0 && (is_below ? below : above) == 1;
    // Two numbers side by side would be read as one.
    const bool digit_next = reading_.items[item.operands[i].item].kind == Kind::number ||
                            reading_.items[item.operands[i].item].kind == Kind::power;
    if (!side.empty()) side += digit_next ? " \\cdot " : " \\, ";
    side += operand(item, i, alone ? Level::anything : Level::power);
  }
  if (below == 0) return {sides[0], Level::product};
  return {"\\frac{" + sides[0] + "}{" + sides[1] + "}", Level::product};
}

Formula LatexPrinter::power(const Reading::Item& item) const {
  // A dotted or subscripted symbol stands as it is; everything longer in brackets.
  return {"{" + operand(item, 0, Level::atom) + "}^{" + plain(item, 1) + "}", Level::power};
}

Formula LatexPrinter::call(const Reading::Item& item) const {
  const std::string& x = plain(item, 0);
  if (item.name == "sqrt") return {"\\sqrt{" + x + "}", Level::atom};
  if (item.name == "abs") return {"\\left|" + x + "\\right|", Level::atom};
  if (item.name == "if")
    return {"\\begin{cases} " + plain(item, 1) + " & \\text{if } " + x + " \\\\ " + plain(item, 2) +
                " & \\text{otherwise} \\end{cases}",
            Level::sum};
  if (item.name == "at") return {"\\left." + x + "\\right|_{t = " + plain(item, 1) + "}", Level::product};
  if (item.name == "integral") {
    const std::string limits =
        item.operands.size() > 1 ? "_{" + plain(item, 1) + "}^{" + plain(item, 2) + "}" : std::string();
    return {"\\int" + limits + " " + operand(item, 0, Level::product) + " \\, \\mathrm{d}t", Level::product};
  }
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 3> inverses{
      {{"asin", "\\arcsin"}, {"acos", "\\arccos"}, {"atan", "\\arctan"}}};
  static constexpr std::array<std::string_view, 10> known{"sin",  "cos", "tan", "sinh", "cosh",
                                                          "tanh", "exp", "log", "min",  "max"};
  std::string name = "\\operatorname{" + item.name + "}";
  if (std::ranges::find(known, item.name) != known.end()) name = "\\" + item.name;
  for (const auto& [ours, theirs] : inverses)
    if (item.name == ours) name = theirs;
  std::string arguments = x;
  for (std::size_t i = 1; i < item.operands.size(); ++i) arguments += ", " + plain(item, i);
  return {name + bracketed(arguments), Level::atom};
}

// Broken behind terms that stand in no brackets; a further line begins with the sign, as formulas do.
std::string broken(const std::string& line) {
  std::string out;
  int depth = 0;
  std::size_t length = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const std::string_view rest = std::string_view(line).substr(i);
    if (line[i] == '{' || rest.starts_with("\\left") || rest.starts_with("\\begin")) ++depth;
    if (line[i] == '}' || rest.starts_with("\\right") || rest.starts_with("\\end")) --depth;
    const bool is_break = depth == 0 && (rest.starts_with(" + ") || rest.starts_with(" - "));
    if (is_break && length > longest_line) {
      out += " \\\\\n  &\\quad {}";
      length = 0;
    }
    out += line[i];
    ++length;
  }
  return out;
}

}  // namespace

std::string print_latex(const Reading& reading, const std::string& name, const std::string& part) {
  const LatexPrinter printer(reading, part);
  std::vector<std::string> lines = printer.definitions();
  for (std::size_t i = 0; i < reading.roots.size(); ++i) {
    const std::string index = reading.roots.size() > 1 ? "_{" + std::to_string(i + 1) + "}" : "";
    lines.push_back(upright(name) + index + " &= " + printer.used(reading.roots[i]));
  }
  std::string out = "% needs \\usepackage{amsmath}\n\\[\n\\begin{aligned}\n";
  for (std::size_t i = 0; i < lines.size(); ++i)
    out += "  " + broken(lines[i]) + (i + 1 < lines.size() ? " \\\\\n" : "\n");
  return out + "\\end{aligned}\n\\]\n";
}

}  // namespace spacetime::symbolic
