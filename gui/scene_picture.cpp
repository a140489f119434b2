#include "gui/scene_picture.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "common/sample.h"
#include "gui/inverse_kinematics.h"
#include "gui/render/palette.h"

namespace spacetime::gui {
namespace {

constexpr int trail_points = 160;
constexpr int ghosts_shown = 5;
constexpr double longest_arrow = 0.5;  // m, of the largest force over the whole motion

void add_trails(const State& state, const Problem& problem, const Figures& figures, const Motion& motion,
                Picture& picture) {
  const std::vector<double> times = even_times(problem.start, problem.end, trail_points);
  const Colour ink = palette(picture.theme).faint;
  std::set<std::string> hands;  // the last part of each creature, and every bead
  for (std::size_t id = 0; id < figures.size(); ++id) hands.insert(creature_of(figures.name(static_cast<int>(id))));
  const auto points = figures.points();
  for (const std::string& hand : hands)
    if (std::ranges::find(points, hand) != points.end())
      picture.lines.push_back({figures.way(motion, hand, times), ink, 1.5F, 0.7F, false});
  for (const std::string& name : state.selection.expressions)
    if (std::ranges::find(points, name) != points.end())
      picture.lines.push_back(
          {figures.way(motion, name, times), figures.colour_of_point(name, picture.theme), 2, 0.9F, false});
}

// The first body that a degree of freedom moves: the one behind its joint.
const Body* moved_by(const Problem& problem, const std::string& dof) {
  for (const Body& body : problem.bodies) {
    // A dof beside those of the body's own creature would move others as well.
    if (creature_of(body.name) == creature_of(dof) && moving(problem, body).contains(dof)) return &body;
  }
  return nullptr;
}

// Where a joint is and about what it turns (or along what it slides), from how its body moves with it.
struct Joint {
  glm::dvec3 place{0}, axis{0};
  bool turns = false;
};
Joint joint_of(const Problem& problem, const Body& body, const Moment& moment, const std::string& dof) {
  constexpr double difference = 1e-5;
  Moment beside = moment;
  beside.dofs[dof] += difference;
  const BodyPose pose(problem, body);
  const auto velocity = [&](const glm::dvec3& point) {
    return (pose.place(beside, point) - pose.place(moment, point)) / difference;
  };
  const glm::dvec3 origin = pose.place(moment, glm::dvec3(0)), slide = velocity(glm::dvec3(0));
  glm::dvec3 turn(0);
  for (int k = 0; k < 3; ++k) {
    glm::dvec3 unit(0);
    unit[k] = 1;
    const glm::dvec3 direction = pose.place(moment, unit) - origin;
    turn += 0.5 * glm::cross(direction, velocity(unit) - slide);
  }
  Joint joint{origin, slide, glm::length(turn) > 0.5};
  if (joint.turns) {
    joint.axis = turn;
    joint.place = origin + glm::cross(turn, slide) / glm::dot(turn, turn);
  }
  return joint;
}

void add_forces(const State& state, const Problem& problem, const Question& question, const Motion& motion,
                Picture& picture) {
  if (!state.samples || state.samples->times.empty()) return;
  const Moment moment = moment_of(motion, question.constants, state.playback.time);
  double largest_torque = 1e-9, largest_force = 1e-9;
  struct Found {
    Joint joint;
    double value;
  };
  std::vector<Found> found;
  for (const Dof& dof : problem.dofs) {
    const auto samples = state.samples->values.find(dof.name + ".force");
    const Body* body = moved_by(problem, dof.name);
    if (samples == state.samples->values.end() || !body) continue;
    const Joint joint = joint_of(problem, *body, moment, dof.name);
    double& largest = joint.turns ? largest_torque : largest_force;
    for (const auto& row : samples->second)
      if (std::isfinite(row[0])) largest = std::max(largest, std::abs(row[0]));
    found.push_back({joint, between(*state.samples, samples->second, state.playback.time).front()});
  }
  const Colour colour = palette(picture.theme).soft;
  for (const Found& f : found) {
    if (!std::isfinite(f.value)) continue;
    const glm::vec3 place(f.joint.place), axis(f.joint.axis);
    if (f.joint.turns) {
      const auto angle = static_cast<float>(4.7 * f.value / largest_torque);
      if (std::abs(angle) > 0.02F) picture.torques.push_back({place, axis, angle, 0.12F, colour, 3});
    } else {
      const glm::vec3 tip = place + axis * static_cast<float>(longest_arrow * f.value / largest_force);
      if (glm::length(tip - place) > 0.01F) picture.arrows.push_back({place, tip, colour, 3});
    }
  }
}

// What a constraint speaks of: the creature declared last among those of its degrees of freedom.
std::string subject_of(const Problem& problem, const Program& program) {
  std::string subject;
  std::size_t latest = 0;
  for (const Input& input : program.inputs) {
    if (input.kind != InputKind::dof) continue;
    const auto index =
        static_cast<std::size_t>(std::ranges::find(problem.dofs, input.name, &Dof::name) - problem.dofs.begin());
    if (index >= latest) subject = creature_of(input.name), latest = index;
  }
  return subject;
}

void add_marks(const State& state, const Problem& problem, const Question& question, const Residuals& residuals,
               const Figures& figures, const Motion& motion, Picture& picture) {
  const auto points = figures.points();
  for (std::size_t e = 0; e < question.equations.size(); ++e) {
    const Equation& equation = question.equations[e];
    const auto program = problem.programs.find(equation.program);
    if (equation.objective || program == problem.programs.end()) continue;
    const std::string subject = subject_of(problem, program->second);
    if (std::ranges::find(points, subject) == points.end()) continue;
    const bool selected = state.selection.constraint == equation.name;
    if (residuals[e].size() > 60 && !selected) continue;  // a crowd tells nothing
    std::vector<double> times;
    for (const Residual& r : residuals[e]) times.push_back(r.time);
    if (times.empty()) continue;
    const auto places = figures.way(motion, subject, times);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double off = equation.relation == Constraint::Relation::equal ? std::abs(residuals[e][i].value)
                                                                          : std::max(0.0, residuals[e][i].value);
      const Mark::Kind kind = !equation.enabled ? Mark::Kind::disabled
                              : equation.weight ? Mark::Kind::soft
                              : off > met       ? Mark::Kind::violated
                                                : Mark::Kind::met;
      picture.marks.push_back({kind, places[i], selected ? 13.0F : 6.0F});
    }
  }
}

}  // namespace

Motion motion_of(const State& state, bool posed) {
  Motion motion;
  if (!state.curves) return motion;
  motion.dofs = state.curves->dofs;
  motion.constants = state.curves->constants;
  motion.parameters = state.curves->parameters;
  if (!motion.dofs.empty()) {
    motion.start = motion.dofs.front().basis.knots.front();
    motion.end = motion.dofs.front().basis.knots.back();
  }
  if (!posed || !state.pose) return motion;
  for (Trajectory& dof : motion.dofs) {
    const auto value = state.pose->values.find(dof.name);
    if (value != state.pose->values.end()) std::ranges::fill(dof.coefficients, value->second);
  }
  return motion;
}

Picture picture_of(const State& state, const Question& question, const Residuals& residuals, const Figures& figures,
                   const Shows& shows) {
  Picture picture;
  picture.theme = state.dark ? Theme::dark : Theme::light;
  if (!state.scene || !state.scene->problem || !state.curves) return picture;
  const Problem& problem = *state.scene->problem;
  Motion motion = motion_of(state, false);
  motion.constants.assign(question.constants.begin(), question.constants.end());
  const double time = state.playback.time;
  if (state.pose) {
    Motion posed = motion_of(state, true);
    posed.constants = motion.constants;
    for (Solid solid : figures.solids(posed, time, picture.theme)) picture.solids.push_back(solid);
    for (Solid solid : figures.solids(motion, time, picture.theme)) {  // what the pose leaves
      solid.opacity = 0.25F;
      solid.layer = 1;
      solid.id = -1;
      picture.solids.push_back(solid);
    }
  } else {
    picture.solids = figures.solids(motion, time, picture.theme);
  }
  int layer = 1;
  const auto add_ghost = [&](const Motion& of, double when, float opacity) {
    ++layer;
    for (Solid solid : figures.solids(of, when, picture.theme)) {
      solid.opacity = opacity;
      solid.layer = layer;
      solid.id = -1;
      picture.solids.push_back(solid);
    }
  };
  if (state.ghost) {
    Motion before = motion;
    before.dofs = state.ghost->dofs;
    before.parameters = state.ghost->parameters;
    for (auto& [name, value] : before.constants)
      for (const auto& [was, then] : state.ghost->constants)
        if (was == name) value = then;
    add_ghost(before, time, 0.35F);
  }
  for (const double pin : state.pins)
    if (pin >= problem.start && pin <= problem.end) add_ghost(motion, pin, 0.30F);
  if (shows.ghosts && !state.playback.playing)
    for (int k = 0; k < ghosts_shown; ++k)
      add_ghost(motion, problem.start + (problem.end - problem.start) * k / (ghosts_shown - 1), 0.10F);
  if (shows.trails) add_trails(state, problem, figures, motion, picture);
  if (shows.forces) add_forces(state, problem, question, motion, picture);
  if (shows.marks) add_marks(state, problem, question, residuals, figures, motion, picture);
  return picture;
}

}  // namespace spacetime::gui
