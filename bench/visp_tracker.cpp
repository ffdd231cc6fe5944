#include "bench/visp_tracker.h"

#include <visp/vpImage.h>
#include <visp/vpImageIo.h>
#include <visp/vpMbGenericTracker.h>

namespace edgescout::bench {

struct VispTracker::Parts {
  vpMbGenericTracker tracker;
  vpImage<unsigned char> image;
};

VispTracker::VispTracker(const std::string& config, const std::string& model)
    : parts_(std::make_unique<Parts>()) {
  parts_->tracker.setTrackerType(vpMbGenericTracker::EDGE_TRACKER);
  parts_->tracker.loadConfigFile(config);
  parts_->tracker.setDisplayFeatures(false);
  parts_->tracker.loadModel(model);
}
VispTracker::~VispTracker() = default;

std::array<double, 4> VispTracker::camera() const {
  vpCameraParameters k;
  parts_->tracker.getCameraParameters(k);
  return {k.get_px(), k.get_py(), k.get_u0(), k.get_v0()};
}

void VispTracker::begin(const std::string& image, const Matrix4& pose) {
  read(image);
  vpHomogeneousMatrix m;
  for (unsigned r = 0; r < 4; ++r)
    for (unsigned c = 0; c < 4; ++c) m[r][c] = pose[4 * r + c];
  parts_->tracker.initFromPose(parts_->image, m);
}

void VispTracker::read(const std::string& image) { vpImageIo::read(parts_->image, image); }

bool VispTracker::track() {
  try {
    parts_->tracker.track(parts_->image);
    return true;
  } catch (const vpException&) {
    return false;
  }
}

Matrix4 VispTracker::pose() const {
  vpHomogeneousMatrix m;
  parts_->tracker.getPose(m);
  Matrix4 pose{};
  for (unsigned r = 0; r < 4; ++r)
    for (unsigned c = 0; c < 4; ++c) pose[4 * r + c] = m[r][c];
  return pose;
}

}  // namespace edgescout::bench
