#include "host/experiments/moving_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

#include "host/core/random.h"
#include "host/render/parts.h"
#include "host/render/renderer.h"

namespace edgescout {

namespace {

// Of the part, with its origin in the middle of its box, in the camera frame: one pose a frame. It
// goes round a closed path about the middle of the image.
std::vector<Se3> path_of_part(const MovingSceneOptions& options, const Camera& camera,
                              double distance_m) {
  Random random = Random(options.render.seed).split("path");
  const Eigen::Vector3d first_axis = random.direction(), second_axis = random.direction();
  const double m_per_px = distance_m / camera.fx, radius_px = 0.16 * camera.width;
  std::vector<Se3> path;
  Se3 pose;
  pose.rotation = random.rotation();
  for (int frame = 0; frame < options.frames; ++frame) {
    const double angle = options.speed_px * frame / radius_px,
                 jump_px =
                     options.jump_frame >= 0 && frame >= options.jump_frame ? options.jump_px : 0;
    pose.translation_m = {m_per_px * (radius_px * std::cos(angle) + jump_px),
                          m_per_px * radius_px * std::sin(angle),
                          distance_m * (1 + 0.06 * std::sin(0.4 * angle))};
    path.push_back(pose);
    const Eigen::Vector3d axis =
        (std::cos(0.05 * frame) * first_axis + std::sin(0.05 * frame) * second_axis).normalized();
    pose.rotation = so3_exp(options.turn_rad * axis) * pose.rotation;
  }
  return path;
}

// A board that passes before the part, at half its distance.
struct PassingBoard {
  static constexpr double speed_px = 20;  // a frame

  Object object;
  std::vector<Se3> camera_from_board;

  PassingBoard(const MovingSceneOptions& options, const Camera& camera, double distance_m,
               double diameter_m, std::span<const Se3> path) {
    const double m_per_px = 0.5 * distance_m / camera.fx,
                 side_m = 0.5 * diameter_m + options.hidden_frames * speed_px * m_per_px;
    object.id = 2;
    object.mesh = make_box({side_m, 1.5 * diameter_m, 0.002});
    const int middle = options.frames / 2;
    for (int frame = 0; frame < options.frames; ++frame) {
      Se3 pose;
      pose.translation_m = 0.5 * path[std::size_t(frame)].translation_m;
      pose.translation_m.x() += (frame - middle) * speed_px * m_per_px;
      camera_from_board.push_back(pose);
    }
  }
};

// Fingers and a palm in a plane before the part. They follow it, as the hand that carries it would.
struct Hand {
  std::vector<Object> pieces;
  std::vector<Se3> hand_from_piece;
  std::vector<Se3> camera_from_hand;

  void add(const Mesh& mesh, const Se3& placed) {
    pieces.push_back({int(pieces.size()) + 2, mesh, {}});
    hand_from_piece.push_back(placed);
  }

  // The tips of the fingers are at the hand's origin; they point along -x.
  Hand(const MovingSceneOptions& options, double distance_m, double diameter_m,
       std::span<const Se3> path) {
    const double radius_m = 0.07 * diameter_m, length_m = 0.8 * diameter_m;
    const Eigen::Quaterniond along_x = so3_exp({0, 0.5 * std::numbers::pi, 0});
    for (const double y : {-0.3, -0.1, 0.1, 0.3})
      add(make_bar(radius_m, length_m), {along_x, {0.5 * length_m, y * diameter_m, 0}});
    add(make_box({0.6 * diameter_m, 0.8 * diameter_m, 2 * radius_m}),
        {Eigen::Quaterniond::Identity(), {length_m + 0.3 * diameter_m, 0, 0}});
    const double nearer = 1 - 0.65 * diameter_m / distance_m;
    for (int frame = 0; frame < options.frames; ++frame) {
      const double reach = std::sin(std::numbers::pi * frame / options.frames);
      Se3 pose;
      pose.translation_m = nearer * path[std::size_t(frame)].translation_m;
      pose.translation_m.x() += (0.6 - (0.1 + options.hand_covers) * reach) * diameter_m;
      camera_from_hand.push_back(pose);
    }
  }
};

// Appends something to a scene, at no pose yet.
void place(SimulatedScene& scene, const Object& object) {
  scene.placed.push_back({int(scene.objects.size()), {}, {}, false, true});
  scene.objects.push_back(object);
}

}  // namespace

MovingScene make_moving_scene(const Object& object, const MovingSceneOptions& options,
                              ThreadPool& pool) {
  RenderOptions render_options = options.render;
  render_options.objects = render_options.views = 1;
  const double distance_m = object.mesh.diameter_m * render_options.focal_px /
                            (options.part_share * render_options.width);
  render_options.min_distance_m = render_options.max_distance_m = distance_m / 0.7;
  SimulatedScene scene = make_scene({&object, 1}, render_options);
  const Camera& camera = scene.views[0].camera;
  const Se3 world_from_camera = inverse(scene.views[0].camera_from_world);
  const std::vector<Se3> path = path_of_part(options, camera, distance_m);
  const Se3 part_from_object{Eigen::Quaterniond::Identity(),
                             -0.5 * (object.mesh.box_min_m + object.mesh.box_max_m)};
  std::optional<PassingBoard> board;
  if (options.hidden_frames > 0) {
    board.emplace(options, camera, distance_m, object.mesh.diameter_m, path);
    place(scene, board->object);
  }
  std::optional<Hand> hand;
  const std::size_t first_of_hand = scene.placed.size();
  if (options.hand_covers > 0) {
    hand.emplace(options, distance_m, object.mesh.diameter_m, path);
    for (const Object& piece : hand->pieces) place(scene, piece);
  }
  MovingScene moving{undistorted(camera), {}};
  for (std::size_t frame = 0; frame < path.size(); ++frame) {
    const Se3 camera_from_object = path[frame] * part_from_object;
    scene.placed[0].world_from_object = world_from_camera * camera_from_object;
    if (board)
      scene.placed[1].world_from_object = world_from_camera * board->camera_from_board[frame];
    for (std::size_t i = 0; hand && i < hand->pieces.size(); ++i)
      scene.placed[first_of_hand + i].world_from_object =
          world_from_camera * hand->camera_from_hand[frame] * hand->hand_from_piece[i];
    scene.options.seed = options.render.seed + unsigned(frame);  // of the noise
    Rendering rendering = std::move(render(scene, pool)[0]);
    moving.frames.push_back({std::move(rendering.image), std::move(rendering.measured_depth),
                             camera_from_object, rendering.visible_fraction[0]});
  }
  return moving;
}

}  // namespace edgescout
