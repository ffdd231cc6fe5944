#include "host/cli/batch_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>

#include "host/active/particles.h"
#include "host/cli/batch_page.h"
#include "host/cli/stage_times.h"
#include "host/core/log.h"
#include "host/io/bop.h"
#include "host/io/files.h"
#include "host/io/json_text.h"
#include "kernels/error.h"

namespace edgescout {

namespace fs = std::filesystem;

namespace {

// Returns whether a JSON file is a result. Nothing: the file holds no JSON, as after a disk error.
std::optional<bool> holds_result(const fs::path& file) {
  try {
    return is_image_result(file);
  } catch (const InputError&) {
    return {};
  }
}

// Of scenes with several.
std::set<std::string> cameras_of(std::span<const InputImage> images) {
  std::set<std::string> cameras;
  for (const InputImage& image : images)
    if (!image.camera_name.empty()) cameras.insert(image.camera_name);
  return cameras;
}

fs::path csv_of(const fs::path& out, const std::string& camera) {
  return out / ("results_" + camera + ".csv");
}

// In BOP's own format, which has no place for the name of a camera: one file for each.
void write_csv_of_cameras(const std::vector<BopResult>& rows, const std::set<std::string>& cameras,
                          const fs::path& out) {
  for (const std::string& camera : cameras) {
    std::vector<BopResult> of_camera;
    for (const BopResult& row : rows)
      if (row.camera_name == camera) of_camera.push_back(row);
    for (BopResult& row : of_camera) row.camera_name.clear();
    save_bop_results(of_camera, csv_of(out, camera));
  }
}

}  // namespace

fs::path json_of(const fs::path& out, const InputImage& input) {
  return out / (input.name + ".json");
}

fs::path overlay_of(const fs::path& out, const InputImage& input) {
  return out / (input.name + "_overlay.png");
}

fs::path place_of(const InputImage& input) { return fs::absolute(input.file).lexically_normal(); }

void carry_to_world(ImageResult& result) {
  if (!result.camera_from_world) return;
  for (Detection& found : result.detections)
    found = candidate_in_world(found, *result.camera_from_world);
}

bool is_done(const fs::path& out, const InputImage& input, const Settings& settings) {
  const fs::path file = json_of(out, input);
  if (!fs::exists(file)) return false;
  ImageResult result;
  try {
    result = load_image_result(file);
  } catch (const InputError&) {
    return false;  // truncated, of a format that is not read, or another file: done again
  }
  if (result.image.string() != as_in_json(place_of(input).string()) ||
      result.scene_id != input.scene_id || result.image_id != input.image_id)
    return false;
  require_same(result.settings, settings, file.string());
  return true;
}

void save_result(const ImageResult& result, const fs::path& out, const InputImage& input) {
  save_image_result(result, json_of(out, input));
  log(LogLevel::Debug, fmt::format("{}: {} poses, {}", input.file.string(),
                                   result.detections.size(), stage_times(result.stages)));
}

void require_no_other_results(const fs::path& out, std::span<const InputImage> images) {
  std::set<std::string> names;
  for (const InputImage& image : images) names.insert(image.name);
  std::error_code not_there;
  for (const fs::directory_entry& entry : fs::directory_iterator(out, not_there)) {
    if (entry.path().extension() != ".json") continue;
    const bool is_named = names.contains(entry.path().stem().string());
    const std::optional<bool> is_result = holds_result(entry.path());
    if (!is_named && is_result == true)
      throw InputError(out.string(), "output folder",
                       entry.path().filename().string() + " of another run",
                       "another --out, or a folder without results of other images");
    if (is_named && is_result == false)
      throw InputError(entry.path().string(), "file", "no result of this program",
                       "another --out, or its removal");
  }
}

void start_anew(const fs::path& out, std::span<const InputImage> images) {
  std::vector<fs::path> files{out / "results.csv", out / "summary.json", out / "report.html"};
  for (const std::string& camera : cameras_of(images)) files.push_back(csv_of(out, camera));
  for (const InputImage& image : images) {
    files.push_back(json_of(out, image));
    files.push_back(overlay_of(out, image));
  }
  remove_files_of_run(std::move(files));
}

void remove_files_of_run(std::vector<fs::path> files) {
  std::error_code unknown;
  std::erase_if(files, [&](const fs::path& file) { return !fs::is_regular_file(file, unknown); });
  remove_earlier_files(files);
}

namespace {

void write_summary(const BatchSummary& summary, const std::string& device, const fs::path& out) {
  nlohmann::ordered_json json{
      {"images", summary.images},
      {"done", summary.done},
      {"skipped", summary.skipped},
      {"failed", summary.failures.size()},
      {"poses", summary.poses},
      {"poses_out_of_sight", summary.out_of_sight},
      {"incomplete", summary.incomplete},
      {"device", device},
      {"seconds", summary.seconds},
      {"images_per_second", summary.seconds > 0 ? summary.done / summary.seconds : 0.0}};
  for (const auto& [stage, seconds] : summary.stage_seconds)
    json["mean_ms_per_image"][stage] = 1000 * seconds / std::max(1, summary.done);
  for (const TemplateOrigin& origin : summary.templates)
    json["templates"].push_back(
        {{"object_id", origin.object_id}, {"source", origin.source}, {"seconds", origin.seconds}});
  if (!summary.error.empty()) json["error"] = summary.error;
  json["failures"] = nlohmann::ordered_json::array();
  for (const auto& [file, message] : summary.failures)
    json["failures"].push_back({{"file", file}, {"error", message}});
  for (const MissingPart& part : summary.missing)
    json["missing"].push_back(
        {{"what", part.what}, {"images", part.images}, {"reason", part.reason}});
  write_file_atomically(out / "summary.json", json_text(json, 2));
}

void write_rows(const BatchTables& tables, BatchSummary& summary, const std::string& device,
                const TableFiles& files) {
  const fs::path& out = files.out;
  summary.poses = static_cast<int>(tables.rows.size());
  summary.out_of_sight = tables.out_of_sight;
  summary.incomplete = tables.incomplete;
  save_bop_results(tables.rows, out / "results.csv");
  write_csv_of_cameras(tables.rows, tables.cameras, out);
  AtomicFile page(out / "report.html");
  write_batch_page(tables, summary, device, {out, files.thumbnails},
                   [&](std::string_view part) { page.write(part); });
  page.finish();
}

BatchTables tables_of(std::span<const InputImage> images, const BatchSummary& summary,
                      const fs::path& out) {
  BatchTables tables(summary.by_scene);
  for (const InputImage& input : images) {
    const auto failure = summary.failures.find(input.file.string());
    if (summary.finished.contains(input.name))
      tables.add(input, load_image_result(json_of(out, input)));
    else if (failure != summary.failures.end())
      tables.add_failed(input, failure->second);
    else
      tables.add_missing(input, "the batch ended before");
  }
  return tables;
}

}  // namespace

void write_tables(const BatchTables& tables, BatchSummary& summary, const std::string& device,
                  const TableFiles& files) {
  write_rows(tables, summary, device, files);
  write_summary(summary, device, files.out);
}

void write_tables(std::span<const InputImage> images, BatchSummary& summary,
                  const std::string& device, const TableFiles& files) {
  write_tables(tables_of(images, summary, files.out), summary, device, files);
}

void write_ended(std::span<const InputImage> images, BatchSummary& summary,
                 const std::string& device, const TableFiles& files) {
  const auto try_to = [](const std::function<void()>& write) {
    try {
      write();
    } catch (const std::exception& error) {
      log(LogLevel::Warning, error.what());
    }
  };
  try_to([&] {
    require_writable_folder(files.out);  // the folder does not exist before the first result
    write_rows(tables_of(images, summary, files.out), summary, device, files);
  });
  try_to([&] { write_summary(summary, device, files.out); });
}

}  // namespace edgescout
