#include "symbolic/dof.h"

#include <cmath>

#include "common/bspline.h"
#include "symbolic/expression.h"
#include "symbolic/names.h"
#include "symbolic/quoted.h"

namespace spacetime::symbolic {
namespace {

constexpr int most_spans = 100000;  // of one trajectory; far above the longest motion solved so far (4,096)

bool elaborate_knots(Model& model, NodeId list, std::vector<double>& knots) {
  const Node& node = model.scene.nodes[list];
  for (const NodeId id : node.operands) {
    const auto knot = elaborate_fixed(model, id, "a knot");
    if (!knot) return false;
    freeze(model, knot->expr, model.scene.nodes[id].span, "trajectory");
    if (!knots.empty() && knot->value <= knots.back())
      return report(model, model.scene.nodes[id].span, "knots must rise from one to the next"), false;
    knots.push_back(knot->value);
  }
  if (knots.size() >= 2 && knots.size() <= most_spans + 1) return true;
  report(model, node.span,
         "knots are at least two (the ends of the time) and at most " + std::to_string(most_spans + 1));
  return false;
}

// The wavelets of the boundaries need 8 spans (the pyramid's lowest level); 2^16 spans are within most_spans.
constexpr int least_level = 3, most_level = 16;

}  // namespace

int add_dof(Model& model, const Name& name, std::optional<NodeId> start, const std::optional<Interval>& bounds) {
  const int index = static_cast<int>(model.problem.dofs.size());
  Dof dof;
  dof.name = name.text;
  dof.place = place_of(name.span);
  std::optional<Fixed> value;
  if (start) value = elaborate_fixed(model, *start, "a start value");
  if (value) dof.start = quantity(model, value->expr);
  if (bounds)
    if (const auto both = elaborate_bounds(model, *bounds, value)) dof.lower = both->lower, dof.upper = both->upper;
  model.problem.dofs.push_back(std::move(dof));
  model.dof_trajectory.push_back(model.trajectory);
  model.dof_span.push_back(name.span);
  model.dof_bounds.push_back(bounds ? std::optional(bounds->span) : std::nullopt);
  model.dof_index.try_emplace(name.text, index);
  return index;
}

Coordinate coordinate_of(Model& model, const std::string& name) {
  return {model.graph.input({InputKind::dof, name, 0, 0}), model.graph.input({InputKind::dof, name, 0, 1}),
          model.graph.input({InputKind::dof, name, 0, 2})};
}

void elaborate_trajectory(Model& model, const TrajectoryDeclaration& declaration, const Span& span) {
  using Kind = TrajectoryDeclaration::Kind;
  Trajectories trajectories;
  trajectories.span = span;
  if (declaration.kind == Kind::wavelet) {
    const auto level = elaborate_count(model, declaration.argument, "the level", least_level, most_level);
    if (level) report(model, span, "wavelet trajectories are not built yet: write 'trajectory bspline spans ...'");
  } else if (declaration.kind == Kind::spans) {
    const auto spans = elaborate_count(model, declaration.argument, "the number of spans", 1, most_spans);
    trajectories.spans = spans ? spans->value : 1;
    if (spans) freeze(model, spans->expr, span, "trajectory");
  } else {
    trajectories.span = model.scene.nodes[declaration.argument].span;
    if (!elaborate_knots(model, declaration.argument, trajectories.knots)) trajectories.knots.clear();
  }
  const int index = static_cast<int>(model.trajectories.size());
  model.trajectories.push_back(std::move(trajectories));
  if (declaration.names.empty()) model.trajectory = index;
  for (const int dof : dofs_of(model, declaration.names)) model.dof_trajectory[static_cast<std::size_t>(dof)] = index;
}

void make_bases(Model& model) {
  const double start = model.problem.start, end = model.problem.end;
  std::vector<Basis> bases;
  for (const Trajectories& t : model.trajectories) {
    if (t.knots.empty()) {
      bases.push_back(uniform_basis(start, end, std::max(1, t.spans)));
      continue;
    }
    bases.push_back(basis_on(t.knots));
    const double slack = 1e-9 * (end - start);
    if (!model.time_known) continue;
    if (std::abs(t.knots.front() - start) > slack || std::abs(t.knots.back() - end) > slack)
      report(model, t.span, "knots must begin and end with the scene's time");
  }
  bool reported = false;
  for (std::size_t i = 0; i < model.problem.dofs.size(); ++i) {
    const int trajectory = model.dof_trajectory[i];
    if (trajectory >= 0) {
      model.problem.dofs[i].basis = bases[static_cast<std::size_t>(trajectory)];
    } else if (!reported) {
      report(model, model.dof_span[i],
             quoted(model.problem.dofs[i].name) + " has no trajectory: write 'trajectory bspline spans 24' before it");
      reported = true;
    }
  }
}

}  // namespace spacetime::symbolic
