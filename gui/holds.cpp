#include "gui/holds.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "gui/inverse_kinematics.h"

namespace spacetime::gui {
namespace {

constexpr double instant = 1.0 / 60;  // s: so near to a time at which something has to hold, it is in force

bool in_force(const Equation& equation, const Problem& problem, const Question& question, const Curves& curves,
              double time) {
  const std::vector<double> times = times_of(equation.scope, problem, question.constants, curves.dofs);
  if (times.empty()) return false;
  if (equation.scope.kind != Scope::Kind::times)
    return time >= times.front() - instant && time <= times.back() + instant;
  return std::ranges::any_of(times, [&](double t) { return std::abs(t - time) <= instant; });
}

using DofsByCreature = std::map<std::string, std::set<std::string>>;

DofsByCreature dofs_of(const Program& program) {
  DofsByCreature dofs;
  for (const Input& input : program.inputs)
    if (input.kind == InputKind::dof) dofs[creature_of(input.name)].insert(input.name);
  return dofs;
}

// The body that moves by just these degrees of freedom, or else the last of its creature; among those that touch.
const Solid* holder_among(const std::vector<const Solid*>& touching, const Problem& problem, const Figures& figures,
                          const std::pair<const std::string, std::set<std::string>>& tied) {
  for (const Solid* solid : touching) {
    const auto body = std::ranges::find(problem.bodies, figures.name(solid->id), &Body::name);
    if (body == problem.bodies.end()) continue;
    if (moving(problem, *body) == tied.second) return solid;
  }
  return touching.empty() ? nullptr : touching.back();
}

}  // namespace

std::vector<Hold> holds_at(const Question& question, const Problem& problem, const Curves& curves,
                           const Figures& figures, const Picture& picture, double time) {
  std::vector<Hold> holds;
  if (curves.dofs.empty()) return holds;
  std::map<std::string, std::vector<const Solid*>> drawn;  // by creature
  for (const Solid& solid : picture.solids)
    if (solid.id >= 0 && solid.layer == 0) drawn[creature_of(figures.name(solid.id))].push_back(&solid);
  for (const Equation& equation : question.equations) {
    const auto program = problem.programs.find(equation.program);
    const bool ties = !equation.objective && equation.enabled && program != problem.programs.end() &&
                      equation.relation == Constraint::Relation::equal;
    if (!ties) continue;
    const DofsByCreature tied = dofs_of(program->second);
    if (tied.size() < 2 || !in_force(equation, problem, question, curves, time)) continue;
    for (const auto& [one, unused] : tied) {
      if (drawn[one].size() != 1) continue;
      const Solid& held = *drawn[one].front();
      const Box box = bounds(held);
      const float reach = 0.5F * std::max({box.size().x, box.size().y, box.size().z});
      for (const auto& other : tied) {
        if (drawn[other.first].size() < 2) continue;
        std::vector<const Solid*> touching;
        for (const Solid* solid : drawn[other.first])
          if (distance(*solid, box.centre()) <= reach) touching.push_back(solid);
        const Solid* holder = holder_among(touching, problem, figures, other);
        if (!holder) continue;
        const Hold hold{figures.name(holder->id), figures.name(held.id)};
        if (std::ranges::find(holds, hold) == holds.end()) holds.push_back(hold);
      }
    }
  }
  return holds;
}

}  // namespace spacetime::gui
