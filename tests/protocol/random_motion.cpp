#include <algorithm>
#include <cmath>
#include <utility>

#include "protocol/checkpoint_json.h"
#include "tests/protocol/random_parts.h"

namespace spacetime::examples {
namespace {

Checkpoint random_checkpoint(std::mt19937& random, const Motion& motion) {
  const auto value = [&] { return random_number(random); };
  const auto size = [&] { return std::abs(random_number(random)); };
  const auto list = [&](auto element) {
    std::vector<decltype(element())> result;
    for (int i = below(random, 4); i > 0; --i) result.push_back(element());
    return result;
  };
  Checkpoint checkpoint;
  checkpoint.problem = random_name(random, "problem", 1);
  if (coin(random)) checkpoint.progress = {below(random, 9), below(random, motion.iterations + 1)};
  checkpoint.declared = below(random, 9);
  checkpoint.edits = list([&]() -> Action { return Enable{random_name(random, "statement", 1)}; });
  if (coin(random)) checkpoint.window = {std::nullopt, {random_name(random, "q", 1)}};
  if (coin(random)) checkpoint.damping = {{random_name(random, "q", 1), 0.5}};
  checkpoint.shakes = below(random, 9);
  if (coin(random)) checkpoint.start = {motion.dofs, motion.parameters};
  checkpoint.judged = coin(random);
  checkpoint.functionals = list(value);
  if (coin(random)) checkpoint.outside = {value(), list(value), list(value)};
  checkpoint.step = value();
  checkpoint.last_shift = value();
  checkpoint.pivoted = below(random, 9);
  const auto flag = [&] { return below(random, 2); };
  checkpoint.newton = {size(),       list(size), list(size),
                       list(size),   list(size), coin(random),
                       list(flag),   list(flag), list([&] { return Checkpoint::Newton::Entry{value(), value()}; }),
                       size(),       size(),     size(),
                       size(),       size(),     1.5,
                       coin(random), size(),     below(random, 9),
                       list(value)};
  if (coin(random)) {
    checkpoint.sqp92 = {list(value), list(size)};
  } else if (coin(random)) {
    checkpoint.bfgs = {list(value)};
  }
  return checkpoint;
}

}  // namespace

Motion random_motion(std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto value = [&] { return random_number(random); };
  Motion motion;
  motion.start = below(random, 100) - 50.25;
  motion.end = motion.start + 0.1 + below(random, 100);
  motion.status = static_cast<Status>(below(random, 4));
  motion.message = random_name(random, "message ", 1);
  motion.iterations = below(random, 1000);
  motion.seconds = {value(), value(), value()};
  motion.objective = value();
  motion.violation = value();
  for (std::size_t i = 0; i < random() % 4; ++i) motion.terms.emplace_back(random_name(random, "term ", i), value());
  for (std::size_t i = 0; i < random() % 4; ++i) {
    motion.violations.push_back({random_name(random, "constraint ", i), value(), {}, below(random, 3)});
    if (coin(random)) motion.violations.back().time = value();
  }
  for (std::size_t i = 0; i < random() % 3; ++i) {
    Multipliers cost{random_name(random, "constraint ", i), below(random, 3), {}, {}};
    for (int k = below(random, 4); k > 0; --k) cost.times.push_back(value());
    const std::size_t components = 1 + random() % 3, rows = std::max<std::size_t>(cost.times.size(), 1);
    for (std::size_t k = 0; k < rows; ++k) std::ranges::generate(cost.values.emplace_back(components), value);
    motion.multipliers.push_back(std::move(cost));
  }
  for (std::size_t i = 0; i < random() % 4; ++i) {
    Trajectory dof{random_name(random, "q", i), {random_knots(random, motion.start, motion.end)}, {}};
    for (int k = 0; k < dof.basis.size(); ++k) dof.coefficients.push_back(value());
    motion.dofs.push_back(std::move(dof));
  }
  for (std::size_t i = 0; i < random() % 9; ++i) motion.constants.emplace_back(random_name(random, "c", i), value());
  for (std::size_t i = 0; i < random() % 3; ++i) motion.parameters.emplace_back(random_name(random, "p", i), value());
  for (int i = below(random, 4); i > 0; --i) {
    motion.record.push_back({below(random, 1000), value(), {}, value(), value(), value(), value(), value()});
    for (int k = below(random, 3); k > 0; --k)
      motion.record.back().terms.emplace_back("term " + std::to_string(k), value());
  }
  for (int i = below(random, 3); i > 0; --i) motion.minima.push_back({value(), {below(random, 9), 7}, motion.dofs});
  if (!motion.dofs.empty() && coin(random)) {
    Problem problem;
    Program pose;
    pose.inputs = {dof(motion.dofs.front().name, below(random, 3)), time()};
    for (int k = 0; k < 12; ++k) pose.values.push_back(below(random, 2));
    motion.bodies.push_back({Body::Shape::sphere,
                             random_name(random, "body", 0),
                             {number(value())},
                             add(problem, std::move(pose)),
                             std::vector<int>(12, 3)});
    motion.programs = std::move(problem.programs);
  }
  if (coin(random)) {
    motion.checkpoint = random_checkpoint(random, motion);
    motion.checkpoint->fingerprint = fingerprint(motion);
  }
  if (!coin(random)) return motion;
  Samples samples;
  for (int i = below(random, 4); i > 0; --i) samples.times.push_back(value());
  const auto table = [&](int columns) {
    std::vector<std::vector<double>> rows(samples.times.size());
    for (auto& row : rows) {
      for (int k = 0; k < columns; ++k) row.push_back(value());
    }
    return rows;
  };
  for (std::size_t i = 0; i < random() % 3; ++i)
    samples.values[random_name(random, "plot", i)] = table(below(random, 4));
  for (std::size_t i = 0; i < random() % 3; ++i) samples.poses[random_name(random, "body", i)] = table(12);
  motion.samples = std::move(samples);
  return motion;
}

}  // namespace spacetime::examples
