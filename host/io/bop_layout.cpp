#include "host/io/bop_layout.h"

#include <algorithm>
#include <charconv>

#include "host/io/bop.h"
#include "host/io/image.h"

namespace edgescout {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view camera_file_start = "scene_camera_", camera_file_end = ".json";

// Grey ones first: nothing is lost by a conversion.
constexpr const char* kinds_of_images[] = {"gray",  "grey",   "mono",  "rgb",   "bgr",
                                           "color", "colour", "image", "images"};

// "000012" -> 12. Nothing: the name is no number.
std::optional<int> image_number(const std::string& stem) {
  int number = 0;
  const auto [end, error] = std::from_chars(stem.data(), stem.data() + stem.size(), number);
  if (error != std::errc{} || end != stem.data() + stem.size() || number < 0) return {};
  return number;
}

std::vector<fs::path> entries_of(const fs::path& folder) {
  std::vector<fs::path> entries;
  std::error_code failure;
  for (fs::directory_iterator entry(folder, failure), end; !failure && entry != end;
       entry.increment(failure))
    entries.push_back(entry->path());
  std::ranges::sort(entries);
  return entries;
}

// A name of six digits is BOP's; of several endings PNG is the one without loss.
bool is_preferred(const fs::path& file, const fs::path& before, int image_id) {
  const auto rank = [&](const fs::path& candidate) {
    return std::pair(candidate.stem() != six_digits(image_id), candidate.extension() != ".png");
  };
  return rank(file) < rank(before);
}

}  // namespace

bool is_there(const fs::path& path) {
  std::error_code unknown;
  return fs::exists(path, unknown);
}

ImageFiles::ImageFiles(const fs::path& scene, const std::string& camera_name) {
  std::vector<std::string> folders;
  for (const char* kind : kinds_of_images)
    folders.push_back(camera_name.empty() ? kind : std::string(kind) + "_" + camera_name);
  if (!camera_name.empty()) folders.push_back(camera_name);
  for (const std::string& folder : folders) add_folder(scene / folder);
  if (folder_.empty()) folder_ = scene / (camera_name.empty() ? "rgb" : "rgb_" + camera_name);
}

ImageFiles ImageFiles::of_depth(const fs::path& scene, const std::string& camera_name) {
  ImageFiles files;
  files.add_folder(scene / (camera_name.empty() ? "depth" : "depth_" + camera_name));
  return files;
}

void ImageFiles::add_folder(const fs::path& folder) {
  if (!is_there(folder)) return;
  if (folder_.empty()) folder_ = folder;
  std::map<int, fs::path> found;
  for (const fs::path& file : entries_of(folder)) {
    const std::optional<int> id =
        has_image_extension(file) ? image_number(file.stem().string()) : std::nullopt;
    if (!id) continue;
    const auto [place, is_new] = found.emplace(*id, file);
    if (!is_new && is_preferred(file, place->second, *id)) place->second = file;
  }
  files_.merge(found);
}

fs::path ImageFiles::of(int image_id) const {
  const auto file = files_.find(image_id);
  return file == files_.end() ? folder_ / (six_digits(image_id) + ".png") : file->second;
}

std::string six_digits(int number) {
  const std::string digits = std::to_string(number);
  return std::string(6 - std::min<std::size_t>(6, digits.size()), '0') + digits;
}

fs::path bop_file(const fs::path& folder, const std::string& kind, const std::string& camera_name) {
  return folder / (kind + (camera_name.empty() ? "" : "_" + camera_name) + ".json");
}

std::vector<std::string> bop_cameras(const fs::path& folder) {
  std::vector<std::string> cameras;
  if (is_there(bop_file(folder, "scene_camera", ""))) cameras.emplace_back();
  for (const fs::path& entry : entries_of(folder)) {
    const std::string name = entry.filename().string();
    if (name.starts_with(camera_file_start) && name.ends_with(camera_file_end) &&
        name.size() > camera_file_start.size() + camera_file_end.size())
      cameras.push_back(
          name.substr(camera_file_start.size(),
                      name.size() - camera_file_start.size() - camera_file_end.size()));
  }
  return cameras;
}

bool is_bop_scene(const fs::path& folder) {
  return is_there(bop_file(folder, "scene_camera", "")) || !bop_cameras(folder).empty();
}

}  // namespace edgescout
