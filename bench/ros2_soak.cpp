// A camera on DDS for a long time beside edgescout_ros2: memory, latency and dropped images.
//   edgescout_bench_ros2 IMAGE CAMERA_FILE PROCESS_ID [RATE_HZ [SECONDS]]
// scripts/soak_ros2.sh starts both.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "host/bridge/ros2/dds/dds_node.h"
#include "host/bridge/ros2/frames.h"
#include "host/bridge/ros2/image_message.h"
#include "host/core/quantile.h"
#include "host/io/camera_file.h"

namespace edgescout::ros2 {

namespace {

using Clock = std::chrono::steady_clock;

msg::CameraInfo info_of(const Camera& camera) {
  msg::CameraInfo info;
  info.width = std::uint32_t(camera.width);
  info.height = std::uint32_t(camera.height);
  info.distortion_model = "plumb_bob";
  info.d.assign(camera.distortion.begin(), camera.distortion.begin() + 5);
  info.k = {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
  return info;
}

// Resident memory of a process, MiB; 0: it has ended.
double memory_mib(const std::string& process) {
  std::ifstream status("/proc/" + process + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmRSS:")) return std::atof(line.c_str() + 6) / 1024;
  return 0;
}

struct Soak {
  DdsNode node;
  DdsWriter image, info;
  std::vector<double> latencies_ms;
  std::map<std::int64_t, Clock::time_point> sent;  // by stamp
  std::map<std::string, std::string> diagnostics;

  explicit Soak(std::uint32_t domain) : node(domain, true) {
    image = node.writer<sensor_msgs_msg_dds__Image_>("rt/image", {.is_reliable = false});
    info = node.writer<sensor_msgs_msg_dds__CameraInfo_>("rt/camera_info", {.is_reliable = false});
    node.subscribe<vision_msgs_msg_dds__Detection3DArray_>(
        "rt/edgescout/detections", {}, [this](const auto& wire) {
          msg::Time stamp;
          FromWire{}(stamp, wire.header.stamp);
          const auto found = sent.find(nanoseconds(stamp));
          if (found == sent.end()) return;
          const std::chrono::duration<double, std::milli> latency = Clock::now() - found->second;
          latencies_ms.push_back(latency.count());
          sent.erase(sent.begin(), std::next(found));
        });
    node.subscribe<diagnostic_msgs_msg_dds__DiagnosticArray_>(
        "rt/diagnostics", {}, [this](const auto& wire) {
          msg::DiagnosticArray array;
          FromWire{}(array, wire);
          for (const msg::DiagnosticStatus& status : array.status)
            for (const msg::KeyValue& value : status.values) diagnostics[value.key] = value.value;
        });
  }

  template <typename Wire, typename Plain>
  static void write(const DdsWriter& writer, const Plain& plain) {
    Wire wire{};
    ToWire io;
    io(plain, wire);
    writer.write(&wire);
  }

  void print(double seconds, double mib, std::int64_t images) const {
    std::printf(
        "%6.0f s: %lld images sent, %zu answered, latency median %.1f ms, 99 %% %.1f ms, "
        "memory %.1f MiB\n",
        seconds, static_cast<long long>(images), latencies_ms.size(), quantile(latencies_ms, 0.5),
        quantile(latencies_ms, 0.99), mib);
    std::fflush(stdout);
  }
};

}  // namespace

int soak(const std::string& image_file, const std::string& camera_file, const std::string& process,
         double rate_hz, double seconds) {
  const char* domain = std::getenv("ROS_DOMAIN_ID");
  Soak soak(domain ? std::uint32_t(std::atoi(domain)) : 0);
  msg::Image picture = message_of(load_image(image_file), {{}, "camera"});
  Camera camera = load_camera(camera_file);
  camera.width = int(picture.width), camera.height = int(picture.height);
  msg::CameraInfo info = info_of(camera);
  const auto start = Clock::now();
  std::int64_t images = 0;
  double next_line_s = 10, first_mib = 0, mib = 0;
  for (double now_s = 0; now_s < seconds;) {
    now_s = std::chrono::duration<double>(Clock::now() - start).count();
    if (double(images) / rate_hz <= now_s) {
      picture.header.stamp = info.header.stamp = time_of(++images * 1'000'000);
      soak.sent[images * 1'000'000] = Clock::now();
      Soak::write<sensor_msgs_msg_dds__CameraInfo_>(soak.info, info);
      Soak::write<sensor_msgs_msg_dds__Image_>(soak.image, picture);
    }
    soak.node.spin(std::clamp(double(images) / rate_hz - now_s, 0.0, 0.01));
    if (now_s < next_line_s) continue;
    mib = memory_mib(process);
    if (next_line_s == 10) soak.latencies_ms.clear();  // templates were made
    if (next_line_s == 20) first_mib = mib;
    soak.print(now_s, mib, images);
    next_line_s += 10;
    if (mib == 0) return 1;
  }
  std::printf("memory %.1f MiB after 20 s, %.1f MiB at the end\n", first_mib, mib);
  for (const auto& [what, value] : soak.diagnostics)
    std::printf("  %s: %s\n", what.c_str(), value.c_str());
  return 0;
}

}  // namespace edgescout::ros2

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fprintf(stderr, "usage: %s IMAGE CAMERA_FILE PROCESS_ID [RATE_HZ [SECONDS]]\n", argv[0]);
    return 2;
  }
  return edgescout::ros2::soak(argv[1], argv[2], argv[3], argc > 4 ? std::atof(argv[4]) : 30,
                               argc > 5 ? std::atof(argv[5]) : 600);
}
