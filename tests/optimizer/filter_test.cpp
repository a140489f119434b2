#include "optimizer/filter.h"

#include <gtest/gtest.h>

namespace spacetime::optimizer {
namespace {

TEST(Filter, AdmitsWhatImprovesInOneRespect) {
  Filter filter;
  EXPECT_TRUE(filter.admits(1e9, 1e9));
  filter.add(1, 10);
  EXPECT_FALSE(filter.admits(1, 10));
  EXPECT_FALSE(filter.admits(2, 11));
  EXPECT_TRUE(filter.admits(0.5, 1000));
  EXPECT_TRUE(filter.admits(1000, 9));
  filter.add(0.4, 20);
  EXPECT_FALSE(filter.admits(0.5, 1000));
  EXPECT_TRUE(filter.admits(0.5, 19));
}

TEST(Filter, WantsMoreThanAMargin) {
  Filter filter;
  filter.add(1, 10);
  EXPECT_FALSE(filter.admits(1 - Filter::margin / 2, 10));
  EXPECT_TRUE(filter.admits(1 - 2 * Filter::margin, 10));
  EXPECT_FALSE(filter.admits(1, 10 - Filter::margin / 2));
  EXPECT_TRUE(filter.admits(1, 10 - 2 * Filter::margin));
}

TEST(Filter, HasALimitUntilCleared) {
  Filter filter;
  filter.limit(100);
  filter.add(1, 10);
  EXPECT_TRUE(filter.admits(100, 9));
  EXPECT_FALSE(filter.admits(101, 9));
  filter.clear();
  EXPECT_TRUE(filter.admits(1, 10));
  EXPECT_FALSE(filter.admits(101, 9));
}

}  // namespace
}  // namespace spacetime::optimizer
