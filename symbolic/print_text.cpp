#include <cmath>
#include <numbers>
#include <utility>

#include "symbolic/print.h"
#include "symbolic/wrap.h"
#include "symbolic/written_number.h"

namespace spacetime::symbolic {
namespace {

using Kind = Reading::Kind;

// How tightly a text holds together, as the parser climbs.
enum class Level : std::uint8_t {
  anything,
  disjunction,
  conjunction,
  negation,
  relation,
  sum,
  product,
  sign,
  power,
  atom
};

struct Text {
  std::string text;
  Level level = Level::atom;
};

// 2/3 rather than 0.6666666666666666, where that is the same number.
Text number(double value) {
  if (value == std::numbers::e) return {"e", Level::atom};
  const Fraction fraction = fraction_of(std::fabs(value));
  if (fraction.below != 1 && fraction.above / fraction.below == std::fabs(value))
    return {(value < 0 ? "-" : "") + written(fraction.above) + "/" + written(fraction.below), Level::product};
  return {written(value), value < 0 ? Level::product : Level::atom};
}

constexpr double largest_divisor = 360, largest_multiple = 99;  // of pi, as people write angles

// multiple * pi, to the same exact multiple.
Text pi(double multiple) {
  const std::string sign = multiple < 0 ? "-" : "";
  const double size = std::fabs(multiple);
  const Level level = size == 1 && sign.empty() ? Level::atom : Level::product;
  for (double below = 1; below <= largest_divisor; ++below) {
    const double above = std::round(size * below);
    if (above < 1 || above > largest_multiple || above / below != size) continue;
    return {sign + (above == 1 ? "" : written(above) + "*") + "pi" + (below == 1 ? "" : "/" + written(below)), level};
  }
  return {sign + written(size) + "*pi", level};
}

class TextPrinter {
 public:
  TextPrinter(const Reading& reading, const std::string& part);

  const std::vector<std::string>& definitions() const { return definitions_; }  // "s1 = ...", in order
  const std::string& used(std::size_t item) const { return texts_[item].text; }

 private:
  Text made(const Reading::Item& item) const;
  Text sum(const Reading::Item& item) const;
  Text product(const Reading::Item& item) const;
  Text call(const Reading::Item& item) const;
  Text joined(const Reading::Item& item, std::string_view between, Level level, Level left, Level right) const;
  std::string operand(const Reading::Item& item, std::size_t i, Level least) const;

  std::vector<Text> texts_;  // by item; of a part its name
  std::vector<std::string> definitions_;
};

TextPrinter::TextPrinter(const Reading& reading, const std::string& part) : texts_(reading.items.size()) {
  for (const std::size_t item : reading.order) {
    Text text = made(reading.items[item]);
    if (reading.is_part(item)) {
      const std::string name = part + std::to_string(reading.part_number[item] + 1);
      definitions_.push_back(name + " = " + text.text);
      text = {name, Level::atom};
    }
    texts_[item] = std::move(text);
  }
}

std::string TextPrinter::operand(const Reading::Item& item, std::size_t i, Level least) const {
  const Text& text = texts_[item.operands[i].item];
  return text.level < least ? "(" + text.text + ")" : text.text;
}

Text TextPrinter::made(const Reading::Item& item) const {
  switch (item.kind) {
    case Kind::number:
      return number(item.number);
    case Kind::pi:
      return pi(item.number);
    case Kind::input:
      return {item.name + std::string(static_cast<std::size_t>(item.number), '\''), Level::atom};
    case Kind::sum:
      return sum(item);
    case Kind::product:
      return product(item);
    case Kind::negative:
      return {"-" + operand(item, 0, Level::product), Level::product};
    case Kind::power:
      return {operand(item, 0, Level::atom) + "^" + operand(item, 1, Level::power), Level::power};
    case Kind::call:
      return call(item);
    case Kind::less:
      return joined(item, " < ", Level::relation, Level::sum, Level::sum);
    case Kind::less_equal:
      return joined(item, " <= ", Level::relation, Level::sum, Level::sum);
    case Kind::logical_and:
      return joined(item, " and ", Level::conjunction, Level::conjunction, Level::negation);
    case Kind::logical_or:
      return joined(item, " or ", Level::disjunction, Level::disjunction, Level::conjunction);
    case Kind::logical_not:
      return {"not " + operand(item, 0, Level::relation), Level::negation};
  }
  return {};
}

Text TextPrinter::joined(const Reading::Item& item, std::string_view between, Level level, Level left,
                         Level right) const {
  return {operand(item, 0, left).append(between).append(operand(item, 1, right)), level};
}

Text TextPrinter::sum(const Reading::Item& item) const {
  std::string out = operand(item, 0, Level::product);
  for (std::size_t i = 1; i < item.operands.size(); ++i)
    out.append(item.operands[i].opposite ? " - " : " + ").append(operand(item, i, Level::product));
  return {std::move(out), Level::sum};
}

Text TextPrinter::product(const Reading::Item& item) const {
  std::string over, under;
  int factors_under = 0;
  for (std::size_t i = 0; i < item.operands.size(); ++i) {
    const bool below = item.operands[i].opposite;
    std::string& side = below ? under : over;
    if (!side.empty()) side.push_back('*');
    side += operand(item, i, side.empty() && !below ? Level::product : Level::power);
    factors_under += below ? 1 : 0;
  }
  if (factors_under == 1) over.append("/").append(under);
  if (factors_under > 1) over.append("/(").append(under).append(")");
  return {std::move(over), Level::product};
}

Text TextPrinter::call(const Reading::Item& item) const {
  std::string out = item.name + "(";
  for (std::size_t i = 0; i < item.operands.size(); ++i)
    out.append(i > 0 ? ", " : "").append(operand(item, i, Level::anything));
  return {out + ")", Level::atom};
}

}  // namespace

std::string print_text(const Reading& reading, const PrintedNames& names, std::size_t width) {
  const TextPrinter printer(reading, names.part);
  std::string out;
  for (const std::string& definition : printer.definitions()) out += wrapped("let " + definition, width) + "\n";
  const std::string let = "let " + names.whole + " = ";
  if (reading.roots.size() == 1) return out + wrapped(let + printer.used(reading.roots.front()), width) + "\n";
  std::string line = let + "(", lines = line;
  for (std::size_t i = 0; i < reading.roots.size(); ++i) {
    const std::string component = printer.used(reading.roots[i]);
    line += (i > 0 ? ", " : "") + component;
    lines += (i > 0 ? ",\n  " : "\n  ") + wrapped(component, width - 3);
  }
  return out + (line.size() < width ? line : lines) + ")\n";
}

}  // namespace spacetime::symbolic
