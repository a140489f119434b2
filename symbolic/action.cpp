// Actions: how the optimizer is driven.  Those that change the problem are in edit.cpp.
#include "symbolic/action.h"

#include <algorithm>

#include "common/nearest.h"
#include "symbolic/expression.h"
#include "symbolic/names.h"
#include "symbolic/quoted.h"
#include "symbolic/scope.h"

namespace spacetime::symbolic {
namespace {

constexpr int most_iterations = 1000000000;
constexpr int most_starts = 1000000;
constexpr int most_seed = 2147483647;
constexpr int most_halvings = 16;  // of a knot span: 65,536 pieces
constexpr int most_levels = 16;    // of wavelets: 65,536 spans

std::optional<int> count(Model& model, const std::optional<NodeId>& root, std::string_view what, int least, int most) {
  if (!root) return std::nullopt;
  const auto out = elaborate_count(model, *root, what, least, most);
  return out ? std::optional(out->value) : std::nullopt;
}

void set_method(Model& model, const SolveAction& action, Solve& out) {
  if (!action.method) return;
  static const std::vector<std::string> methods{"newton", "sqp92", "bfgs"};
  const auto method = std::find(methods.begin(), methods.end(), action.method->text);
  if (method == methods.end())
    return report(model, action.method->span,
                  "there is no method " + quoted(action.method->text) +
                      suggestion(action.method->text, methods, one_of(methods)));
  out.method = static_cast<Solve::Method>(method - methods.begin());
  out.linear_cg = action.conjugate_gradient;
  if (out.linear_cg && out.method != Solve::Method::sqp92)
    report(model, action.method->span, "'linear cg' is a way to solve the equations of 'sqp92' alone");
}

}  // namespace

std::optional<Fixed> elaborate_above(Model& model, NodeId root, std::string_view what, double least) {
  const auto out = elaborate_fixed(model, root, what);
  if (!out || out->value > least) return out;
  report(model, model.scene.nodes[root].span, std::string(what) + " must be greater than " + text_of(least));
  return std::nullopt;
}

std::optional<Action> action_of(Model& model, const SolveAction& action) {
  Solve out;
  set_method(model, action, out);
  out.iterations = count(model, action.iterations, "the number of iterations", 0, most_iterations);
  out.starts = count(model, action.starts, "the number of starts", 1, most_starts).value_or(1);
  if (action.tolerance)
    if (const auto tolerance = elaborate_above(model, *action.tolerance, "a tolerance"))
      out.tolerance = tolerance->value;
  return out;
}

std::optional<Action> action_of(Model& model, const IterateAction& action) {
  return Iterate{count(model, action.count, "the number of iterations", 0, most_iterations).value_or(0)};
}

std::optional<Action> action_of(Model& model, const WindowAction& action) {
  Window out;
  if (action.time) out.interval = elaborate_window(model, *action.time, "a window");
  out.dofs = dof_names_of(model, action.names);
  return out;
}

std::optional<Action> action_of(Model& model, const RefineAction& action) {
  Refine out;
  model.refined = true;
  if (action.time) out.interval = elaborate_window(model, *action.time, "a refinement");
  out.dofs = dof_names_of(model, action.names);
  out.times = count(model, action.times, "the number of halvings", 1, most_halvings).value_or(1);
  if (action.tolerance)
    if (const auto tolerance = elaborate_above(model, *action.tolerance, "a tolerance"))
      out.automatic = quantity(model, tolerance->expr);
  return out;
}

std::optional<Action> action_of(Model& model, const ShakeAction& action) {
  Shake out;
  const auto amplitude = elaborate_above(model, action.amplitude, "an amplitude");
  out.seed = count(model, action.seed, "the seed", 0, most_seed);
  out.dofs = dof_names_of(model, action.names);
  if (!amplitude) return std::nullopt;
  out.amplitude = quantity(model, amplitude->expr);
  return out;
}

std::optional<Action> action_of(Model& model, const FilterAction& action) {
  Smooth out;
  const auto strength = elaborate_above(model, action.strength, "a strength");
  out.dofs = dof_names_of(model, action.names);
  if (!strength) return std::nullopt;
  out.strength = quantity(model, strength->expr);
  return out;
}

std::optional<Action> action_of(Model& model, const DampAction& action) {
  Damp out;
  const auto limit = elaborate_above(model, action.limit, "a limit");
  out.dofs = dof_names_of(model, action.names);
  if (!limit) return std::nullopt;
  out.limit = quantity(model, limit->expr);
  return out;
}

std::optional<Action> action_of(Model& model, const AdaptAction& action) {
  Adapt out;
  model.refined = true;
  const auto tolerance = elaborate_above(model, action.tolerance, "a tolerance");
  out.levels = count(model, action.levels, "the number of levels", 1, most_levels);
  if (!tolerance) return std::nullopt;
  out.tolerance = quantity(model, tolerance->expr);
  return out;
}

std::optional<Action> action_of(Model& model, const LockAction& action) {
  return Lock{count(model, action.level, "the level", 0, most_levels).value_or(0)};
}

std::optional<Action> action_of(Model&, const ResetAction&) { return Reset{}; }

}  // namespace spacetime::symbolic
