// Simulated errors of edges, compared with the covariance.
#include "host/register/edge_covariance.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "host/core/matrix6.h"
#include "host/core/pose_steps.h"
#include "host/register/d2co.h"
#include "tests/test_random.h"

namespace edgescout {
namespace {

using test::test_random;

struct Drawn {
  std::vector<std::vector<Vector6d>> jacobians;  // by edge and point
  std::vector<std::vector<double>> distances_px;
};

Vector6d normals(Random& random) {
  Vector6d v;
  for (int i = 0; i < 6; ++i) v[i] = random.normal();
  return v;
}

// Points of one edge pull nearly alike. Errors at the truth, the zero step.
Drawn draw(int edges, int points, double edge_px, double point_px, Random& random) {
  Drawn drawn;
  for (int e = 0; e < edges; ++e) {
    const Vector6d common = normals(random);
    const double displaced_px = edge_px * random.normal();
    std::vector<Vector6d>& jacobians = drawn.jacobians.emplace_back();
    std::vector<double>& distances = drawn.distances_px.emplace_back();
    for (int i = 0; i < points; ++i) {
      jacobians.push_back(common + 0.3 * normals(random));
      distances.push_back(displaced_px + point_px * random.normal());
    }
  }
  return drawn;
}

struct Fit {
  Vector6d error;
  Matrix6d clustered, independent;
};

Fit least_squares(const Drawn& drawn) {
  Matrix6d hessian = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  for (std::size_t e = 0; e < drawn.jacobians.size(); ++e)
    for (std::size_t i = 0; i < drawn.jacobians[e].size(); ++i) {
      hessian += drawn.jacobians[e][i] * drawn.jacobians[e][i].transpose();
      gradient += drawn.distances_px[e][i] * drawn.jacobians[e][i];
    }
  Fit fit;
  fit.error = -solve(hessian, gradient);
  EdgeCovariance sum;
  double squares = 0;
  int count = 0;
  for (std::size_t e = 0; e < drawn.jacobians.size(); ++e)
    for (std::size_t i = 0; i < drawn.jacobians[e].size(); ++i, ++count) {
      const double left = drawn.distances_px[e][i] + drawn.jacobians[e][i].dot(fit.error);
      sum.add(100 - e, left, 1, drawn.jacobians[e][i]);
      squares += left * left;
    }
  fit.clustered = sum.covariance();
  fit.independent = pose_covariance(hessian, squares / (count - 6));
  return fit;
}

double squared(const Vector6d& error, const Matrix6d& covariance) {
  return error.dot(solve(covariance, error));
}

struct Mean {
  double clustered = 0,
         independent = 0;  // of the squared normalised error; 6 where the covariance is right
};

Mean mean_squared(int edges, int points, double edge_px, double point_px) {
  Random random = test_random();
  constexpr int draws = 400;
  Mean mean;
  for (int i = 0; i < draws; ++i) {
    const Fit fit = least_squares(draw(edges, points, edge_px, point_px, random));
    mean.clustered += squared(fit.error, fit.clustered) / draws;
    mean.independent += squared(fit.error, fit.independent) / draws;
  }
  return mean;
}

// 400 draws know a mean of 6 to 3 %, one standard deviation.
TEST(EdgeCovariance, TellsErrorsThatEdgesShare) {
  const Mean mean = mean_squared(60, 25, EXPECTED_DISPLACEMENT_PX, 0.1);
  EXPECT_NEAR(mean.clustered, 6, 0.9);
  EXPECT_GT(mean.independent, 30) << "points taken for independent";
}

TEST(EdgeCovariance, OutweighsWhatItExpectedWithManyEdges) {
  for (const double edge_px : {0.04, 0.6})
    EXPECT_NEAR(mean_squared(500, 6, edge_px, 0.1).clustered, 6, 0.9);
}

// As few edges as one view of a block has: what the pose took out of the distances is given back.
TEST(EdgeCovariance, TellsErrorsOfFewEdges) {
  const Mean mean = mean_squared(10, 25, EXPECTED_DISPLACEMENT_PX, 0.1);
  EXPECT_GT(mean.clustered, 3);
  EXPECT_LT(mean.clustered, 9);
}

TEST(EdgeCovariance, IsThatOfIndependentPointsWhereEveryPointIsAnEdge) {
  Random random = test_random();
  const Fit fit = least_squares(draw(500, 1, 0, 0.3, random));
  EXPECT_LT((fit.clustered - fit.independent).norm(), 0.1 * fit.independent.norm());
}

TEST(EdgeCovariance, IsPositiveWithSevenPointsOnAnEdgeEach) {
  Random random = test_random();
  const Fit fit = least_squares(draw(7, 1, 0.1, 0.1, random));
  ASSERT_TRUE(fit.clustered.allFinite());
  EXPECT_GT(eigenvectors(fit.clustered).values.minCoeff(), 0);
}

TEST(EdgeCovariance, IsInfiniteWhereNothingHoldsThePose) {
  EXPECT_EQ(EdgeCovariance().covariance()(0, 0), std::numeric_limits<double>::infinity());
  EdgeCovariance sum;
  for (int i = 0; i < 20; ++i) sum.add(1, 0.1, 1, Vector6d::Unit(i % 5));
  EXPECT_EQ(sum.covariance()(5, 5), std::numeric_limits<double>::infinity());
}

// A robot that takes the covariance for a bound must not gain trust where edges explain less.
TEST(CommonToEdges, FallsWithTheShareThatEdgesExplain) {
  EXPECT_GT(common_to_edges(0.3), 2 * common_to_edges(0.6));
  for (double share = 0; share < 1; share += 0.05)
    EXPECT_GE(common_to_edges(share), common_to_edges(share + 0.05)) << share;
}

TEST(CommonToEdges, IsConstantBeyondTheSharesOfTheFit) {
  EXPECT_EQ(common_to_edges(0), common_to_edges(0.1));
  EXPECT_EQ(common_to_edges(0.95), common_to_edges(1));
  EXPECT_GT(common_to_edges(1), 1) << "distances alone predict too small errors";
}

}  // namespace
}  // namespace edgescout
