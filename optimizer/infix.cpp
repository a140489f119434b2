#include "optimizer/infix.h"

#include <fmt/format.h>

#include <array>
#include <string_view>

namespace spacetime::optimizer {
namespace {

constexpr std::size_t longest = 60;  // characters
constexpr int deepest = 8;           // operations within operations, so that recursion is bounded

// How tightly an expression binds; what binds less stands in parentheses.
enum Binding { logic, comparison, sum, product, sign, power, atom };

struct Text {
  std::string text;
  Binding binding = atom;
};

std::string within(const Text& part, Binding least) { return part.binding < least ? "(" + part.text + ")" : part.text; }

class Printer {
 public:
  Printer(const Problem& problem, const Program& program) : problem_(problem), program_(program) {}

  Text text(int value, int depth) const {
    const int inputs = static_cast<int>(program_.inputs.size());
    if (value < inputs) return {input(program_.inputs[value])};
    if (value < program_.first_operation()) {
      const double number = program_.numbers[value - inputs];
      return {fmt::format("{:.4g}", number), number < 0 ? sign : atom};
    }
    if (depth == 0) return {"..."};
    return operation(value - program_.first_operation(), depth - 1);
  }

 private:
  std::string input(const Input& input) const {
    switch (input.kind) {
      case InputKind::dof:
      case InputKind::signal:
        return input.name + std::string(input.derivative, '\'');
      case InputKind::constant:
      case InputKind::parameter:
        return input.name;
      case InputKind::functional:
        return problem_.functionals[input.index].kind == Functional::Kind::integral ? "integral(...)" : "at(...)";
      case InputKind::time:
        return "t";
      case InputKind::multiplier:
        break;
    }
    return "multiplier";
  }

  // A sum, with a minus where its second part begins with one.
  static Text sum_of(const Text& first, const Text& second) {
    if (second.text.starts_with('-')) return {within(first, sum) + " - " + second.text.substr(1), sum};
    return {within(first, sum) + " + " + within(second, sum), sum};
  }

  Text product_of(int a, int b, int depth) const {
    if (a == b) return {within(text(a, depth), atom) + "^2", power};
    return {within(text(a, depth), product) + "*" + within(text(b, depth), product), product};
  }

  Text operation(int index, int depth) const {
    const int a = program_.a[index], b = program_.b[index], c = program_.c[index];
    const auto operand = [&](int value) { return text(value, depth); };
    const auto between = [&](const char* sign_between, Binding binding, Binding right) {
      return Text{within(operand(a), binding) + sign_between + within(operand(b), right), binding};
    };
    const auto function = [&](std::string_view name) -> Text {
      std::string arguments = operand(a).text;
      if (info(program_.op[index]).arity > 1) arguments += ", " + operand(b).text;
      if (info(program_.op[index]).arity > 2) arguments += ", " + operand(c).text;
      return {fmt::format("{}({})", name, arguments)};
    };
    switch (const Op op = program_.op[index]; op) {
      case Op::add:
        return sum_of(operand(a), operand(b));
      case Op::multiply_add:
        return sum_of(product_of(a, b, depth), operand(c));
      case Op::subtract:
        return between(" - ", sum, product);
      case Op::multiply:
        return product_of(a, b, depth);
      case Op::divide:
        return between("/", product, sign);
      case Op::negate:
        return {"-" + within(operand(a), product), sign};
      case Op::power:
        return {within(operand(a), atom) + "^" + within(operand(b), power), power};
      case Op::less:
        return between(" < ", comparison, sum);
      case Op::less_equal:
        return between(" <= ", comparison, sum);
      case Op::logical_and:
        return {within(operand(a), comparison) + " and " + within(operand(b), comparison), logic};
      case Op::logical_or:
        return {within(operand(a), comparison) + " or " + within(operand(b), comparison), logic};
      case Op::logical_not:
        return {"not " + within(operand(a), atom), logic};
      case Op::select:
        return function("if");
      default:
        return function(info(op).name);  // as the scene language calls it
    }
  }

  const Problem& problem_;
  const Program& program_;
};

}  // namespace

std::string infix(const Problem& problem, const Program& program, int value) {
  const Printer printer(problem, program);
  std::string text;
  for (int depth = deepest; depth > 0; --depth) {
    text = printer.text(value, depth).text;
    if (text.size() <= longest) break;
  }
  return text;
}

}  // namespace spacetime::optimizer
