#include "optimizer/banded.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <random>

namespace spacetime::optimizer {
namespace {

struct Shape {
  int n, width, m;
};
const std::vector<Shape> shapes{{1, 0, 0}, {5, 0, 2}, {7, 10, 0}, {0, 0, 4}, {40, 6, 0}, {40, 6, 5}, {200, 17, 3}};

BorderedMatrix matrix_of(const Shape& shape) {
  Pattern pattern;
  pattern.n = shape.n;
  pattern.width = shape.width;
  pattern.m = shape.m;
  return BorderedMatrix(std::make_shared<const Pattern>(std::move(pattern)));
}

// A random symmetric matrix with signs on a dominant diagonal: no pivot comes near zero, and both inertias occur.
struct Sample {
  BorderedMatrix bordered;
  Eigen::MatrixXd dense;
};
Sample random_matrix(const Shape& shape, std::mt19937_64& random) {
  std::uniform_real_distribution<double> entry(-1, 1);
  Sample sample{matrix_of(shape), Eigen::MatrixXd::Zero(shape.n + shape.m, shape.n + shape.m)};
  for (int i = 0; i < shape.n + shape.m; ++i) {
    for (int j = 0; j <= i; ++j) {
      if (i < shape.n && i - j > shape.width) continue;
      double value = entry(random);
      if (i == j) value = (value > 0 ? 1 : -1) * (3.0 + (i < shape.n ? shape.width : shape.n) + shape.m);
      // Both triangles, and in pieces: entries add up.
      sample.bordered.add(i, j, value / 4);
      sample.bordered.add(j, i, value - value / 4);
      sample.dense(i, j) = sample.dense(j, i) = value / 4 + (value - value / 4);
    }
  }
  return sample;
}

Eigen::VectorXd random_vector(int size, std::mt19937_64& random) {
  std::uniform_real_distribution<double> entry(-1, 1);
  return Eigen::VectorXd::NullaryExpr(size, [&](Eigen::Index) { return entry(random); });
}

TEST(Banded, MultipliesAsTheDenseMatrix) {
  std::mt19937_64 random(11);
  for (const Shape& shape : shapes) {
    const auto [bordered, dense] = random_matrix(shape, random);
    const Eigen::VectorXd x = random_vector(bordered.size(), random);
    EXPECT_LE((multiply(bordered, x) - dense * x).cwiseAbs().maxCoeff(), 1e-13 * dense.cwiseAbs().maxCoeff())
        << "seed 11, n " << shape.n << ", width " << shape.width << ", m " << shape.m;
  }
}

TEST(Banded, SolvesAsTheDenseMatrix) {
  std::mt19937_64 random(12);
  for (int round = 0; round < 20; ++round) {
    for (const Shape& shape : shapes) {
      const auto [bordered, dense] = random_matrix(shape, random);
      const Eigen::VectorXd right = random_vector(bordered.size(), random);
      Factorisation factorisation;
      ASSERT_TRUE(factorisation.compute(bordered));
      const Eigen::VectorXd expected = dense.fullPivLu().solve(right);
      EXPECT_LE((factorisation.solve(right) - expected).cwiseAbs().maxCoeff(), 1e-12 * expected.cwiseAbs().maxCoeff())
          << "seed 12, round " << round << ", n " << shape.n << ", width " << shape.width << ", m " << shape.m;
      if (shape.n >= 200) break;
    }
  }
}

TEST(Banded, CountsNegativeEigenvalues) {
  std::mt19937_64 random(13);
  int least = 1000, most = 0;
  for (int round = 0; round < 30; ++round) {
    const Shape shape{30, 5, 4};
    auto [bordered, dense] = random_matrix(shape, random);
    // Without dominance: indefinite within the band too, as a KKT matrix is.
    for (int k = 0; k < shape.n; ++k) {
      bordered.add(k, k, -0.9 * dense(k, k));
      dense(k, k) -= 0.9 * dense(k, k);
    }
    Factorisation factorisation;
    ASSERT_TRUE(factorisation.compute(bordered));
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(dense, Eigen::EigenvaluesOnly);
    const int negative = static_cast<int>((eigen.eigenvalues().array() < 0).count());
    EXPECT_EQ(factorisation.negative(), negative) << "seed 13, round " << round;
    least = std::min(least, negative);
    most = std::max(most, negative);
  }
  EXPECT_LT(least, most);  // or the test would not tell anything
}

// [ W A^T; A -e ] with W positive: as many negative pivots as rows, wherever the rows stand.
TEST(Banded, CountsTheRowsOfAQuasiDefiniteMatrix) {
  std::mt19937_64 random(14);
  std::uniform_real_distribution<double> entry(-1, 1);
  for (int round = 0; round < 20; ++round) {
    const Shape shape{50, 7, 3};
    BorderedMatrix matrix = matrix_of(shape);
    std::vector<bool> is_row(53);
    int rows = 0;
    for (int k = 0; k < 53; ++k) {
      is_row[k] = std::uniform_int_distribution<int>(0, 3)(random) == 0;
      rows += is_row[k];
      matrix.add(k, k, is_row[k] ? -1e-8 : 20.0);
    }
    for (int i = 0; i < 53; ++i) {
      for (int j = i < shape.n ? std::max(0, i - shape.width) : 0; j < i; ++j) {
        if (!is_row[i] || !is_row[j]) matrix.add(i, j, entry(random) * (is_row[i] || is_row[j] ? 1 : 0.2));
      }
    }
    Factorisation factorisation;
    ASSERT_TRUE(factorisation.compute(matrix));
    EXPECT_EQ(factorisation.negative(), rows) << "seed 14, round " << round;
  }
}

// A coarse curve beside a fine one: every fifth row reaches back to the start of a wide support.  And rows beside the
// band, three to a column, that touch four columns each.
Sample random_composite(std::mt19937_64& random) {
  std::uniform_real_distribution<double> entry(-1, 1);
  constexpr int n = 60, width = 6, m = 3, beside = 50;
  Pattern pattern;
  pattern.n = n;
  pattern.width = width;
  pattern.m = m;
  std::vector<int> from(n);
  for (int i = 0; i < n; ++i) {
    from[i] = std::max(0, i % 5 == 4 ? i - 10 - i % 23 : i - width);
    if (i - from[i] <= width) continue;
    pattern.long_rows.push_back({i, from[i], pattern.far_entries()});
  }
  for (int r = 0; r < beside; ++r) {
    for (int k = 0; k < 4; ++k) pattern.column.push_back((r + k) % (n - width) + (k % 2) * 2);
    pattern.start.push_back(static_cast<int>(pattern.column.size()));
  }
  const int size = pattern.size();
  Sample sample{BorderedMatrix(std::make_shared<const Pattern>(pattern)), Eigen::MatrixXd::Zero(size, size)};
  const auto put = [&](int i, int j, double value) {
    sample.bordered.add(i, j, value);
    sample.dense(i, j) += value;
    if (i != j) sample.dense(j, i) += value;
  };
  for (int i = 0; i < n + m; ++i) {
    for (int j = i < n ? from[i] : 0; j < i; ++j) put(i, j, entry(random));
    put(i, i, (entry(random) > 0 ? 1 : -1) * 60.0);
  }
  for (int r = 0; r < beside; ++r) {
    for (int e = pattern.start[r]; e < pattern.start[r + 1]; ++e) put(n + m + r, pattern.column[e], entry(random));
    put(n + m + r, n + m + r, entry(random) > 0 ? 3 : -3);
  }
  return sample;
}

TEST(Banded, LongRowsAndRowsBesideTheBand) {
  std::mt19937_64 random(15);
  for (int round = 0; round < 20; ++round) {
    const auto [matrix, dense] = random_composite(random);
    const Eigen::VectorXd x = random_vector(matrix.size(), random);
    EXPECT_LE((multiply(matrix, x) - dense * x).cwiseAbs().maxCoeff(), 1e-12) << "seed 15, round " << round;
    for (int k = 0; k < matrix.size(); ++k) EXPECT_EQ(matrix.on_diagonal(k), dense(k, k));
    Eigen::MatrixXd visited = Eigen::MatrixXd::Zero(matrix.size(), matrix.size());
    for_each_entry(matrix, [&](int i, int j, double value) { visited(i, j) = visited(j, i) = value; });
    EXPECT_EQ((visited - dense).cwiseAbs().maxCoeff(), 0) << "seed 15, round " << round;

    Factorisation factorisation;
    ASSERT_TRUE(factorisation.compute(matrix));
    const Eigen::VectorXd expected = dense.fullPivLu().solve(x);
    EXPECT_LE((factorisation.solve(x) - expected).cwiseAbs().maxCoeff(), 1e-11 * expected.cwiseAbs().maxCoeff())
        << "seed 15, round " << round;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(dense, Eigen::EigenvaluesOnly);
    EXPECT_EQ(factorisation.negative(), (eigen.eigenvalues().array() < 0).count()) << "seed 15, round " << round;
  }
}

TEST(Banded, RefusesWhatItCannotFactor) {
  Factorisation factorisation;
  BorderedMatrix zero = matrix_of({3, 1, 0});
  EXPECT_FALSE(factorisation.compute(zero));

  BorderedMatrix singular = matrix_of({2, 1, 0});  // [1 1; 1 1]
  for (const auto& [i, j] : {std::pair{0, 0}, {1, 0}, {1, 1}}) singular.add(i, j, 1);
  EXPECT_FALSE(factorisation.compute(singular));

  BorderedMatrix without_number = matrix_of({2, 1, 0});
  without_number.add(0, 0, 1);
  without_number.add(1, 1, std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(factorisation.compute(without_number));

  BorderedMatrix border = matrix_of({1, 0, 1});  // the border's Schur complement vanishes
  border.add(0, 0, 1);
  border.add(1, 0, 2);
  border.add(1, 1, 4);
  EXPECT_FALSE(factorisation.compute(border));
  border.add(1, 1, std::numeric_limits<double>::infinity());
  EXPECT_FALSE(factorisation.compute(border));
}

}  // namespace
}  // namespace spacetime::optimizer
