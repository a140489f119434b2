// What is written reads back as it was, under the names that design and readers agreed on.
#include "protocol/motion_json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "protocol/check.h"
#include "tests/protocol/examples.h"

namespace spacetime {
namespace {

TEST(MotionDocument, HoldsEverythingAMotionHolds) {
  const auto motion = examples::rich_motion();
  EXPECT_EQ(read_motion(write(motion)), motion);
}

TEST(MotionDocument, HoldsRandomMotions) {
  for (std::uint32_t seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto motion = examples::random_motion(seed);
    const auto fault = validate(motion);
    ASSERT_FALSE(fault) << fault->path << ": " << fault->message;
    const auto text = write(motion);
    const auto read = read_motion(text);
    ASSERT_EQ(read, motion);
    ASSERT_EQ(write(read), text);  // tells -0.0 from 0.0, which == does not
  }
}

TEST(MotionDocument, KeepsTheOrderOfTermsConstantsAndParameters) {
  Motion motion;
  for (const auto* name : {"zeta", "alpha", "mu", "beta"}) {
    motion.terms.emplace_back(name, 1);
    motion.constants.emplace_back(name, 2);
    motion.parameters.emplace_back(name, 3);
  }
  const auto read = read_motion(write(motion));
  EXPECT_EQ(read.terms, motion.terms);
  EXPECT_EQ(read.constants, motion.constants);
  EXPECT_EQ(read.parameters, motion.parameters);
}

// What is measured along a motion, and all other numbers of it, with their paths.
struct Numbers {
  std::vector<std::pair<std::string, double*>> measures, others;
};

Numbers numbers_of(Motion& motion) {
  auto& violation = motion.violations[0];
  auto& record = motion.record[1];
  return {{{"/objective/total", &motion.objective},
           {"/objective/terms/calm", &motion.terms[1].second},
           {"/violation/max", &motion.violation},
           {"/violation/constraints/0/max", &violation.max},
           {"/samples/values/hand/2/1", &motion.samples->values["hand"][2][1]},
           {"/samples/poses/upper/1/11", &motion.samples->poses["upper"][1][11]},
           {"/record/1/objective", &record.objective},
           {"/record/1/terms/calm", &record.terms[1].second},
           {"/record/1/violation", &record.violation},
           {"/record/1/stationarity", &record.stationarity}},
          {{"/time/1", &motion.end},
           {"/seconds/total", &motion.seconds.total},
           {"/seconds/evaluate", &motion.seconds.evaluate},
           {"/seconds/factor", &motion.seconds.factor},
           {"/violation/constraints/0/time", &*violation.time},
           {"/dofs/0/basis/knots/4", &motion.dofs[0].basis.knots[4]},
           {"/dofs/0/coefficients/2", &motion.dofs[0].coefficients[2]},
           {"/constants/g", &motion.constants[1].second},
           {"/parameters/aim", &motion.parameters[1].second},
           {"/samples/times/1", &motion.samples->times[1]},
           {"/multipliers/0/times/1", &motion.multipliers[0].times[1]},
           {"/multipliers/0/values/1/0", &motion.multipliers[0].values[1][0]},
           {"/record/1/step", &record.step},
           {"/record/1/shift", &record.shift},
           {"/record/1/seconds", &record.seconds}}};
}

std::string fault_of(const Motion& motion) {
  const auto fault = validate(motion);
  return fault ? fault->path : "nothing";
}

TEST(MotionDocument, LacksMeasuresOnlyWhereTheMotionFailed) {
  using Limits = std::numeric_limits<double>;
  auto motion = examples::rich_motion();
  for (const double value : {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity()}) {
    for (const auto& [path, number] : numbers_of(motion).measures) {
      SCOPED_TRACE(path);
      const double before = std::exchange(*number, value);
      for (const auto status : {Status::converged, Status::stopped, Status::infeasible}) {
        motion.status = status;
        EXPECT_EQ(fault_of(motion), path);
        EXPECT_THROW(write(motion), InputError);
      }
      motion.status = Status::failed;
      EXPECT_EQ(fault_of(motion), "nothing");
      const auto text = write(motion);
      const auto document = nlohmann::json::parse(text);
      EXPECT_TRUE(document[nlohmann::json::json_pointer(path)].is_null());
      auto read = read_motion(text);
      for (const auto& [other, measure] : numbers_of(read).measures) EXPECT_EQ(std::isnan(*measure), other == path);
      for (const auto& [other, measure] : numbers_of(read).measures) *measure = other == path ? before : *measure;
      *number = before;
      EXPECT_EQ(read, motion);
    }
    for (const auto& [path, number] : numbers_of(motion).others) {
      SCOPED_TRACE(path);
      const double before = std::exchange(*number, value);
      motion.status = Status::failed;
      EXPECT_TRUE(fault_of(motion).starts_with(path.substr(0, path.rfind('/')))) << fault_of(motion);
      EXPECT_THROW(write(motion), InputError);
      *number = before;
    }
  }
}

TEST(MotionDocument, HasTheAgreedMembers) {
  auto motion = examples::rich_motion();
  motion.samples.reset();
  motion.multipliers.clear();
  motion.record.clear();
  motion.bodies.clear();
  motion.programs.clear();
  motion.checkpoint.reset();
  motion.dofs.resize(1);
  EXPECT_EQ(write(motion), R"({
 "format": "spacetime-motion/2",
 "time": [0, 2],
 "status": "converged",
 "message": "Converged: every constraint is kept and nothing near is better.",
 "iterations": 61,
 "seconds": {"total": 0.25, "evaluate": 0.125, "factor": 0.0625},
 "objective": {"total": 5.596, "terms": {"energy": 5.5, "calm": 0.096}},
 "violation": {"max": 3e-12, "constraints": [
   {"name": "goal", "max": 3e-12, "time": 1.6, "line": 27, "multiplier": {"value": -4.5, "time": 1.6}},
   {"name": "total", "max": 0, "time": null, "line": 12}
  ]},
 "dofs": [
  {"name": "arm.shoulder", "basis": {"kind": "bspline", "knots": [0, 0, 0, 0, 0.5, 2, 2, 2, 2]}, "coefficients": [0, 0.1, -0.25, 1e-17, 3]}
 ],
 "constants": {"release": 1, "g": 9.81},
 "parameters": {"speed": 2.5, "aim": -0.125}
}
)");
}

}  // namespace
}  // namespace spacetime
