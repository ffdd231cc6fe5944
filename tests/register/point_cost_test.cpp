#include "host/register/point_cost.h"

#include <gtest/gtest.h>

#include <limits>

#include "host/model/visible_edges.h"
#include "host/register/se3_manifold.h"
#include "kernels/error.h"
#include "tests/register/linear_tensor.h"
#include "tests/test_random.h"

namespace edgescout {
namespace {

using namespace test;

struct Evaluated {
  bool valid = false;
  double residual = 0;
  Vector6d by_tangent = Vector6d::Zero();
};

Evaluated evaluate(const PointCost& cost, const Se3& world_from_object) {
  const PoseParameters parameters = to_parameters(world_from_object);
  Eigen::Matrix<double, 1, 7> by_ambient;
  Eigen::Matrix<double, 7, 6, Eigen::RowMajor> ambient_by_tangent;
  Se3Manifold().PlusJacobian(parameters.data(), ambient_by_tangent.data());
  const double* blocks[] = {parameters.data()};
  double* jacobians[] = {by_ambient.data()};
  Evaluated out;
  out.valid = cost.Evaluate(blocks, &out.residual, jacobians);
  if (out.valid) out.by_tangent = (by_ambient * ambient_by_tangent).transpose();
  return out;
}

Se3 random_world_pose(Random& random) { return {random.rotation(), 2 * random.direction()}; }

Se3 camera_before(const Se3& world_from_object, Random& random) {
  const Se3 camera_from_object{
      random.rotation(),
      {random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05), random.uniform(0.4, 0.8)}};
  return camera_from_object * inverse(world_from_object);
}

TEST(PointCost, DerivesItsResidual) {
  Random random = test_random();
  const LinearTensor tensor;
  int checked = 0;
  for (int i = 0; i < 1000; ++i) {
    const Se3 pose = random_world_pose(random), camera_from_world = camera_before(pose, random);
    const ModelPoint point = random_point(random, 0.06);
    const auto residual = [&](const Se3& at) {
      return tensor.residual(land(tensor.intrinsics, camera_from_world * at, point));
    };
    if (!tensor.holds(land(tensor.intrinsics, camera_from_world * pose, point))) continue;
    const Evaluated got = evaluate(PointCost(tensor.view(), camera_from_world, point), pose);
    ASSERT_TRUE(got.valid);
    EXPECT_NEAR(got.residual, residual(pose), 1e-4 * residual(pose));
    Vector6d expected;
    constexpr double h = 1e-6;
    for (int k = 0; k < 6; ++k)
      expected[k] = (residual(retract(pose, h * Vector6d::Unit(k))) -
                     residual(retract(pose, -h * Vector6d::Unit(k)))) /
                    (2 * h);
    EXPECT_LT((got.by_tangent - expected).norm(), 2e-4 * expected.norm());
    ++checked;
  }
  EXPECT_GT(checked, 300);
}

// Two derivations of the same thing, on a real tensor, borders and edges seen end on included.
TEST(PointCost, AgreesWithTheKernel) {
  Random random = test_random();
  std::vector<EdgePoint> edges;
  for (int i = 0; i < 40; ++i)
    edges.push_back({float(random.uniform(0, 160)), float(random.uniform(0, 120)),
                     float(random.uniform(0, 3.14)), 1});
  const TensorOptions options;
  const TensorShape shape{160, 120, options.bins};
  const std::vector<std::uint16_t> tensor =
      dcd_tensor_reference(edges, shape.width, shape.height, options);
  const TensorView view{tensor, shape, {300, 310, 78, 61}};
  int agreed = 0, end_on = 0;
  constexpr int trials = 3000;
  for (int i = 0; i < trials; ++i) {
    const Se3 pose{
        random.rotation(),
        {random.uniform(-0.2, 0.2), random.uniform(-0.15, 0.15), random.uniform(0.4, 0.7)}};
    ModelPoint point = random_point(random, 0.06);
    if (i % 3 == 0) {  // along the line of sight, more or less
      const Eigen::Vector3d sight =
          (pose.rotation.conjugate() * pose.translation_m).normalized() + 0.05 * random.direction();
      const Eigen::Vector3f t = sight.normalized().cast<float>();
      point = {point.x_m, point.y_m, point.z_m, t.x(), t.y(), t.z()};
    }
    const PoseProblem problem{to_pose(pose), 0, 1, 0};
    NormalEquations kernel;
    pose_normal_equations_reference(std::span(&view, 1), std::span(&point, 1),
                                    std::span(&problem, 1), {LOSS_HUBER, 1e4f},
                                    std::span(&kernel, 1));
    const Evaluated got = evaluate(PointCost(view, Se3{}, point), pose);
    ASSERT_TRUE(got.valid);
    if (land(view.intrinsics, pose, point).foreshortening < POSE_MIN_FORESHORTENING) ++end_on;
    const Vector6d gradient = got.residual * got.by_tangent;
    double error = std::abs(got.residual - kernel.residual_sum) / (1e-3 * (1 + got.residual));
    for (int k = 0; k < 6; ++k)
      error = std::max(
          error, std::abs(gradient[k] - kernel.gradient[k]) / (1e-3 * gradient.norm() + 1e-3));
    agreed += error < 1;
  }
  // The kernel's pose is in single precision: a point on the border of a cell may fall on either
  // side.
  EXPECT_GE(agreed, trials * 0.99);
  EXPECT_GT(end_on, 100);
}

TEST(PointCost, RefusesAPoseThatPutsThePointInTheCamera) {
  const LinearTensor tensor;
  const PointCost cost(tensor.view(), Se3{}, {0, 0, 0, 1, 0, 0});
  for (const double z : {-0.5, 0.0, 0.0009})
    EXPECT_FALSE(evaluate(cost, {Eigen::Quaterniond::Identity(), {0, 0, z}}).valid) << z;
  EXPECT_TRUE(evaluate(cost, {Eigen::Quaterniond::Identity(), {0, 0, 0.0011}}).valid);
  EXPECT_FALSE(evaluate(cost, {Eigen::Quaterniond::Identity(),
                               {0, 0, std::numeric_limits<double>::quiet_NaN()}})
                   .valid);
}

TEST(PointCost, LossesAreThoseOfTheKernel) {
  for (const PoseLoss& loss : {PoseLoss{LOSS_HUBER, 3.0f}, PoseLoss{LOSS_GEMAN_MCCLURE, 5.0f}}) {
    const std::unique_ptr<ceres::LossFunction> ceres_loss = make_loss(loss);
    for (const double r : {0.0, 0.1, 1.0, 2.9, 3.1, 8.0, 60.0}) {
      double out[3];
      ceres_loss->Evaluate(r * r, out);
      EXPECT_NEAR(0.5 * out[0], rho(loss, r), 1e-12 * (1 + r));
      if (r == 0) continue;
      const double h = 1e-4 * r * r;
      double above[3], below[3];
      ceres_loss->Evaluate(r * r + h, above);
      ceres_loss->Evaluate(r * r - h, below);
      EXPECT_NEAR(out[1], (above[0] - below[0]) / (2 * h), 1e-6);
      EXPECT_NEAR(out[2], (above[1] - below[1]) / (2 * h), 1e-6);
    }
  }
  EXPECT_THROW(make_loss({7, 1.0f}), LogicError);
}

}  // namespace
}  // namespace edgescout
