#include "host/core/matrix6.h"

#include <gtest/gtest.h>

#include "tests/test_random.h"

namespace edgescout {
namespace {

Matrix6d random_matrix(Random& random) {
  Matrix6d matrix;
  for (double& entry : matrix.reshaped()) entry = random.normal();
  return matrix;
}

Matrix6d random_positive(Random& random) {
  const Matrix6d root = random_matrix(random);
  return root * root.transpose() + 0.1 * Matrix6d::Identity();
}

TEST(Matrix6, SolutionsFulfilTheirSystems) {
  Random random = test::test_random();
  for (int i = 0; i < 100; ++i) {
    const Matrix6d positive = random_positive(random), any = random_matrix(random);
    const Vector6d right = any.col(0);
    EXPECT_LT((positive * solve(positive, right) - right).norm(), 1e-9);
    EXPECT_LT((positive * solve(positive, any) - any).norm(), 1e-9);
    EXPECT_LT((positive * inverse(positive) - Matrix6d::Identity()).norm(), 1e-9);
    ASSERT_TRUE(inverse_of_positive(positive).has_value());
    EXPECT_LT((positive * *inverse_of_positive(positive) - Matrix6d::Identity()).norm(), 1e-9);
  }
}

TEST(Matrix6, OnlyAPositiveOneHasAnInverseOfPositive) {
  Random random = test::test_random();
  const Matrix6d positive = random_positive(random);
  EXPECT_FALSE(inverse_of_positive(-positive).has_value());
  EXPECT_FALSE(inverse_of_positive(Matrix6d::Zero()).has_value());
  Matrix6d without_a_direction = positive;
  without_a_direction.row(2).setZero();
  without_a_direction.col(2).setZero();
  EXPECT_FALSE(inverse_of_positive(without_a_direction).has_value());
}

TEST(Matrix6, EigenvectorsSpanTheMatrixWithAscendingValues) {
  Random random = test::test_random();
  for (int i = 0; i < 100; ++i) {
    const Matrix6d positive = random_positive(random);
    const auto [values, vectors] = eigenvectors(positive);
    EXPECT_LT((vectors * values.asDiagonal() * vectors.transpose() - positive).norm(), 1e-9);
    EXPECT_LT((vectors.transpose() * vectors - Matrix6d::Identity()).norm(), 1e-12);
    for (int k = 1; k < 6; ++k) EXPECT_LE(values[k - 1], values[k]);
    EXPECT_NEAR(determinant(positive) / values.prod(), 1, 1e-9);
  }
}

}  // namespace
}  // namespace edgescout
