/* A depth image of the example scenes: a tilted plane through their parts, with a hole. */
#ifndef EDGESCOUT_TESTS_DEPTH_VALUES_H
#define EDGESCOUT_TESTS_DEPTH_VALUES_H

static inline unsigned depth_mm_at(int x, int y) {
  if (x >= 20 && x < 60 && y >= 100 && y < 140) return 0;
  return (unsigned)(330 + y / 16 + x / 64);
}

/* A depth camera beside the camera of scenes/000000's window. */
#define DEPTH_WIDTH 160
#define DEPTH_HEIGHT 170
static const double depth_focal_px = 520, depth_center_px[2] = {240, 60};
static const double camera_from_depth_rows[16] = {
    0.9999500004166653,    0, 0.009999833334166664, -0.015, 0, 1, 0, 0.002,
    -0.009999833334166664, 0, 0.9999500004166653,   0,      0, 0, 0, 1};

#endif
