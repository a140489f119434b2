#include "gui/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

#include "common/assert.h"
#include "protocol/action_json.h"
#include "protocol/json.h"

namespace spacetime::gui {
namespace {

constexpr std::array<std::string_view, 3> methods{"newton", "sqp92", "bfgs"};

Quantity quantity(double number) { return {number, {}, 0}; }

std::string interval(double from, double to) { return "[" + number_text(from) + ", " + number_text(to) + "]"; }

std::string of(const DofNames& dofs) {
  std::string text;
  for (const std::string& dof : dofs) text += (text.empty() ? " of " : ", ") + dof;
  return text;
}

PlacedAction placed(const std::string& action_json) {
  const Json json = parse(action_json, "action");
  PlacedAction action = action_from(Node(json, "action"));
  action.place = {};
  return action;
}

}  // namespace

std::string number_text(double number) {
  SPACETIME_ASSERT(std::isfinite(number));
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  return {digits.data(), end};
}

std::string json_of(const Action& action) {
  Writer to(false);
  write(to, PlacedAction{action, {}});
  return to.take();
}

Words set_words(const std::string& constant, double value) {
  return {"set " + constant + " = " + number_text(value), json_of(SetConstant{constant, quantity(value)})};
}

Words weight_words(const std::string& name, double weight) {
  if (std::isinf(weight)) return {"weight " + name + " = inf", json_of(SetWeight{name, {}})};
  return {"weight " + name + " = " + number_text(weight), json_of(SetWeight{name, quantity(weight)})};
}

Words enable_words(const std::string& name) { return {"enable " + name, json_of(Enable{name})}; }
Words disable_words(const std::string& name) { return {"disable " + name, json_of(Disable{name})}; }
Words delete_words(const std::string& name) { return {"delete " + name, json_of(Delete{name})}; }

Words bound_words(const std::string& dof, double lower, double upper) {
  return {"bound " + dof + " in " + interval(lower, upper), json_of(Bound{dof, quantity(lower), quantity(upper)})};
}

Words window_words(double from, double to, const DofNames& dofs) {
  return {"window " + interval(from, to) + of(dofs), json_of(Window{Interval{quantity(from), quantity(to)}, dofs})};
}

Words window_all_words() { return {"window all", json_of(Window{})}; }

Words refine_words(double from, double to, const DofNames& dofs, int times) {
  Refine refine{Interval{quantity(from), quantity(to)}, dofs, times, {}};
  return {"refine " + interval(from, to) + of(dofs) + (times == 1 ? "" : " times " + std::to_string(times)),
          json_of(refine)};
}

Words refine_auto_words(double tolerance) {
  return {"refine auto tolerance " + number_text(tolerance), json_of(Refine{{}, {}, 1, quantity(tolerance)})};
}

Words shake_words(double amplitude, int seed, const DofNames& dofs) {
  return {"shake amplitude " + number_text(amplitude) + " seed " + std::to_string(seed) + of(dofs),
          json_of(Shake{quantity(amplitude), seed, dofs})};
}

Words filter_words(double strength, const DofNames& dofs) {
  return {"filter strength " + number_text(strength) + of(dofs), json_of(Smooth{quantity(strength), dofs})};
}

Words damp_words(double limit, const DofNames& dofs) {
  return {"damp " + number_text(limit) + of(dofs), json_of(Damp{quantity(limit), dofs})};
}

Words key_words(double time, const std::vector<std::pair<std::string, double>>& keys) {
  std::string line = "key " + number_text(time);
  PullKeys pull{quantity(time), {}};
  for (const auto& [dof, value] : keys) {
    line += (pull.keys.empty() ? ": " : ", ") + dof + " = " + number_text(value);
    pull.keys.push_back({dof, quantity(value)});
  }
  return {line, json_of(pull)};
}

Words control_words(const std::string& dof, int index, double value) {
  return {"control " + dof + " " + std::to_string(index) + " = " + number_text(value),
          json_of(Control{dof, index, quantity(value)})};
}

Words reset_words() { return {"reset", json_of(Reset{})}; }

Words solve_words(const Solve& solve) {
  const Solve usual;
  std::string line = "solve";
  if (solve.method != usual.method) line += " method " + std::string(methods[static_cast<std::size_t>(solve.method)]);
  if (solve.linear_cg) line += (solve.method == usual.method ? " method newton" : "") + std::string(" linear cg");
  if (solve.iterations) line += " iterations " + std::to_string(*solve.iterations);
  if (solve.tolerance != usual.tolerance) line += " tolerance " + number_text(solve.tolerance);
  if (solve.starts != usual.starts) line += " starts " + std::to_string(solve.starts);
  return {line, json_of(solve)};
}

Words iterate_words(int iterations) { return {"iterate " + std::to_string(iterations), json_of(Iterate{iterations})}; }

std::string replace_line(const std::string& name, const std::string& statement) {
  return "replace " + name + ": " + statement;
}
std::string scope_line(const std::string& name, const std::string& scope) { return "scope " + name + " " + scope; }

std::string iterating_line(const std::string& action_json) {
  const PlacedAction action = placed(action_json);
  if (const auto* solve = std::get_if<Solve>(&action.action)) return solve_words(*solve).line;
  if (const auto* iterate = std::get_if<Iterate>(&action.action)) return iterate_words(iterate->iterations).line;
  return {};
}

std::string rest_line(const std::string& action_json, int iterations) {
  const PlacedAction action = placed(action_json);
  if (const auto* iterate = std::get_if<Iterate>(&action.action)) {
    const int rest = iterate->iterations - iterations;
    return rest > 0 ? iterate_words(rest).line : "";
  }
  const auto* solve = std::get_if<Solve>(&action.action);
  if (!solve) return {};
  Solve rest = *solve;
  if (rest.iterations) *rest.iterations -= iterations;
  return rest.iterations && *rest.iterations <= 0 ? "" : solve_words(rest).line;
}

int iterations_in(const std::string& action_json) {
  const PlacedAction action = placed(action_json);
  if (const auto* iterate = std::get_if<Iterate>(&action.action)) return iterate->iterations;
  const auto* solve = std::get_if<Solve>(&action.action);
  return solve ? solve->iterations.value_or(0) : 0;
}

bool is_of_many_starts(const std::string& action_json) {
  const PlacedAction action = placed(action_json);
  const auto* solve = std::get_if<Solve>(&action.action);
  return solve && solve->starts > 1;
}

namespace {

// The optimizer takes `iterate n` for `solve iterations n`.
Action as_solve(Action action) {
  const auto* iterate = std::get_if<Iterate>(&action);
  if (!iterate) return action;
  Solve solve;
  solve.iterations = iterate->iterations;
  return solve;
}

}  // namespace

bool same_action(const std::string& a, const std::string& b) {
  return as_solve(placed(a).action) == as_solve(placed(b).action);
}

std::string brief(std::string_view line) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const auto names = [&](char c) {
    return is_digit(c) || c == '_' || c == '.' || std::isalpha(static_cast<unsigned char>(c));
  };
  std::string text;
  for (std::size_t i = 0; i < line.size();) {
    const bool begins = is_digit(line[i]) && (i == 0 || !names(line[i - 1]));
    double number = 0;
    const char* end = begins ? std::from_chars(&line[i], line.data() + line.size(), number).ptr : &line[i] + 1;
    const std::string_view part = line.substr(i, static_cast<std::size_t>(end - &line[i]));
    const bool whole = std::ranges::all_of(part, is_digit);
    text += begins && !whole ? fmt::format("{:.4g}", number) : std::string(part);
    i += part.size();
  }
  return text;
}

std::string in_one_line(std::string_view text) {
  std::string out;
  for (const char c : trimmed(text)) out += c == '\n' ? std::string("; ") : std::string(1, c);
  return out;
}

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1));
}

}  // namespace spacetime::gui
