// What a peer is told of a run that it reads too slowly.
#include <gtest/gtest.h>

#include "optimizer/server_progress.h"

namespace spacetime::optimizer {
namespace {

IterationRecord record_of(int iteration) {
  IterationRecord record;
  record.iteration = iteration;
  record.objective = 2.0 * iteration;
  record.terms = {{"effort", 2.0 * iteration}};
  return record;
}

// Beyond a thousand records every second one is left out, each time: what stays is as it was, from the first on.
TEST(Progress, RecordsThatNobodyReadsAreThinnedAndStayWhole) {
  Untold untold;
  const int many = 5000;
  for (int k = 0; k < many; ++k) untold.add(record_of(k));
  const auto told = untold.take_up_to(many);
  EXPECT_LE(told.size(), 1024U);
  EXPECT_GT(told.size(), 256U);
  ASSERT_FALSE(told.empty());
  EXPECT_EQ(told.front().iteration, 0);
  EXPECT_EQ(told.back().iteration, many - 1);
  for (std::size_t i = 0; i < told.size(); ++i) {
    EXPECT_EQ(told[i], record_of(told[i].iteration));
    EXPECT_TRUE(i == 0 || told[i].iteration > told[i - 1].iteration);
  }
}

TEST(Progress, TellsNothingOfLaterIterations) {
  Untold untold;
  for (int k = 3; k <= 7; ++k) untold.add(record_of(k));
  EXPECT_EQ(untold.take_up_to(5).size(), 3U);
  EXPECT_TRUE(untold.take_up_to(5).empty());
  const auto rest = untold.take_up_to(9);
  ASSERT_EQ(rest.size(), 2U);
  EXPECT_EQ(rest.front(), record_of(6));
}

}  // namespace
}  // namespace spacetime::optimizer
