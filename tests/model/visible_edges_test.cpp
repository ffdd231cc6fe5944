// Visible edge points of solids whose contours are known in closed form.
#include "host/model/visible_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "host/render/parts.h"
#include "kernels/error.h"
#include "tests/model/solids.h"
#include "tests/test_random.h"

namespace edgescout {
namespace {

using namespace test;

constexpr double degree = std::numbers::pi / 180;

Eigen::Vector3d position(const ModelPoint& p) { return {p.x_m, p.y_m, p.z_m}; }
Eigen::Vector3d tangent(const ModelPoint& p) { return {p.tx, p.ty, p.tz}; }

class VisibleEdges : public ::testing::Test {
 protected:
  std::vector<ModelPoint> seen(const EdgeModel& model, const Se3& camera_from_object) {
    return visible_edges(model, std::span(&camera_from_object, 1), *backend)[0];
  }
  std::unique_ptr<Backend> backend = make_cpu_backend(2);
};

// A camera at `eye_m` of the object frame that looks at the origin.
Se3 looking_from(const Eigen::Vector3d& eye_m) {
  const Eigen::Vector3d z = -eye_m.normalized(), x = z.unitOrthogonal(), y = z.cross(x);
  Eigen::Matrix3d camera_from_object;
  camera_from_object << x.transpose(), y.transpose(), z.transpose();
  return se3_from_matrix(camera_from_object, -camera_from_object * eye_m);
}

// Index of the cube's edge a point lies on: for each of the axes, four combinations of the other
// two signs.
int cube_edge(const ModelPoint& point, double half_m) {
  int axis;
  tangent(point).cwiseAbs().maxCoeff(&axis);
  const Eigen::Vector3d x = position(point);
  const int a = (axis + 1) % 3, b = (axis + 2) % 3;
  EXPECT_NEAR(std::abs(x[a]), half_m, 1e-6);
  EXPECT_NEAR(std::abs(x[b]), half_m, 1e-6);
  return 4 * axis + 2 * (x[a] > 0) + (x[b] > 0);
}

// Fraction of visible raster points per edge.
std::array<double, 12> seen_share(const std::vector<ModelPoint>& points, double half_m,
                                  double step_m) {
  std::array<double, 12> share{};
  for (const ModelPoint& point : points) share[cube_edge(point, half_m)] += step_m / (2 * half_m);
  return share;
}

TEST_F(VisibleEdges, CubeFromTheFrontShowsFourEdges) {
  const double half = 0.05, step = 0.001;
  const EdgeModel cube = model_of(make_box({2 * half, 2 * half, 2 * half}), step);
  const auto share = seen_share(seen(cube, looking_from({0, 0, 0.5})), half, step);
  for (int edge = 0; edge < 12; ++edge) {
    const bool front = edge < 8 && (edge / 4 == 0 ? edge % 2 == 1 : edge % 4 >= 2);  // z > 0
    if (front)
      EXPECT_NEAR(share[edge], 1, 0.03) << edge;
    else if (edge < 8)
      EXPECT_EQ(share[edge], 0) << edge;
    else
      // Running away from the camera, hidden but for what lies within a map pixel or two of the
      // front's corner.
      EXPECT_LT(share[edge], 0.25) << edge;
  }
}

TEST_F(VisibleEdges, CubeFromACornerShowsNineEdges) {
  const double half = 0.05, step = 0.001;
  const EdgeModel cube = model_of(make_box({2 * half, 2 * half, 2 * half}), step);
  Random random = test_random();
  for (int i = 0; i < 20; ++i) {
    // Any octant, no face seen too flat.
    Eigen::Vector3d sign, eye;
    for (int k = 0; k < 3; ++k) {
      sign[k] = random.uniform() < 0.5 ? -1 : 1;
      eye[k] = sign[k] * random.uniform(0.2, 0.4);
    }
    const auto share = seen_share(seen(cube, looking_from(eye)), half, step);
    for (int axis = 0; axis < 3; ++axis) {
      const int hidden = 4 * axis + 2 * (sign[(axis + 1) % 3] < 0) + (sign[(axis + 2) % 3] < 0);
      for (int edge = 4 * axis; edge < 4 * axis + 4; ++edge) {
        if (edge == hidden)
          EXPECT_LT(share[edge], 0.1) << "of the three at the far corner";
        else
          EXPECT_NEAR(share[edge], 1, 0.03) << edge;
      }
    }
  }
}

// Six edges border the background. The three that meet at the near corner do so at their far ends
// only, within two of the map's pixels. Of the hidden ones a pixel or two are seen.
TEST_F(VisibleEdges, CubeFromACornerMarksItsSilhouette) {
  const double half = 0.05;
  const EdgeModel cube = model_of(make_box({2 * half, 2 * half, 2 * half}), 0.001);
  const Se3 camera_from_object = looking_from({0.3, 0.32, 0.28});
  std::vector<SilhouetteMarks> marks;
  const std::vector<ModelPoint> points =
      visible_edges(cube, {&camera_from_object, 1}, *backend, {}, &marks)[0];
  ASSERT_EQ(marks.size(), 1u);
  ASSERT_EQ(marks[0].size(), points.size());
  int inside = 0, outside = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d x = position(points[i]);
    const bool meets_near_corner = (x.array() > half - 1e-6).count() >= 2;
    const bool meets_far_corner = (x.array() < -half + 1e-6).count() >= 2;
    if (meets_far_corner || (meets_near_corner && x.minCoeff() < -half + 0.005)) continue;
    (meets_near_corner ? inside : outside) += 1;
    EXPECT_EQ(marks[0][i] != 0, !meets_near_corner) << x.transpose();
  }
  EXPECT_GT(inside, 250);
  EXPECT_GT(outside, 550);
}

TEST_F(VisibleEdges, NoPointComesTwice) {
  const double step = 0.001;
  for (const Mesh& mesh : {make_box({0.1, 0.08, 0.06}), make_part("l_bracket").mesh}) {
    const std::vector<ModelPoint> points =
        seen(model_of(mesh, step), looking_from({0.2, 0.25, 0.3}));
    ASSERT_GT(points.size(), 100u);
    // A point drawn by two faces would have a twin at its place with the same direction.
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t j = i + 1; j < points.size(); ++j)
        if ((position(points[i]) - position(points[j])).norm() < 0.1 * step) {
          EXPECT_LT(std::abs(tangent(points[i]).dot(tangent(points[j]))), 0.9) << mesh.name;
        }
  }
}

// Seen from `eye` the contour of a sphere about the origin is the circle where n . (eye - r n) = 0.
TEST_F(VisibleEdges, SphereShowsItsCircle) {
  const double radius = 0.05;
  const EdgeModel sphere = model_of(icosphere(radius, 4), 0.001);
  Random random = test_random();
  for (int i = 0; i < 10; ++i) {
    const double distance = random.uniform(0.15, 1.0);
    const Eigen::Vector3d to_eye = random.direction();
    const double height = radius * radius / distance,
                 circle = std::sqrt(radius * radius - height * height);
    const std::vector<ModelPoint> points = seen(sphere, looking_from(distance * to_eye));
    std::vector<double> angles;
    const Eigen::Vector3d u = to_eye.unitOrthogonal(), v = to_eye.cross(u);
    for (const ModelPoint& point : points) {
      const Eigen::Vector3d x = position(point), across = x - x.dot(to_eye) * to_eye;
      EXPECT_NEAR(across.norm(), circle, 0.01 * radius);
      EXPECT_NEAR(x.dot(to_eye), height, 0.01 * radius);
      EXPECT_GT(std::abs(tangent(point).dot(to_eye.cross(across).normalized())),
                std::cos(7 * degree));
      angles.push_back(std::atan2(across.dot(v), across.dot(u)));
    }
    // All of it, and as densely as asked for.
    EXPECT_NEAR(double(points.size()), 2 * std::numbers::pi * circle / 0.001,
                0.1 * double(points.size()));
    std::ranges::sort(angles);
    for (std::size_t k = 1; k < angles.size(); ++k)
      EXPECT_LT(angles[k] - angles[k - 1], 8 * degree);
  }
}

// From the side a cylinder about z shows two straight lines where cos(phi - phi_eye) = radius /
// distance from the axis.
TEST_F(VisibleEdges, CylinderShowsLinesThatFollowTheEye) {
  const double radius = 0.02, length = 0.1;
  const EdgeModel bar = model_of(make_bar(radius, length), 0.001);
  Random random = test_random();
  for (int i = 0; i < 20; ++i) {
    const double phi_eye = random.uniform(-std::numbers::pi, std::numbers::pi),
                 off_axis = random.uniform(0.1, 0.6);
    const Eigen::Vector3d eye(off_axis * std::cos(phi_eye), off_axis * std::sin(phi_eye),
                              random.uniform(-0.1, 0.1));
    int on_side[2] = {};
    for (const ModelPoint& point : seen(bar, looking_from(eye))) {
      const Eigen::Vector3d x = position(point);
      if (std::abs(std::abs(x.z()) - length / 2) < 1e-6) continue;  // a rim
      const double phi = std::remainder(std::atan2(x.y(), x.x()) - phi_eye, 2 * std::numbers::pi);
      EXPECT_NEAR(std::abs(phi), std::acos(radius / off_axis), 1.5 * degree);
      EXPECT_NEAR(x.head<2>().norm(), radius, 0.01 * radius);
      EXPECT_GT(std::abs(tangent(point).z()), std::cos(2 * degree));
      ++on_side[phi > 0];
    }
    for (const int count : on_side) EXPECT_NEAR(count, length / 0.001, 8);
  }
}

// Of the far rim of an upright cylinder only the half facing the camera's side is seen; the near
// rim is seen all around.
TEST_F(VisibleEdges, CylinderHidesTheBackOfItsFarRim) {
  const double radius = 0.02, length = 0.1;
  const EdgeModel bar = model_of(make_bar(radius, length), 0.0005);
  const Eigen::Vector3d eye(0.3, 0, 0.3);
  double near_rim = 0, far_front = 0, far_back = 0;
  for (const ModelPoint& point : seen(bar, looking_from(eye))) {
    const Eigen::Vector3d x = position(point);
    if (x.z() > length / 2 - 1e-6) near_rim += 0.0005;
    if (x.z() < -length / 2 + 1e-6) (x.x() > 0 ? far_front : far_back) += 0.0005;
  }
  const double half_rim = std::numbers::pi * radius;
  EXPECT_NEAR(near_rim, 2 * half_rim, 0.1 * half_rim);
  EXPECT_GT(far_front, 0.85 * half_rim);
  EXPECT_LT(far_back, 0.15 * half_rim);
}

TEST_F(VisibleEdges, AnObjectBehindTheCameraShowsNothing) {
  const EdgeModel cube = model_of(make_box({0.1, 0.1, 0.1}), 0.002);
  for (const double z : {-0.5, -0.01, 0.0})
    EXPECT_TRUE(seen(cube, {Eigen::Quaterniond::Identity(), {0.02, 0.01, z}}).empty()) << z;
}

TEST_F(VisibleEdges, ManyPosesAreSeenAsEachAloneAndByAnyNumberOfThreads) {
  const EdgeModel model = model_of(make_part("stepped_shaft").mesh, 0.002);
  Random random = test_random();
  std::vector<Se3> poses;
  for (int i = 0; i < 150; ++i)  // more than one batch
    poses.push_back(
        {random.rotation(),
         {random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(0.2, 0.8)}});
  const auto equal = [](const std::vector<ModelPoint>& a, const std::vector<ModelPoint>& b) {
    return std::ranges::equal(a, b, [](const ModelPoint& p, const ModelPoint& q) {
      return position(p) == position(q) && tangent(p) == tangent(q);
    });
  };
  const auto by_one = visible_edges(model, poses, *make_cpu_backend(1));
  const auto by_three = visible_edges(model, poses, *make_cpu_backend(3));
  ASSERT_EQ(by_one.size(), poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_TRUE(equal(by_one[i], by_three[i])) << i;
    EXPECT_FALSE(by_one[i].empty());
    if (i % 30 == 0) {
      EXPECT_TRUE(equal(by_one[i], seen(model, poses[i]))) << i;
    }
  }
}

TEST_F(VisibleEdges, ReferenceBackendSeesTheSame) {
  const EdgeModel model = model_of(make_part("l_bracket").mesh, 0.002);
  const std::unique_ptr<Backend> reference = make_reference_backend();
  Random random = test_random();
  for (int i = 0; i < 5; ++i) {
    const Se3 pose{random.rotation(), {0.02, -0.01, 0.3}};
    const std::size_t expected = visible_edges(model, std::span(&pose, 1), *reference)[0].size();
    // The depth maps may differ in a few border pixels.
    EXPECT_NEAR(double(seen(model, pose).size()), double(expected), 0.01 * double(expected));
  }
}

TEST(ToPose, IsTheTransformRowByRow) {
  Random random = test_random();
  const Se3 b_from_a{random.rotation(), {1, 2, 3}};
  const Pose pose = to_pose(b_from_a);
  const Eigen::Vector3d x(0.3, -0.2, 0.7), moved = b_from_a * x;
  for (int row = 0; row < 3; ++row) {
    const float* m = pose.m + 4 * row;
    EXPECT_NEAR(m[0] * x.x() + m[1] * x.y() + m[2] * x.z() + m[3], moved[row], 1e-6);
  }
}

}  // namespace
}  // namespace edgescout
