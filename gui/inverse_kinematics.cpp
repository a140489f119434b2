#include "gui/inverse_kinematics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "common/bspline.h"

namespace spacetime::gui {
namespace {

// Damping, as a length: errors much larger than it are followed freely, near singular poses nothing jumps.
constexpr double damping = 0.02;      // m
constexpr double difference = 1e-6;   // of a degree of freedom, for its derivative
constexpr double longest_step = 0.3;  // radians or metres an iteration
constexpr int most_iterations = 40;
constexpr double near_enough = 1e-7;  // m

double named(const std::map<std::string, double>& values, const std::string& name) {
  const auto found = values.find(name);
  return found == values.end() ? 0 : found->second;
}

std::vector<double> inputs_at(const Program& program, const Moment& moment) {
  std::vector<double> out;
  for (const Input& input : program.inputs) {
    double value = 0;
    if (input.kind == InputKind::dof && input.derivative == 0) value = named(moment.dofs, input.name);
    if (input.kind == InputKind::constant) value = named(moment.constants, input.name);
    if (input.kind == InputKind::parameter) value = named(moment.parameters, input.name);
    if (input.kind == InputKind::time) value = moment.time;
    out.push_back(value);
  }
  return out;
}

}  // namespace

Moment moment_of(const Motion& motion, const std::map<std::string, double>& constants, double time) {
  Moment moment;
  for (const Trajectory& dof : motion.dofs) moment.dofs[dof.name] = value(dof.basis, dof.coefficients, time);
  moment.constants = constants;
  moment.parameters.insert(motion.parameters.begin(), motion.parameters.end());
  moment.time = time;
  return moment;
}

BodyPose::BodyPose(const Problem& problem, const Body& body)
    : program_(problem.programs.at(body.program)), outputs_(body.outputs), evaluator_(program_) {}

glm::dvec3 BodyPose::place(const Moment& moment, const glm::dvec3& p) const {
  const std::vector<double> inputs = inputs_at(program_, moment);
  std::vector<const double*> pointers;
  for (const double& input : inputs) pointers.push_back(&input);
  const std::vector<std::uint8_t> uniform(inputs.size(), 1);
  std::vector<double> values(evaluator_.outputs(Depth::values));
  evaluator_.run(Depth::values, 1, pointers, uniform, values.data(), 1);
  const auto m = [&](int row, int column) { return values[static_cast<std::size_t>(outputs_[4 * row + column])]; };
  glm::dvec3 out;
  for (int row = 0; row < 3; ++row) out[row] = m(row, 0) * p.x + m(row, 1) * p.y + m(row, 2) * p.z + m(row, 3);
  return out;
}

// All bodies of a creature share a program, so that its inputs tell nothing: the operations are walked back from the
// body's own outputs.
std::set<std::string> moving(const Problem& problem, const Body& body) {
  const Program& program = problem.programs.at(body.program);
  std::vector<char> needed(static_cast<std::size_t>(program.value_count()), 0);
  for (const int output : body.outputs) needed[static_cast<std::size_t>(program.values[output])] = 1;
  const auto first = static_cast<std::size_t>(program.first_operation());
  for (std::size_t k = program.op.size(); k-- > 0;) {
    if (!needed[first + k]) continue;
    const std::array operands{program.a[k], program.b[k], program.c[k]};
    for (int i = 0; i < info(program.op[k]).arity; ++i) needed[static_cast<std::size_t>(operands[i])] = 1;
  }
  std::set<std::string> dofs;
  for (std::size_t i = 0; i < program.inputs.size(); ++i)
    if (needed[i] && program.inputs[i].kind == InputKind::dof) dofs.insert(program.inputs[i].name);
  return dofs;
}

std::map<std::string, double> reach(const Problem& problem, const Body& body, Moment moment, const glm::dvec3& point,
                                    const glm::dvec3& target, const std::vector<std::string>& free,
                                    const std::map<std::string, std::pair<double, double>>& bounds) {
  const BodyPose pose(problem, body);
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const glm::dvec3 here = pose.place(moment, point), error = target - here;
    if (glm::length(error) < near_enough) break;
    std::vector<glm::dvec3> columns;
    for (const std::string& name : free) {
      Moment beside = moment;
      beside.dofs[name] += difference;
      columns.push_back((pose.place(beside, point) - here) / difference);
    }
    // dq = J' (J J' + d^2 1)^-1 error
    glm::dmat3 square(damping * damping);
    for (const glm::dvec3& c : columns) square += glm::outerProduct(c, c);
    const glm::dvec3 pull = glm::inverse(square) * error;
    double longest = 0;
    for (const glm::dvec3& c : columns) longest = std::max(longest, std::abs(glm::dot(c, pull)));
    if (longest < 1e-12) break;
    const double length = std::min(1.0, longest_step / longest);
    for (std::size_t i = 0; i < free.size(); ++i) {
      double& value = moment.dofs[free[i]];
      value += length * glm::dot(columns[i], pull);
      if (const auto bound = bounds.find(free[i]); bound != bounds.end())
        value = std::clamp(value, bound->second.first, bound->second.second);
    }
  }
  return moment.dofs;
}

}  // namespace spacetime::gui
