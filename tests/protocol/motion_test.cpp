// What is written reads back as it was, under the names that design and readers agreed on.
#include "protocol/motion_json.h"

#include <gtest/gtest.h>

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

TEST(MotionDocument, KeepsTheOrderOfTermsAndConstants) {
  Motion motion;
  for (const auto* name : {"zeta", "alpha", "mu", "beta"}) {
    motion.terms.emplace_back(name, 1);
    motion.constants.emplace_back(name, 2);
  }
  const auto read = read_motion(write(motion));
  EXPECT_EQ(read.terms, motion.terms);
  EXPECT_EQ(read.constants, motion.constants);
}

TEST(MotionDocument, HasTheAgreedMembers) {
  auto motion = examples::rich_motion();
  motion.samples.reset();
  motion.dofs.resize(1);
  EXPECT_EQ(write(motion), R"({
 "format": "spacetime-motion/1",
 "time": [0, 2],
 "status": "converged",
 "message": "Converged: every constraint is kept and nothing near is better.",
 "iterations": 61,
 "seconds": {"total": 0.25, "evaluate": 0.125, "factor": 0.0625},
 "objective": {"total": 5.596, "terms": {"energy": 5.5, "calm": 0.096}},
 "violation": {"max": 3e-12, "constraints": [
   {"name": "goal", "max": 3e-12, "time": 1.6, "line": 27},
   {"name": "total", "max": 0, "time": null, "line": 12}
  ]},
 "dofs": [
  {"name": "arm.shoulder", "basis": {"kind": "bspline", "knots": [0, 0, 0, 0, 0.5, 2, 2, 2, 2]}, "coefficients": [0, 0.1, -0.25, 1e-17, 3]}
 ],
 "constants": {"release": 1, "g": 9.81},
 "parameters": {}
}
)");
}

}  // namespace
}  // namespace spacetime
