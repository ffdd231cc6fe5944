// The two times the project promises, as multiples of a yardstick timed in the same loop: Y =
// cv::distanceTransform (DIST_L2, 5x5, one thread) of a 1024x768 binary image.
//
//   edgescout_bench_yardstick [DEVICE...]      default: cpu and every Vulkan device
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <iostream>
#include <opencv2/imgproc.hpp>

#include "host/core/random.h"
#include "host/register/refine.h"
#include "host/render/parts.h"

namespace {

using namespace edgescout;
constexpr int width = 1024, height = 768;

double milliseconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + values.size() / 2);
  return values[values.size() / 2];
}

// 300 random segments of 100 points: as many edge points as a cluttered photograph has.
std::vector<EdgePoint> random_edges() {
  Random random(1);
  std::vector<EdgePoint> edges;
  for (int s = 0; s < 300; ++s) {
    const double x = random.uniform(0, width), y = random.uniform(0, height),
                 theta = random.uniform(0, 3.14159);
    for (int i = 0; i < 100; ++i)
      edges.push_back(
          {float(x + i * std::cos(theta)), float(y + i * std::sin(theta)), float(theta), 10});
  }
  return edges;
}

struct RegistrationCase {
  std::vector<EdgeModel> models;
  std::vector<ObjectPose> starts;
  std::vector<ObjectView> views;
};

// 40 starts 0.1 rad and 5 mm about a part seen with some 1,500 edge points.
RegistrationCase registration_case(Backend& backend) {
  RegistrationCase c;
  const Object part = make_part("bearing_block");
  c.models = {make_edge_model(part.mesh, {.raster_step_m = 0.0004})};
  const Camera camera{width, height, 1200, 1200, 511.5, 383.5, {}};
  const Se3 truth{so3_exp({2.4, 0.5, 0.3}), {0.01, 0.005, 0.5}};
  const std::vector<ModelPoint> points =
      visible_edges(c.models[0], std::vector<Se3>{truth}, backend)[0];
  std::vector<EdgePoint> edges = random_edges();
  for (const ModelPoint& p : points) {
    const Eigen::Vector3d x = truth * Eigen::Vector3d(p.x_m, p.y_m, p.z_m),
                          t = truth.rotation * Eigen::Vector3d(p.tx, p.ty, p.tz);
    const Eigen::Vector2d at = project(camera, x), beyond = project(camera, x + 1e-4 * t);
    const double theta = std::atan2(beyond.y() - at.y(), beyond.x() - at.x());
    edges.push_back(
        {float(at.x()), float(at.y()), float(theta < 0 ? theta + 3.14159265 : theta), 50});
  }
  const Intrinsics k{1200, 1200, 511.5f, 383.5f};
  ObjectView view;
  view.camera = camera;
  view.tensor = backend.make_view(edges, width, height, {}, k, {});
  view.edges = std::make_shared<EdgeIndex>(edges, width, height);
  c.views = {view};
  Random random(2);
  for (int i = 0; i < 40; ++i) {
    Vector6d offset;
    offset << 0.005 * random.direction(), 0.1 * random.direction();
    c.starts.push_back({0, retract(truth, offset)});
  }
  std::printf("registration: %zu visible points\n", points.size());
  return c;
}

void measure(const std::string& device) {
  const std::unique_ptr<Backend> backend = make_backend(device);
  const std::vector<EdgePoint> edges = random_edges();
  cv::setNumThreads(1);
  cv::Mat binary(height, width, CV_8U, cv::Scalar(255)), distance;
  for (const EdgePoint& e : edges)
    if (const int x = int(e.x_px), y = int(e.y_px); x >= 0 && x < width && y >= 0 && y < height)
      binary.at<uchar>(y, x) = 0;
  const RegistrationCase c = registration_case(*backend);
  RefineOptions options;
  options.search.rotation_rad = 0;
  std::vector<double> yardstick, tensor, registration;
  for (int i = 0; i < 12; ++i) {
    const double y = milliseconds([&] { cv::distanceTransform(binary, distance, cv::DIST_L2, 5); });
    const double t = milliseconds([&] {
      backend->make_view(edges, width, height, {}, {1200, 1200, 511.5f, 383.5f}, {});
    });
    const double r = milliseconds([&] {
                       refine_poses({c.models, c.views, *backend}, c.starts, options);
                     }) /
                     double(c.starts.size());
    if (i < 2) continue;  // warm-up: page faults, shader compilation
    yardstick.push_back(y), tensor.push_back(t), registration.push_back(r);
  }
  const double y = median(yardstick);
  std::printf(
      "%s: Y %.1f ms; tensor %.1f ms = %.1f Y; registration of a batch of 40 %.2f ms each = %.2f "
      "Y\n",
      backend->name().c_str(), y, median(tensor), median(tensor) / y, median(registration),
      median(registration) / y);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    std::vector<std::string> devices(argv + 1, argv + argc);
    if (devices.empty()) {
      devices = {"cpu"};
      for (const DeviceInfo& info : vulkan_devices())
        devices.push_back("vulkan:" + std::to_string(info.index));
    }
    for (const std::string& device : devices) measure(device);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "edgescout_bench_yardstick: error: " << error.what() << "\n";
    return 2;
  }
}
