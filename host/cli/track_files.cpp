#include "host/cli/track_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "host/cli/batch_results.h"
#include "host/core/quantile.h"
#include "host/io/files.h"
#include "kernels/error.h"

namespace edgescout {

namespace fs = std::filesystem;

namespace {

constexpr const char* header =
    "scene_id,im_id,camera,time_s,track,obj_id,state,above_chance,"
    "r11,r12,r13,r21,r22,r23,r31,r32,r33,tx_m,ty_m,tz_m,"
    "sigma_x_m,sigma_y_m,sigma_z_m,sigma_rx_rad,sigma_ry_rad,sigma_rz_rad,image\n";

// Commas and quotes in names of files would end a column.
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string inside;
  for (const char c : text) inside += c == '"' ? std::string("\"\"") : std::string(1, c);
  return '"' + inside + '"';
}

std::string row_of(const InputImage& input, double time_s, const Track& track, int object_id) {
  std::string row = fmt::format("{},{},{},{:.6f},{},{},{},{:.4f}", input.scene_id, input.image_id,
                                quoted(input.camera_name), time_s, track.id, object_id,
                                to_string(track.state), track.above_chance);
  const Eigen::Matrix3d rotation = track.world_from_object.rotation.toRotationMatrix();
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) row += fmt::format(",{:.9g}", rotation(r, c));
  for (const double t : track.world_from_object.translation_m) row += fmt::format(",{:.9g}", t);
  for (int i = 0; i < 6; ++i) row += fmt::format(",{:.4g}", std::sqrt(track.covariance(i, i)));
  return row + ',' + quoted(place_of(input).string()) + '\n';
}

void remove_earlier(const fs::path& out, std::span<const InputImage> images) {
  std::vector<fs::path> files{out / "tracks.csv", out / "results.csv", out / "summary.json"};
  for (const InputImage& image : images) files.push_back(overlay_of(out, image));
  remove_files_of_run(std::move(files));
}

}  // namespace

TrackFiles::TrackFiles(fs::path out, std::span<const InputImage> images,
                       std::span<const TemplateSet> sets)
    : out_(std::move(out)), sets_(sets) {
  require_writable_folder(out_);
  remove_earlier(out_, images);
  write_file_atomically(out_ / "tracks.csv", header);
  descriptor_ = ::open((out_ / "tracks.csv").c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
  if (descriptor_ < 0)
    throw InputError((out_ / "tracks.csv").string() + ": " + std::strerror(errno));
  length_ = static_cast<long long>(std::strlen(header));
}

TrackFiles::~TrackFiles() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void TrackFiles::add(const InputImage& input, double time_s, std::span<const Track> tracks) {
  std::string rows;
  for (const Track& track : tracks) {
    const int object_id = sets_[std::size_t(track.object)].object_id;
    rows += row_of(input, time_s, track, object_id);
    if (track.state != TrackState::Lost)
      results_.push_back({input.scene_id, input.image_id, object_id, track.above_chance,
                          track.world_from_object, -1, input.camera_name});
  }
  if (rows.empty()) return;
  const ssize_t written = ::write(descriptor_, rows.data(), rows.size());
  if (written != static_cast<ssize_t>(rows.size())) {
    const int error = written < 0 ? errno : ENOSPC;
    [[maybe_unused]] const int unused = ::ftruncate(descriptor_, length_);
    throw InputError((out_ / "tracks.csv").string() + ": " + std::strerror(error));
  }
  length_ += written;
}

void TrackFiles::finish(const TrackSummary& summary, const std::string& device) const {
  if (::fsync(descriptor_) != 0)
    throw InputError((out_ / "tracks.csv").string() + ": " + std::strerror(errno));
  save_bop_results(results_, out_ / "results.csv");
  const nlohmann::ordered_json json{
      {"frames", summary.frames},
      {"sequences", summary.sequences},
      {"instances", summary.instances},
      {"losses", summary.losses},
      {"tracked", summary.tracked},
      {"doubtful", summary.doubtful},
      {"lost", summary.lost},
      {"failed", summary.failures},
      {"device", device},
      {"update_ms",
       {{"median", quantile(summary.update_ms, 0.5)}, {"p99", quantile(summary.update_ms, 0.99)}}},
      {"seconds", summary.seconds}};
  write_file_atomically(out_ / "summary.json", json.dump(2) + "\n");
}

}  // namespace edgescout
