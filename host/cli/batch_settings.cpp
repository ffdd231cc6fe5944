#include "host/cli/batch_settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "host/core/lens.h"
#include "host/io/binary_file.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

std::string text_of(const std::optional<Camera>& camera) {
  if (!camera) return "none";
  std::span<const double> coefficients = camera->distortion;
  constexpr std::size_t always_shown = 8;
  while (coefficients.size() > always_shown && coefficients.back() == 0)
    coefficients = coefficients.first(coefficients.size() - 1);
  std::string text = fmt::format("{}x{} px, fx {}, fy {}, cx {}, cy {}, distortion {}",
                                 camera->width, camera->height, camera->fx, camera->fy, camera->cx,
                                 camera->cy, fmt::join(coefficients, " "));
  if (camera->lens != LensModel::BrownConrady) text += ", " + to_string(camera->lens);
  if (camera->skew != 0) text += fmt::format(", skew {}", camera->skew);
  if (camera->field_of_view_rad > 0)
    text += fmt::format(", field of view {} rad", camera->field_of_view_rad);
  return text;
}

std::string text_of(const Se3& pose) {
  const Eigen::Vector3d& t = pose.translation_m;
  const Eigen::Quaterniond& q = pose.rotation;
  return fmt::format("at {} {} {} m, turned {} {} {} {}", t.x(), t.y(), t.z(), q.w(), q.x(), q.y(),
                     q.z());
}

std::string text_of(const Symmetries& symmetries) {
  BinaryWriter poses;
  for (const Se3& pose : symmetries.discrete) poses.put_pose(pose);
  return fmt::format("{}, {}", symmetries.discrete.size(), checksum_text(poses.bytes));
}

// Without the options of the edges: the checksum of the model contains them.
std::string text_of(const TemplateOptions& o) {
  return fmt::format(
      "frequency {}, latitude {} to {}, longitude {} to {}, {} in-plane steps, {} to {} m in "
      "ratios of {}",
      o.frequency, o.range.latitude_min_deg, o.range.latitude_max_deg, o.range.longitude_min_deg,
      o.range.longitude_max_deg, o.in_plane_steps, o.distance_min_m, o.distance_max_m,
      o.distance_ratio);
}

// Objects, each with the largest number of its instances.
std::string text_of(const std::map<int, int>& wanted) {
  std::vector<std::string> objects;
  for (const auto& [id, instances] : wanted)
    objects.push_back(instances == std::numeric_limits<int>::max()
                          ? fmt::format("object {}", id)
                          : fmt::format("object {} x {}", id, instances));
  return fmt::format("{}", fmt::join(objects, ", "));
}

std::string text_of_checksum(std::uint64_t sum) { return fmt::format("checksum {:016x}", sum); }

std::string value_in(const Settings& settings, const std::string& name) {
  const auto setting = std::ranges::find(settings, name, &Settings::value_type::first);
  return setting == settings.end() ? "nothing" : setting->second;
}

}  // namespace

std::string checksum_text(std::string_view bytes) { return text_of_checksum(checksum(bytes)); }

std::pair<std::string, std::string> setting_of(int object_id, const EdgeModel& model) {
  return {fmt::format("model of object {}", object_id), text_of_checksum(fingerprint(model))};
}

Settings settings_of(std::span<const TemplateSet> sets) {
  Settings settings;
  for (const TemplateSet& set : sets) {
    settings.push_back(setting_of(set.object_id, set.model));
    settings.emplace_back(fmt::format("symmetries of object {}", set.object_id),
                          text_of(set.symmetries));
    settings.emplace_back(fmt::format("templates of object {}", set.object_id),
                          text_of(set.options));
  }
  return settings;
}

Settings BatchSettings::of(const InputImage& input, const std::string& views) const {
  Settings settings = common;
  settings.emplace_back("views", views);
  settings.emplace_back("camera", text_of(camera ? camera : input.camera));
  if (!input.wanted.empty()) settings.emplace_back("targets", text_of(input.wanted));
  if (input.camera_from_world)
    settings.emplace_back("camera in the world", text_of(*input.camera_from_world));
  return settings;
}

std::string BatchSettings::jointly(const std::vector<const InputImage*>& views) const {
  BinaryWriter out;
  for (const InputImage* view : views) {
    out.put_text(view->name);
    out.put_text(text_of(camera ? camera : view->camera));
    out.put_pose(*view->camera_from_world);
  }
  return fmt::format("{} jointly, {}", views.size(), checksum_text(out.bytes));
}

void require_same(const Settings& found, const Settings& expected, const std::string& file,
                  const std::string& as) {
  Settings all = expected;
  all.insert(all.end(), found.begin(), found.end());
  for (const auto& [name, value] : all)
    if (value_in(found, name) != value_in(expected, name))
      throw InputError(file, name, value_in(found, name), value_in(expected, name) + as);
}

}  // namespace edgescout
