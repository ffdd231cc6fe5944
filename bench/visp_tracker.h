// ViSP's model-based edge tracker behind plain types: its headers are not C++20.
#pragma once

#include <array>
#include <memory>
#include <string>

namespace edgescout::bench {

using Matrix4 = std::array<double, 16>;  // camera_from_object, row by row; m

class VispTracker {
 public:
  // ViSP's configuration (XML) and model (.cao). std::runtime_error: one that it does not read.
  VispTracker(const std::string& config, const std::string& model);
  ~VispTracker();
  std::array<double, 4> camera() const;  // fx, fy, cx, cy
  void begin(const std::string& image, const Matrix4& pose);
  void read(const std::string& image);
  bool track();  // the image that was read last; false: lost
  Matrix4 pose() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace edgescout::bench
