// One camera as a program writes it, and what every such file must give.
#pragma once

#include <gtest/gtest.h>

#include "host/io/camera_file.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {

struct CameraSample {
  const char* format;
  const char* file;
  std::string text;
};

inline std::ostream& operator<<(std::ostream& out, const CameraSample& sample) {
  return out << sample.format;
}

inline std::vector<FileCamera> load_text(const std::string& file, const std::string& text) {
  const TemporaryFolder folder;
  return load_cameras(folder.write(file, text));
}

inline Camera load_one(const std::string& file, const std::string& text,
                       const std::string& name = "") {
  const TemporaryFolder folder;
  return load_camera(folder.write(file, text), name);
}

inline void expect_pinhole(const Camera& camera, int width = 640, int height = 480) {
  EXPECT_EQ(camera.width, width);
  EXPECT_EQ(camera.height, height);
  EXPECT_NEAR(camera.fx, 700, 1e-9);
  EXPECT_NEAR(camera.fy, 701, 1e-9);
  EXPECT_NEAR(camera.cx, 321, 1e-9);
  EXPECT_NEAR(camera.cy, 238, 1e-9);
  EXPECT_EQ(camera.skew, 0);
}

}  // namespace edgescout::test
