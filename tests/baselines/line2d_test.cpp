// Scores of given candidates: LINE-2D on drawn and rendered images, FDCM against its sum computed
// here.
#include "host/baselines/candidate_scores.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/core/thinned.h"
#include "kernels/error.h"
#include "tests/active/rendered_scene.h"
#include "tests/register/scene.h"
#include "tests/test_random.h"

namespace edgescout {
namespace {

using namespace test;

ObjectView view_of_image(const Image& image) {
  ObjectView view;
  view.camera = scene_camera();
  view.image = std::make_shared<Image>(image);
  return view;
}

// A bright square of 60 mm, 0.4 m from the camera, turned in the image: 105 px per side.
constexpr double square_m = 0.06, square_z_m = 0.4;
Image drawn_square(double turn_rad, double shift_x_px = 0) {
  const Camera camera = scene_camera();
  Image image{camera.width, camera.height, {}};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double u = x - camera.cx - shift_x_px, v = y - camera.cy, c = std::cos(turn_rad),
                   s = std::sin(turn_rad);
      const double half_px = 0.5 * square_m * camera.fx / square_z_m;
      image.pixels.push_back(
          std::abs(c * u + s * v) < half_px && std::abs(c * v - s * u) < half_px ? 190 : 40);
    }
  return image;
}

class Line2d : public ::testing::Test {
 protected:
  // Of a flat box with the square as its front.
  double score(const Image& image, const Se3& camera_from_object,
               const Line2dOptions& options = {}) {
    ObjectView view = view_of_image(image);
    const Camera& c = view.camera;
    view.tensor = backend->make_view({}, c.width, c.height, {}, intrinsics_of(c), {});
    const ObjectPose candidate{0, camera_from_object};
    return line2d_scores({{&box, 1}, {&view, 1}, *backend}, {&candidate, 1}, options)[0];
  }
  static Se3 square_pose(double turn_rad, double shift_x_m = 0) {
    return {Eigen::Quaterniond(Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ())),
            {shift_x_m, 0, square_z_m + 0.001}};
  }
  std::unique_ptr<Backend> backend = make_cpu_backend(2);
  EdgeModel box = make_edge_model(make_box({square_m, square_m, 0.002}));
};

// For all turns of the square, so for all directions: the labels equal OpenCV's.
TEST_F(Line2d, IsCompleteOnADrawingOfTheObject) {
  for (int step = 0; step < 16; ++step) {
    const double turn = step * std::numbers::pi / 32;
    EXPECT_GT(score(drawn_square(turn), square_pose(turn)), 98) << step;
  }
}

// Blur and spread tolerate a few pixels. Chance gives a half.
TEST_F(Line2d, FallsWithTheDistanceFromTheObject) {
  const Image image = drawn_square(0.3);
  const double px_m = square_z_m / scene_camera().fx;
  const double at_truth = score(image, square_pose(0.3)),
               off_3_px = score(image, square_pose(0.3, 3 * px_m)),
               off_10_px = score(image, square_pose(0.3, 10 * px_m)),
               turned = score(image, square_pose(0.3 + 0.25));
  EXPECT_GT(at_truth, 98);
  EXPECT_GT(off_3_px, 95);
  EXPECT_LT(off_10_px, 55);
  EXPECT_LT(turned, 75);
}

// The right half of the square lies outside.
TEST_F(Line2d, CountsFeaturesOutsideTheImageAsMissed) {
  const Camera camera = scene_camera();
  const double right_px = camera.width - 0.5 - camera.cx;
  const Se3 pose = square_pose(0, right_px * square_z_m / camera.fx);
  const std::vector<ModelPoint> features =
      thinned(visible_edges(box, std::span(&pose, 1), *backend)[0], Line2dOptions{}.features);
  const auto inside = std::ranges::count_if(features, [&](const ModelPoint& point) {
    return land(intrinsics_of(camera), pose, point).u <= camera.width - 1;
  });
  EXPECT_NEAR(score(drawn_square(0, right_px), pose),
              100.0 * double(inside) / double(features.size()), 1);
  EXPECT_LT(inside, 40);
}

TEST_F(Line2d, SeesNothingInABlankImageOrBehindTheCamera) {
  Image blank = drawn_square(0);
  std::ranges::fill(blank.pixels, 90);
  EXPECT_EQ(score(blank, square_pose(0)), 0);
  EXPECT_EQ(score(drawn_square(0), {{}, {0, 0, -0.4}}), 0);
}

TEST_F(Line2d, RefusesOptionsOutOfRange) {
  const auto expect_refused = [&](const char* field, const auto& spoil) {
    Line2dOptions options;
    spoil(options);
    try {
      score(drawn_square(0), square_pose(0), options);
      ADD_FAILURE() << field;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(field), std::string::npos) << error.what();
    }
  };
  expect_refused("features", [](Line2dOptions& o) { o.features = 64; });
  expect_refused("features", [](Line2dOptions& o) { o.features = 0; });
  expect_refused("spread_px", [](Line2dOptions& o) { o.spread_px = 4; });
  expect_refused("weak_gradient", [](Line2dOptions& o) {
    o.weak_gradient = std::numeric_limits<float>::quiet_NaN();
  });
}

TEST_F(Line2d, WantsAnImageAndTheModel) {
  ObjectView view;
  view.camera = scene_camera();
  const ObjectPose candidate{1, {}};
  EXPECT_THROW(line2d_scores({{&box, 1}, {&view, 1}, *backend}, {}), LogicError);
  view = view_of_image(drawn_square(0));
  EXPECT_THROW(line2d_scores({{&box, 1}, {&view, 1}, *backend}, {&candidate, 1}), LogicError);
  EXPECT_THROW(line2d_scores({{&box, 1}, {}, *backend}, {}), LogicError);
}

// Three parts on a board, each at its true pose and at 20 poses near it.
TEST(CandidateScores, PreferTheTruthInRenderedImages) {
  const std::unique_ptr<Backend> backend = make_cpu_backend(2);
  const RenderedScene scene({"l_bracket", "bearing_block", "u_channel"}, 3, 1);
  const ObjectView view = scene.view(0, *backend);
  Random random = test_random();
  for (std::size_t placed = 0; placed < 3; ++placed) {
    const PlacedObject& object = scene.scene.placed[placed];
    std::vector<ObjectPose> candidates{{object.object, object.world_from_object}};
    for (int i = 0; i < 20; ++i) candidates.push_back(scene.candidate(placed, 0.015, 0.3, random));
    const Scene one{scene.models, {&view, 1}, *backend};
    const std::vector<double> line2d = line2d_scores(one, candidates),
                              fdcm = fdcm_scores(one, candidates);
    EXPECT_GT(line2d[0], 80);
    EXPECT_LT(fdcm[0], 5);
    EXPECT_EQ(std::ranges::max_element(line2d), line2d.begin());
    EXPECT_EQ(std::ranges::min_element(fdcm), fdcm.begin());
  }
}

// Inside the image, across its border, outside, behind the camera.
TEST(CandidateScores, OfFdcmAreMeansOverAllVisiblePoints) {
  const std::unique_ptr<Backend> backend = make_cpu_backend(2);
  Random random = test_random();
  const PartScene scene("l_bracket", 1, random, *backend);
  const ObjectView& view = scene.views[0];
  const Se3 truth = view.camera_from_world * scene.truth;
  std::vector<Se3> camera_from_object;
  std::vector<ObjectPose> candidates;
  for (const Eigen::Vector3d& shift :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0.01, -0.02, 0.03), Eigen::Vector3d(0.12, 0, 0),
        Eigen::Vector3d(0.4, 0, 0), Eigen::Vector3d(0, 0, -0.8)}) {
    camera_from_object.push_back({truth.rotation, truth.translation_m + shift});
    candidates.push_back({0, inverse(view.camera_from_world) * camera_from_object.back()});
  }
  const std::vector<double> scores = fdcm_scores(scene.on(*backend), candidates);
  const std::vector<std::uint16_t> tensor = view.tensor->tensor();
  const TensorView values{tensor, view.tensor->shape, view.tensor->intrinsics};
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Se3& pose = camera_from_object[i];
    const std::vector<ModelPoint> points =
        visible_edges(scene.model, std::span(&pose, 1), *backend)[0];
    double sum = 0;
    for (const ModelPoint& point : points) {
      const Landing at = land(values.intrinsics, pose, point);
      const bool inside = at.u >= 0 && at.v >= 0 && at.u <= values.shape.width - 1 &&
                          at.v <= values.shape.height - 1;
      sum += inside ? tensor_lookup(values, float(at.u), float(at.v), float(at.theta), nullptr)
                    : view.tensor->options.cap_px;
    }
    const double expected =
        points.empty() ? view.tensor->options.cap_px : sum / double(points.size());
    EXPECT_NEAR(scores[i], expected, 2e-3 * (1 + expected)) << i;
  }
  EXPECT_LT(scores[0], 2);
  EXPECT_EQ(scores[3], view.tensor->options.cap_px);
  EXPECT_EQ(scores[4], view.tensor->options.cap_px);
}

}  // namespace
}  // namespace edgescout
