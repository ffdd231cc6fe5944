#include "host/experiments/recorded_starts.h"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>

#include "host/io/files.h"
#include "host/io/image.h"
#include "host/io/json_fields.h"
#include "host/io/mesh.h"
#include "kernels/error.h"

namespace edgescout {

namespace fs = std::filesystem;

namespace {

// Rotations in the files may have only six digits, so the nearest rotation is used. Millimetres
// become metres.
Se3 pose_of(const std::vector<double>& rotation, const std::vector<double>& translation_mm) {
  const Eigen::Matrix3d given =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rotation.data());
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(given, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return se3_from_matrix(
      svd.matrixU() * svd.matrixV().transpose(),
      1e-3 * Eigen::Vector3d(translation_mm[0], translation_mm[1], translation_mm[2]));
}

// Nine numbers of the rotation by row, then three of the translation, from `column` on.
Se3 pose_in(const Table& table, std::size_t row, std::string_view first_column) {
  const std::size_t first = table.column(first_column);
  std::vector<double> numbers;
  for (std::size_t i = first; i < std::min(first + 12, table.columns.size()); ++i)
    numbers.push_back(number_in(table, row, table.columns[i]));
  if (numbers.size() < 12)
    throw InputError("results", std::string(first_column), "fewer than 12 columns", "a pose");
  return pose_of({numbers.begin(), numbers.begin() + 9}, {numbers.begin() + 9, numbers.end()});
}

void require_columns(const Table& table, const fs::path& file,
                     std::initializer_list<const char*> names) {
  for (const char* name : names)
    if (std::ranges::find(table.columns, name) == table.columns.end())
      throw InputError(file.string(), "columns", "no " + std::string(name),
                       "a column of this name");
}

// The level of a start, 1 to 4. InputError naming file and row.
int level_in(const Table& table, std::size_t row, const fs::path& file) {
  const std::string& text = text_in(table, row, "level");
  if (text.size() != 1 || text[0] < '1' || text[0] > '4')
    throw InputError(file.string(), fmt::format("row {}, level", row + 1), text, "1, 2, 3 or 4");
  return text[0] - '0';
}

Table load_starts(const fs::path& folder) {
  const fs::path file = folder / "starts.csv";
  Table table = load_table(file);
  require_columns(table, file, {"start_id", "image", "object_id", "level", "r00", "tz"});
  for (std::size_t row = 0; row < table.rows.size(); ++row) level_in(table, row, file);
  return table;
}

bool is_target(const JsonField& object) {
  const JsonField target = object.at("target");
  if (!target.value.is_boolean()) target.fail(target.value.dump(), "true or false");
  return target.value.get<bool>();
}

// InputError naming the first missing image or mesh of the set.
void require_files_of(const fs::path& folder) {
  const fs::path file = folder / "ground_truth.json";
  const nlohmann::json json = read_json(file);
  const auto require = [&](const JsonField& name, const char* what) {
    if (const fs::path named = folder / name.text(); !fs::exists(named))
      throw InputError(named.string(), "file", "nothing",
                       std::string(what) + " of the set d2co-starts");
  };
  for (const JsonField& entry : JsonField{json, file.string(), ""}.at("images").elements()) {
    require(entry.at("file"), "an image");
    for (const JsonField& object : entry.at("objects").elements())
      if (is_target(object)) require(object.at("cad"), "a mesh");
  }
}

// Images of one scene have a name in common up to "_v".
std::string scene_name(const std::string& image) { return image.substr(0, image.find("_v")); }

KnownImage load_known_image(const fs::path& folder, const JsonField& entry) {
  const Image image = load_image(folder / entry.at("file").text());
  const Camera camera{entry.at("width").integer(),
                      entry.at("height").integer(),
                      entry.at("fx").number(),
                      entry.at("fy").number(),
                      entry.at("cx").number(),
                      entry.at("cy").number(),
                      {}};
  if (image.width != camera.width || image.height != camera.height)
    throw InputError((folder / entry.at("file").text()).string(), "size",
                     std::to_string(image.width) + " x " + std::to_string(image.height),
                     "that of ground_truth.json");
  return {image, camera,
          pose_of(entry.at("R_cam_world").numbers(9), entry.at("t_cam_world").numbers(3))};
}

// Targets of the image; their types are loaded as they appear.
void add_instances(KnownScene& scene, const fs::path& folder, const JsonField& entry) {
  std::vector<std::string> models;
  const Se3 world_from_camera = inverse(scene.images[0].camera_from_world);
  for (const JsonField& object : entry.at("objects").elements()) {
    if (!is_target(object)) continue;
    const std::string model = object.at("model").text();
    const auto known = std::ranges::find(models, model);
    const int index = static_cast<int>(known - models.begin());
    if (known == models.end()) {
      models.push_back(model);
      scene.objects.push_back(
          {index + 1, load_mesh(folder / object.at("cad").text(), LengthUnit::Millimetre), {}});
    }
    scene.instances.push_back(
        {object.at("id").text(), index,
         world_from_camera * pose_of(object.at("R").numbers(9), object.at("t").numbers(3)),
         object.at("visible_fraction").number()});
  }
}

// The image first.
std::vector<std::string> scene_images(const fs::path& folder, const std::string& image) {
  const fs::path file = folder / "ground_truth.json";
  const nlohmann::json json = read_json(file);
  const JsonField root{json, file.string(), ""};
  std::vector<std::string> names{image};
  bool is_there = false;
  for (const JsonField& entry : root.at("images").elements()) {
    const std::string name = entry.at("name").text();
    is_there |= name == image;
    if (name != image && scene_name(name) == scene_name(image)) names.push_back(name);
  }
  if (!is_there) root.at("images").fail("no " + image, "every image of starts.csv");
  return names;
}

}  // namespace

std::vector<std::string> recorded_images(const fs::path& folder) {
  for (const char* file : {"ground_truth.json", "starts.csv"})
    if (!fs::exists(folder / file))
      throw InputError((folder / file).string(), "file", "nothing",
                       "a file of the set d2co-starts");
  const Table starts = load_starts(folder);
  std::vector<std::string> names;
  for (std::size_t row = 0; row < starts.rows.size(); ++row)
    if (const std::string& image = text_in(starts, row, "image");
        std::ranges::find(names, image) == names.end())
      names.push_back(image);
  for (const std::string& name : names)
    if (const fs::path file = folder / "images" / (name + ".png"); !fs::exists(file))
      throw InputError(file.string(), "file", "nothing", "an image of the set d2co-starts");
  require_files_of(folder);
  return names;
}

int other_views(const fs::path& folder, const std::string& image) {
  return static_cast<int>(scene_images(folder, image).size()) - 1;
}

KnownScene recorded_scene(const fs::path& folder, const std::string& image, int others) {
  const nlohmann::json json = read_json(folder / "ground_truth.json");
  const JsonField root{json, (folder / "ground_truth.json").string(), ""};
  std::vector<std::string> names = scene_images(folder, image);
  check(others < static_cast<int>(names.size()), "as many other views as the scene has");
  names.resize(static_cast<std::size_t>(others) + 1);
  KnownScene scene;
  scene.set = "d2co-starts";
  scene.name = image;
  for (const std::string& name : names)
    for (const JsonField& entry : root.at("images").elements()) {
      if (entry.at("name").text() != name) continue;
      scene.images.push_back(load_known_image(folder, entry));
      if (name == image) add_instances(scene, folder, entry);
    }
  return scene;
}

std::vector<RecordedStart> recorded_starts(const fs::path& folder, const KnownScene& scene,
                                           int every) {
  const Table table = load_starts(folder);
  std::vector<RecordedStart> starts;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const int id = static_cast<int>(number_in(table, row, "start_id"));
    if (id % every != 0 || text_in(table, row, "image") != scene.name) continue;
    const auto instance =
        std::ranges::find(scene.instances, text_in(table, row, "object_id"), &KnownInstance::name);
    if (instance == scene.instances.end()) continue;
    starts.push_back({id, static_cast<int>(instance - scene.instances.begin()),
                      level_in(table, row, folder / "starts.csv"), pose_in(table, row, "r00")});
  }
  return starts;
}

std::vector<RecordedResult> recorded_results(const fs::path& file) {
  const Table table = load_table(file);
  require_columns(table, file,
                  {"start_id", "image", "object_id", "level", "method", "cpu_ms", "ok", "tz"});
  const std::string first =
      std::ranges::find(table.columns, "r00") == table.columns.end() ? "R00" : "r00";
  require_columns(table, file, {first.c_str()});
  std::vector<RecordedResult> results;
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    results.push_back({static_cast<int>(number_in(table, row, "start_id")),
                       text_in(table, row, "image"), text_in(table, row, "object_id"),
                       text_in(table, row, "method"), level_in(table, row, file),
                       pose_in(table, row, first), number_in(table, row, "ok") != 0,
                       number_in(table, row, "cpu_ms")});
  return results;
}

}  // namespace edgescout
