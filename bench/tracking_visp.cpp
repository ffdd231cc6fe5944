// Tracking of a photographed sequence, beside ViSP's model-based edge tracker on the same images.
//
//   edgescout_bench_tracking_visp IMAGES --model FILE.cao --config FILE.xml --start FILE
//
// IMAGES is a folder; FILE.xml ViSP's configuration, whose camera both take; the start a file of
// poses (host/io/poses.h) with that of the first image. Prints for both trackers the frames until
// the pose is lost and the time of a frame, and how far the projections of the model's vertices by
// both lie apart.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/arguments.h"
#include "bench/visp_tracker.h"
#include "host/core/quantile.h"
#include "host/core/stopwatch.h"
#include "host/io/image.h"
#include "host/io/mesh.h"
#include "host/io/poses.h"
#include "host/track/tracker.h"

namespace {

using namespace edgescout;
using Clock = std::chrono::steady_clock;

struct Arguments {
  std::string images, model, config, start;
};

// What both trackers are given.
struct Sequence {
  std::vector<std::string> files;
  Camera camera;
  Se3 first_pose;
  Mesh mesh;
};

// One tracker's poses, and milliseconds, of the images before it lost the object.
struct Followed {
  std::vector<Se3> poses;
  std::vector<double> ms;
};

Se3 to_se3(const bench::Matrix4& m) {
  Eigen::Matrix3d rotation;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) rotation(r, c) = m[std::size_t(4 * r + c)];
  return se3_from_matrix(rotation, {m[3], m[7], m[11]});
}

bench::Matrix4 to_matrix(const Se3& pose) {
  bench::Matrix4 m{};
  const Eigen::Matrix3d rotation = pose.rotation.toRotationMatrix();
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) m[std::size_t(4 * r + c)] = rotation(r, c);
    m[std::size_t(4 * r + 3)] = pose.translation_m[r];
  }
  m[15] = 1;
  return m;
}

Sequence sequence_of(const Arguments& a) {
  Sequence sequence;
  for (const auto& entry : std::filesystem::directory_iterator(a.images))
    sequence.files.push_back(entry.path().string());
  std::ranges::sort(sequence.files);
  const Image first = load_image(sequence.files.front());
  const auto [fx, fy, cx, cy] = bench::VispTracker(a.config, a.model).camera();
  sequence.camera = {first.width, first.height, fx, fy, cx, cy, {}};
  sequence.first_pose = load_start_poses(a.start).at(0).camera_from_object;
  sequence.mesh = load_mesh(a.model, LengthUnit::Metre);
  return sequence;
}

Followed by_visp(const Sequence& sequence, const Arguments& a) {
  bench::VispTracker tracker(a.config, a.model);
  tracker.begin(sequence.files.front(), to_matrix(sequence.first_pose));
  Followed followed;
  for (const std::string& file : sequence.files) {
    tracker.read(file);
    const auto begin = Clock::now();
    if (!tracker.track()) break;
    followed.ms.push_back(1000 * seconds_since(begin));
    followed.poses.push_back(to_se3(tracker.pose()));
  }
  return followed;
}

Followed by_edgescout(const Sequence& sequence) {
  const std::vector<TemplateSet> sets{without_views({1, sequence.mesh, {}})};
  const std::unique_ptr<Backend> backend = make_backend("cpu");
  Tracker tracker(sets, sequence.camera, *backend);
  tracker.add(0, sequence.first_pose);
  Followed followed;
  for (std::size_t f = 0; f < sequence.files.size(); ++f) {
    const TrackFrame frame{std::make_shared<const Image>(load_image(sequence.files[f])), double(f)};
    const auto begin = Clock::now();
    const Track track = tracker.update(frame)[0];
    if (track.state == TrackState::Lost) break;
    followed.ms.push_back(1000 * seconds_since(begin));
    followed.poses.push_back(track.world_from_object);
  }
  return followed;
}

// Mean over the vertices.
double apart_px(const Se3& a, const Se3& b, const Sequence& sequence) {
  double sum = 0;
  for (const Eigen::Vector3d& vertex : sequence.mesh.vertices_m)
    sum += (project(sequence.camera, a * vertex) - project(sequence.camera, b * vertex)).norm();
  return sum / double(sequence.mesh.vertices_m.size());
}

void print(const char* name, const Followed& followed, std::size_t frames) {
  std::printf("| %s | %zu of %zu | %.2f | %.2f |\n", name, followed.poses.size(), frames,
              quantile(followed.ms, 0.5), quantile(followed.ms, 0.99));
}

}  // namespace

int main(int argc, char** argv) try {
  Arguments a;
  bench::read_arguments(argc, argv,
                        {{"IMAGES", &a.images},
                         {"--model", &a.model},
                         {"--config", &a.config},
                         {"--start", &a.start}});
  const Sequence sequence = sequence_of(a);
  const Followed ours = by_edgescout(sequence), theirs = by_visp(sequence, a);
  std::puts("| tracker | frames kept | ms a frame, median | 99 % |\n|---|---|---|---|");
  print("edgescout", ours, sequence.files.size());
  print("ViSP", theirs, sequence.files.size());
  std::vector<double> apart;
  for (std::size_t f = 0; f < std::min(ours.poses.size(), theirs.poses.size()); ++f) {
    apart.push_back(apart_px(ours.poses[f], theirs.poses[f], sequence));
  }
  std::printf("\nVertices by both apart: median %.2f px, 95 %% %.2f px, most %.2f px\n",
              quantile(apart, 0.5), quantile(apart, 0.95), quantile(apart, 1));
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
