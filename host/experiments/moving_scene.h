// Rendered sequences of one moving part with known poses: what a tracker is judged by.
#pragma once

#include <vector>

#include "host/core/depth_image.h"
#include "host/core/types.h"
#include "host/render/scene.h"

namespace edgescout {

class ThreadPool;

struct MovingSceneOptions {
  RenderOptions render;  // of the board, the light and the camera, which stand still
  int frames = 60;
  double part_share = 0.25;  // of the image's width that the part's diameter spans
  double speed_px = 4;       // of the part in the image, a frame; the direction changes slowly
  double turn_rad = 0.02;    // a frame, about a slowly changing axis
  int jump_frame = -1;       // the part is moved between two frames before this one; -1: never
  double jump_px = 60;       // by so much
  // A bar passes before the part and hides all of it for so many frames in the middle; 0: none.
  int hidden_frames = 0;
  // A hand of four fingers reaches over the part, close before it, and covers so much of the part's
  // diameter in the middle of the sequence; 0: none.
  double hand_covers = 0;
};

struct MovingFrame {
  Image image;
  DepthImage depth;  // as measured by render.depth; empty where that is off
  Se3 camera_from_object;
  double visible = 0;  // share of the part's silhouette, also outside the image
};

struct MovingScene {
  Camera camera;
  std::vector<MovingFrame> frames;
};

// The part moves about the middle of the image above the board. Options and object determine the
// sequence. InputError: options out of bounds.
MovingScene make_moving_scene(const Object& object, const MovingSceneOptions& options,
                              ThreadPool& pool);

}  // namespace edgescout
