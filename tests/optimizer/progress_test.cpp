// What a peer is told of a run that it reads too slowly.
#include <gtest/gtest.h>

#include <memory>

#include "common/bspline.h"
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
  int last = 0;
  for (int k = 0; k < many; ++k) last = untold.add(record_of(k));
  const auto told = untold.take_up_to(last);
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

// What came later than the iterate that is told of is told with a later one; also where a motion put in place in the
// middle of the run has a smaller number of iterations.
TEST(Progress, TellsNothingOfWhatCameLater) {
  Untold untold;
  std::vector<int> serials;
  for (const int iteration : {41, 42, 1, 2, 3}) serials.push_back(untold.add(record_of(iteration)));
  const auto told = untold.take_up_to(serials[3]);
  ASSERT_EQ(told.size(), 4U);
  EXPECT_EQ(told.front(), record_of(41));
  EXPECT_EQ(told.back(), record_of(2));
  EXPECT_TRUE(untold.take_up_to(serials[3]).empty());
  const auto rest = untold.take_up_to(serials[4]);
  ASSERT_EQ(rest.size(), 1U);
  EXPECT_EQ(rest.front(), record_of(3));
}

// A basis is told of once, by the name of what has it: an update may put another name in the same place.
TEST(Progress, ARenamedDegreeOfFreedomComesWithItsBasis) {
  const Basis basis = uniform_basis(0, 1, 4);
  const auto untold = std::make_shared<Untold>();
  Shown shown;
  const auto text_of = [&](const std::string& name, double first) {
    std::vector<double> coefficients(static_cast<std::size_t>(basis.size()), first);
    const IterationRecord record = record_of(1);
    return Snapshot{1, untold->add(record), record, untold, {{name, basis, coefficients}}, {}}.text(shown);
  };
  EXPECT_NE(text_of("x", 0).find("\"basis\""), std::string::npos);
  EXPECT_EQ(text_of("x", 1).find("\"basis\""), std::string::npos);
  EXPECT_EQ(text_of("x", 1).find("\"name\""), std::string::npos);  // nothing has changed
  EXPECT_NE(text_of("y", 1).find("\"basis\""), std::string::npos);
}

}  // namespace
}  // namespace spacetime::optimizer
