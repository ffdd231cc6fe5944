// What a prior admits, by brute force over vertices and places along rays.
#include "host/detect/search_space.h"

#include <gtest/gtest.h>

#include "tests/register/scene.h"
#include "tests/test_random.h"

namespace edgescout::test {
namespace {

Eigen::Vector3d place_in(const Eigen::AlignedBox3d& box, Random& random) {
  return {random.uniform(box.min().x(), box.max().x()),
          random.uniform(box.min().y(), box.max().y()),
          random.uniform(box.min().z(), box.max().z())};
}

const Eigen::AlignedBox3d& world_m() {
  static const Eigen::AlignedBox3d box(Eigen::Vector3d(-0.5, -0.5, -0.5),
                                       Eigen::Vector3d(0.5, 0.5, 0.5));
  return box;
}

WorldPrior random_box(Random& random) {
  const Eigen::Vector3d one = place_in(world_m(), random), other = place_in(world_m(), random);
  WorldPrior prior;
  prior.box_m = {one.x(), one.y(), one.z(), other.x(), other.y(), other.z()};
  return prior;
}

WorldPrior random_plane(Random& random) {
  const Eigen::Vector3d normal = random.direction();
  WorldPrior prior;
  prior.plane = {normal.x(), normal.y(), normal.z(), random.uniform(-0.2, 0.2)};
  prior.plane_tolerance_m = random.uniform(0, 0.01);
  return prior;
}

Se3 random_camera(Random& random) {
  return inverse({random.rotation(), random.uniform(0.2, 1.5) * random.direction()});
}

Se3 random_pose(const EdgeModel& model, Random& random) {
  const Eigen::Quaterniond rotation = random.rotation();
  return {rotation, place_in(world_m(), random) - rotation * model.center_m};
}

// How far a pose lies inside the prior; negative: outside. By all vertices.
double margin_m(const WorldPrior& prior, const EdgeModel& model, const Se3& world_from_object) {
  double margin = INFINITY;
  if (!prior.box_m.empty()) {
    const Eigen::Vector3d center = world_from_object * model.center_m;
    for (int axis = 0; axis < 3; ++axis) {
      const auto [low, high] = std::minmax(prior.box_m[axis], prior.box_m[axis + 3]);
      margin = std::min({margin, center[axis] - low, high - center[axis]});
    }
  }
  if (!prior.plane.empty())
    for (const Eigen::Vector3d& vertex : model.mesh.vertices_m) {
      const Eigen::Vector3d at = world_from_object * vertex;
      margin =
          std::min(margin, prior.plane[0] * at.x() + prior.plane[1] * at.y() +
                               prior.plane[2] * at.z() - prior.plane[3] + prior.plane_tolerance_m);
    }
  return margin;
}

std::vector<WorldPrior> random_priors(Random& random) {
  WorldPrior both = random_box(random);
  const WorldPrior plane = random_plane(random);
  both.plane = plane.plane;
  return {random_box(random), plane, both};
}

TEST(SearchSpace, AdmitsThePosesWithinBoxAndAbovePlane) {
  const EdgeModel model = part_model("l_bracket");
  Random random = test_random();
  int admitted = 0, all = 0;
  for (int i = 0; i < 200; ++i)
    for (const WorldPrior& prior : random_priors(random)) {
      const Se3 camera_from_world = random_camera(random);
      const SearchSpace space(prior, model, camera_from_world);
      for (int p = 0; p < 20; ++p) {
        const Se3 pose = random_pose(model, random);
        const double margin = margin_m(prior, model, pose);
        if (std::abs(margin) < 1e-7) continue;
        EXPECT_EQ(space.admits(camera_from_world * pose), margin > 0) << margin;
        admitted += margin > 0, ++all;
      }
    }
  EXPECT_GT(admitted, all / 20);
  EXPECT_LT(admitted, all / 2);
}

TEST(SearchSpace, AdmitsEveryPoseWithoutAPrior) {
  const EdgeModel model = part_model("l_bracket");
  Random random = test_random();
  const SearchSpace space({}, model, random_camera(random));
  EXPECT_TRUE(space.is_everywhere());
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(space.admits(random_pose(model, random)));
  EXPECT_TRUE(space.meets(random.direction(), 1));
}

// The vertices of a ball are too many to be compared one by one.
TEST(SearchSpace, KnowsTheLowestPointOfADenseMesh) {
  EdgeModel ball = part_model("l_bracket");
  ball.center_m = {0.01, 0.02, 0.03};
  ball.radius_m = 0.05;
  ball.mesh.vertices_m = icosphere(20);
  ball.occluding.vertices_m.clear();
  for (Eigen::Vector3d& vertex : ball.mesh.vertices_m) {
    vertex = ball.center_m + ball.radius_m * vertex;
    for (const double number : vertex) ball.occluding.vertices_m.push_back(float(number));
  }
  Random random = test_random();
  for (int i = 0; i < 500; ++i) {
    const WorldPrior prior = random_plane(random);
    const Se3 camera_from_world = random_camera(random), pose = random_pose(ball, random);
    const double margin = margin_m(prior, ball, pose);
    if (std::abs(margin) > 0.01 * ball.radius_m) {
      EXPECT_EQ(SearchSpace(prior, ball, camera_from_world).admits(camera_from_world * pose),
                margin > 0)
          << margin;
    }
  }
}

// Poses moved by less than the slack from admitted ones.
TEST(SearchSpace, AdmitsPosesBesideThePriorWithSlack) {
  const EdgeModel model = part_model("l_bracket");
  const SearchSlack slack{0.02, 1.2};
  Random random = test_random();
  int beside = 0;
  for (int i = 0; i < 3000; ++i)
    for (const WorldPrior& prior : random_priors(random)) {
      const Se3 camera_from_world = random_camera(random), pose = random_pose(model, random);
      if (margin_m(prior, model, pose) < 0) continue;
      Se3 moved = camera_from_world * pose;
      moved.translation_m += 0.019 * random.direction();
      const Eigen::Vector3d center = moved * model.center_m;
      const double half_way = std::sqrt(1.199);
      moved.translation_m += (random.uniform(1 / half_way, half_way) - 1) * center;
      const SearchSpace space(prior, model, camera_from_world);
      EXPECT_TRUE(space.admits(moved, slack));
      beside += !space.admits(moved);
    }
  EXPECT_GT(beside, 30);
}

TEST(SearchSpace, RejectsPosesFartherThanTheSlack) {
  const EdgeModel model = part_model("l_bracket");
  Random random = test_random();
  for (int i = 0; i < 3000; ++i)
    for (const WorldPrior& prior : random_priors(random)) {
      const Se3 camera_from_world = random_camera(random), pose = random_pose(model, random);
      if (margin_m(prior, model, pose) < -0.021) {
        EXPECT_FALSE(SearchSpace(prior, model, camera_from_world)
                         .admits(camera_from_world * pose, {0.02, 1}));
      }
    }
}

// Wherever an object is admitted, the line of sight to its centre meets the prior.
TEST(SearchSpace, MeetsThePlacesOfAllAdmittedPoses) {
  const EdgeModel model = part_model("l_bracket");
  Random random = test_random();
  for (int i = 0; i < 3000; ++i)
    for (const WorldPrior& prior : random_priors(random)) {
      const Se3 camera_from_world = random_camera(random);
      const SearchSpace space(prior, model, camera_from_world);
      const Se3 pose = camera_from_world * random_pose(model, random);
      const Eigen::Vector3d center = pose * model.center_m;
      for (const SearchSlack& slack : {SearchSlack{}, SearchSlack{0.02, 1.1}}) {
        if (!space.admits(pose, slack)) continue;
        EXPECT_TRUE(space.meets(center.normalized(), center.norm(), slack));
      }
    }
}

// Against places sampled along the ray.
TEST(SearchSpace, MeetsABoxWhereTheRayEntersIt) {
  const EdgeModel model = part_model("l_bracket");
  Random random = test_random();
  int met = 0;
  for (int i = 0; i < 2000; ++i) {
    const WorldPrior prior = random_box(random);
    const Se3 camera_from_world = random_camera(random),
              world_from_camera = inverse(camera_from_world);
    const Eigen::Vector3d ray = (camera_from_world * place_in(world_m(), random)).normalized();
    const double distance_m = random.uniform(0.1, 1.5);
    const SearchSlack slack{0.01, 1.3};
    double most_inside = -INFINITY;
    for (double t = distance_m / std::sqrt(1.3); t <= distance_m * std::sqrt(1.3); t += 2e-4) {
      const Eigen::Vector3d at = world_from_camera * (t * ray);
      most_inside =
          std::max(most_inside,
                   margin_m(prior, model, {Eigen::Quaterniond::Identity(), at - model.center_m}));
    }
    if (std::abs(most_inside + slack.place_m) < 4e-4) continue;
    const bool meets = SearchSpace(prior, model, camera_from_world).meets(ray, distance_m, slack);
    EXPECT_EQ(meets, most_inside > -slack.place_m) << most_inside;
    met += meets;
  }
  EXPECT_GT(met, 50);
}

TEST(SearchSpace, IsTheSameInAnotherWorld) {
  const EdgeModel model = part_model("l_bracket");
  Random random = test_random();
  for (int i = 0; i < 1000; ++i)
    for (const WorldPrior& prior : random_priors(random)) {
      const Se3 camera_from_world = random_camera(random);
      WorldPrior of_camera = prior;
      of_camera.prior_from_world = inverse(camera_from_world);
      const Se3 pose = camera_from_world * random_pose(model, random);
      EXPECT_EQ(SearchSpace(of_camera, model, Se3{}).admits(pose),
                SearchSpace(prior, model, camera_from_world).admits(pose));
    }
}

}  // namespace
}  // namespace edgescout::test
