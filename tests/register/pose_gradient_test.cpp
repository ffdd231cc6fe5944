// The systems D2CO solves, against differences of the cost they claim to derive: in the camera, and
// mapped to the world.
#include <gtest/gtest.h>

#include <functional>

#include "host/model/visible_edges.h"
#include "host/register/lm_state.h"
#include "kernels/thread_pool.h"
#include "tests/register/linear_tensor.h"
#include "tests/test_random.h"

namespace edgescout {
namespace {

using namespace test;

using Function = std::function<double(const Se3&)>;

Vector6d differences(const Function& cost, const Se3& at) {
  constexpr double h = 1e-6;
  Vector6d gradient;
  for (int i = 0; i < 6; ++i) {
    const Vector6d step = h * Vector6d::Unit(i);
    gradient[i] = (cost(retract(at, step)) - cost(retract(at, -step))) / (2 * h);
  }
  return gradient;
}

struct KernelPath {
  std::string name;
  std::function<void(std::span<const TensorView>, std::span<const ModelPoint>,
                     std::span<const PoseProblem>, const PoseLoss&, std::span<NormalEquations>)>
      run;
};

std::vector<KernelPath> cpu_paths(ThreadPool& pool) {
  return {{"reference", pose_normal_equations_reference},
          {"fast", [&pool](auto views, auto points, auto problems, const PoseLoss& loss, auto out) {
             pose_normal_equations_fast(views, points, problems, loss, out, pool);
           }}};
}

// One analytic view of a pose problem, and the points that land well inside it.
struct AnalyticView {
  LinearTensor tensor;
  Se3 camera_from_world;
  std::vector<ModelPoint> points;

  AnalyticView(const LinearTensor& tensor_, const Se3& camera_from_world_,
               const Se3& world_from_object, Random& random)
      : tensor(tensor_), camera_from_world(camera_from_world_) {
    for (int tries = 0; tries < 400; ++tries) {
      const ModelPoint point = random_point(random, 0.06);
      if (tensor.holds(land(tensor.intrinsics, camera_from_world * world_from_object, point)))
        points.push_back(point);
    }
  }
  double residual(const Se3& world_from_object, const ModelPoint& point) const {
    return tensor.residual(land(tensor.intrinsics, camera_from_world * world_from_object, point));
  }
  double cost(const Se3& world_from_object, const PoseLoss& loss) const {
    double sum = 0;
    for (const ModelPoint& point : points) sum += rho(loss, residual(world_from_object, point));
    return sum;
  }
  Matrix6d hessian(const Se3& world_from_object, const PoseLoss& loss) const {
    Matrix6d sum = Matrix6d::Zero();
    for (const ModelPoint& point : points) {
      const Vector6d j =
          differences([&](const Se3& pose) { return residual(pose, point); }, world_from_object);
      const double r = residual(world_from_object, point), h = 1e-5;
      sum += (rho(loss, r + h) - rho(loss, r - h)) / (2 * h) / r * j * j.transpose();
    }
    return sum;
  }
  NormalEquations system(const KernelPath& path, const Se3& world_from_object,
                         const PoseLoss& loss) const {
    const TensorView view = tensor.view();
    const PoseProblem problem{to_pose(camera_from_world * world_from_object), 0,
                              std::uint32_t(points.size()), 0};
    NormalEquations out;
    path.run(std::span(&view, 1), points, std::span(&problem, 1), loss, std::span(&out, 1));
    return out;
  }
};

void expect_derives(const std::vector<AnalyticView>& views, const Se3& world_from_object,
                    const PoseLoss& loss, const KernelPath& path) {
  WorldSystem system;
  Matrix6d hessian = Matrix6d::Zero();
  double points = 0;
  for (const AnalyticView& view : views) {
    add_view(system, view.system(path, world_from_object, loss), view.camera_from_world);
    hessian += view.hessian(world_from_object, loss);
    points += double(view.points.size());
  }
  const Function cost = [&](const Se3& pose) {
    double sum = 0;
    for (const AnalyticView& view : views) sum += view.cost(pose, loss);
    return sum;
  };
  const Vector6d gradient = differences(cost, world_from_object);
  EXPECT_EQ(system.points, points);
  EXPECT_NEAR(system.cost, cost(world_from_object), 1e-4 * cost(world_from_object));
  EXPECT_LT((system.gradient - gradient).cwiseAbs().maxCoeff(),
            2e-4 * gradient.cwiseAbs().maxCoeff())
      << path.name << " loss " << loss.kind << "\nkernel      " << system.gradient.transpose()
      << "\ndifferences " << gradient.transpose();
  // The header promises 1e-3 of the largest entry.
  EXPECT_LT((system.hessian - hessian).cwiseAbs().maxCoeff(), 1e-3 * hessian.cwiseAbs().maxCoeff());
}

Se3 random_camera_pose(Random& random) {
  return {random.rotation(),
          {random.uniform(-0.04, 0.04), random.uniform(-0.03, 0.03), random.uniform(0.4, 0.8)}};
}

// Scales in the middle of the residuals: both branches of Huber's loss take part.
constexpr PoseLoss losses[] = {{LOSS_HUBER, 45.0f}, {LOSS_GEMAN_MCCLURE, 30.0f}};

TEST(PoseGradient, IsThatOfTheCostInOneView) {
  Random random = test_random();
  ThreadPool pool(2);
  for (int trial = 0; trial < 10; ++trial) {
    const Se3 pose = random_camera_pose(random);
    const std::vector<AnalyticView> view{{LinearTensor(), Se3{}, pose, random}};
    ASSERT_GT(view[0].points.size(), 100u);
    for (const PoseLoss& loss : losses)
      for (const KernelPath& path : cpu_paths(pool)) expect_derives(view, pose, loss, path);
  }
}

TEST(PoseGradient, MapsToTheWorldAndAddsUpOverViews) {
  Random random = test_random();
  ThreadPool pool(2);
  for (int trial = 0; trial < 10; ++trial) {
    const Se3 world_from_object{random.rotation(), 2 * random.direction()};
    std::vector<AnalyticView> views;
    for (const LinearTensor& tensor :
         {LinearTensor(), LinearTensor(-19, 31, 97), LinearTensor(5, 41, -130)}) {
      const Se3 camera_from_world = random_camera_pose(random) * inverse(world_from_object);
      views.emplace_back(tensor, camera_from_world, world_from_object, random);
    }
    for (const PoseLoss& loss : losses)
      for (const KernelPath& path : cpu_paths(pool))
        expect_derives(views, world_from_object, loss, path);
  }
}

// On a real tensor value and slope come from one interpolant, which is smooth inside a cell of it
// only.
struct Cell {
  int u, v, bin, inside;
  bool operator==(const Cell&) const = default;
};
Cell cell_of(const Landing& at, const TensorShape& shape) {
  return {
      int(std::floor(at.u)), int(std::floor(at.v)),
      int(std::floor(at.theta / std::numbers::pi * shape.bins)),
      (at.u > 0) + 2 * (at.v > 0) + 4 * (at.u < shape.width - 1) + 8 * (at.v < shape.height - 1)};
}

// A scaled derivative: what the cost changes by over each step of `steps`.
struct StepCheck {
  TensorView view;
  PoseLoss loss;
  const KernelPath& path;
  Vector6d steps;
  int inside = 0, outside = 0;

  void at(const Se3& pose, const ModelPoint& point) {
    const Landing landing = land(view.intrinsics, pose, point);
    if (landing.foreshortening < 0.1) return;
    std::vector<PoseProblem> problems{{to_pose(pose), 0, 1, 0}};
    for (int i = 0; i < 12; ++i) {
      const Se3 moved = retract(pose, (i % 2 ? -1 : 1) * steps[i / 2] * Vector6d::Unit(i / 2));
      if (cell_of(land(view.intrinsics, moved, point), view.shape) != cell_of(landing, view.shape))
        return;
      problems.push_back({to_pose(moved), 0, 1, 0});
    }
    std::vector<NormalEquations> out(problems.size());
    path.run(std::span(&view, 1), std::span(&point, 1), problems, loss, out);
    Vector6d by_gradient, by_difference;
    for (int i = 0; i < 6; ++i) {
      by_gradient[i] = out[0].gradient[i] * steps[i];
      by_difference[i] = 0.5 * (out[1 + 2 * i].cost - out[2 + 2 * i].cost);
    }
    // Single precision of the pixel, 3e-5 px, times slope and residual.
    const double noise = 1e-4 * (1 + 3 * out[0].residual_sum);
    EXPECT_LT((by_gradient - by_difference).cwiseAbs().maxCoeff(),
              0.01 * by_gradient.cwiseAbs().maxCoeff() + noise)
        << path.name << " loss " << loss.kind << " r " << out[0].residual_sum << "\n"
        << by_gradient.transpose() << "\n"
        << by_difference.transpose();
    const Landing& l = landing;
    ++(l.u > 0 && l.v > 0 && l.u < view.shape.width - 1 && l.v < view.shape.height - 1 ? inside
                                                                                       : outside);
  }
};

TEST(PoseGradient, IsThatOfTheInterpolantOnARealTensor) {
  Random random = test_random();
  ThreadPool pool(2);
  std::vector<EdgePoint> edges;
  for (int i = 0; i < 60; ++i)
    edges.push_back({float(random.uniform(0, 200)), float(random.uniform(0, 150)),
                     float(random.uniform(0, std::numbers::pi)), 1});
  const TensorOptions options;
  const TensorShape shape{200, 150, options.bins};
  const std::vector<std::uint16_t> tensor =
      dcd_tensor_reference(edges, shape.width, shape.height, options);
  const TensorView view{tensor, shape, {300, 310, 98, 77}};
  Vector6d steps;
  steps << Eigen::Vector3d::Constant(4e-5), Eigen::Vector3d::Constant(4e-4);  // about 0.03 px
  for (const PoseLoss& loss : {PoseLoss{LOSS_HUBER, 15.0f}, PoseLoss{LOSS_GEMAN_MCCLURE, 20.0f}})
    for (const KernelPath& path : cpu_paths(pool)) {
      StepCheck check{view, loss, path, steps};
      for (int i = 0; i < 2000; ++i) {
        const Se3 pose{
            random.rotation(),
            {random.uniform(-0.2, 0.2), random.uniform(-0.15, 0.15), random.uniform(0.4, 0.7)}};
        check.at(pose, random_point(random, 0.06));
      }
      EXPECT_GT(check.inside, 300);
      EXPECT_GT(check.outside, 100);
    }
}

}  // namespace
}  // namespace edgescout
