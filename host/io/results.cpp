#include "host/io/results.h"

#include <limits>

#include "host/io/files.h"
#include "host/io/json_fields.h"
#include "host/io/json_text.h"
#include "kernels/error.h"

namespace edgescout {

using nlohmann::ordered_json;  // keeps the order of the fields, for people who read the file

namespace {

constexpr int format_version = 3;
constexpr int oldest_version = 2;  // of those that are read
constexpr const char* version_field = "edgescout_result";
constexpr const char* psi_z_score_field = "psi_z_score";
constexpr const char* psi_z_score_field_of_version_2 = "evidence";

ordered_json with_quaternion(const Se3& pose) {
  const Eigen::Quaterniond& q = pose.rotation;
  ordered_json fields = pose_json(pose);
  fields["quaternion_wxyz"] = {q.w(), q.x(), q.y(), q.z()};
  return fields;
}

// The camera of a result is ideal; the field keeps the length that it had in the first version.
constexpr std::size_t written_coefficients = 8;

ordered_json camera_json(const Camera& c) {
  return {{"width", c.width},
          {"height", c.height},
          {"fx", c.fx},
          {"fy", c.fy},
          {"cx", c.cx},
          {"cy", c.cy},
          {"distortion",
           std::vector<double>(c.distortion.begin(), c.distortion.begin() + written_coefficients)}};
}

ordered_json alternatives_json(const Detection& detection, const Se3& camera_from_world) {
  ordered_json list = ordered_json::array();
  for (const AlternativePose& pose : detection.alternatives)
    list.push_back(
        {{"probability", pose.probability},
         {"world_from_object", with_quaternion(pose.world_from_object)},
         {"camera_from_object", with_quaternion(camera_from_world * pose.world_from_object)}});
  return list;
}

ordered_json detection_json(const Detection& detection, const ImageResult& result) {
  const ObjectName& object = result.objects.at(static_cast<std::size_t>(detection.object));
  const Se3 camera_from_world = result.camera_from_world.value_or(Se3{});
  const Matrix6d transposed = detection.covariance.transpose();  // Eigen stores by column
  return {
      {"object_id", object.id},
      {"object", object.name},
      {"probability", detection.probability},
      {"psi", detection.psi},
      {"cost_px", detection.cost_px},
      {"matched_fraction", detection.matched_fraction},
      {psi_z_score_field, detection.psi_z_score},
      {"unexplained_grey", detection.unexplained_grey},
      {"convergence", detection.convergence},
      {"world_from_object", with_quaternion(detection.world_from_object)},
      {"camera_from_object", with_quaternion(camera_from_world * detection.world_from_object)},
      {"covariance", std::vector<double>(transposed.data(), transposed.data() + transposed.size())},
      {"alternatives", alternatives_json(detection, camera_from_world)}};
}

double number_or_nan(const JsonField& field) {
  return field.value.is_null() ? std::numeric_limits<double>::quiet_NaN() : field.number();
}

Se3 read_pose(const JsonField& field) { return pose_from(field.at("R"), field.at("t"), 1.0); }

Camera read_camera(const JsonField& field) {
  Camera c;
  c.width = field.at("width").integer();
  c.height = field.at("height").integer();
  c.fx = field.at("fx").number();
  c.fy = field.at("fy").number();
  c.cx = field.at("cx").number();
  c.cy = field.at("cy").number();
  const std::vector<double> distortion = field.at("distortion").numbers(written_coefficients);
  std::copy(distortion.begin(), distortion.end(), c.distortion.begin());
  validate(c, field.source + ": " + field.path);
  return c;
}

Settings read_settings(const JsonField& field) {
  Settings settings;
  for (const auto& item : field.value.items())
    settings.emplace_back(item.key(), field.at(item.key()).text());
  return settings;
}

int index_of(const JsonField& object_id, const std::vector<ObjectName>& objects) {
  for (std::size_t i = 0; i < objects.size(); ++i)
    if (objects[i].id == object_id.integer()) return static_cast<int>(i);
  object_id.fail(object_id.value.dump(), "the id of one of the file's objects");
}

int read_version(const JsonField& root) {
  const JsonField version = root.at(version_field);
  if (version.integer() < oldest_version || version.integer() > format_version)
    version.fail(version.value.dump(), "version " + std::to_string(oldest_version) + " or " +
                                           std::to_string(format_version));
  return version.integer();
}

Detection read_detection(const JsonField& field, const std::vector<ObjectName>& objects,
                         int version) {
  Detection detection;
  detection.object = index_of(field.at("object_id"), objects);
  detection.world_from_object = read_pose(field.at("world_from_object"));
  const std::vector<JsonField> covariance = field.at("covariance").elements();
  if (covariance.size() != 36)
    field.at("covariance").fail(std::to_string(covariance.size()) + " numbers", "36");
  for (int i = 0; i < 36; ++i)
    detection.covariance(i / 6, i % 6) = number_or_nan(covariance[static_cast<std::size_t>(i)]);
  detection.probability = number_or_nan(field.at("probability"));
  detection.psi = number_or_nan(field.at("psi"));
  detection.cost_px = number_or_nan(field.at("cost_px"));
  detection.matched_fraction = number_or_nan(field.at("matched_fraction"));
  detection.psi_z_score =
      number_or_nan(field.at(version == 2 ? psi_z_score_field_of_version_2 : psi_z_score_field));
  detection.unexplained_grey = number_or_nan(field.at("unexplained_grey"));
  detection.convergence = field.at("convergence").text();
  if (field.has("alternatives"))
    for (const JsonField& pose : field.at("alternatives").elements())
      detection.alternatives.push_back(
          {read_pose(pose.at("world_from_object")), number_or_nan(pose.at("probability"))});
  return detection;
}

}  // namespace

void save_image_result(const ImageResult& result, const std::filesystem::path& file) {
  ordered_json root;
  root[version_field] = format_version;
  root["image"] = result.image.string();
  root["scene_id"] = result.scene_id;
  root["image_id"] = result.image_id;
  if (!result.camera_name.empty()) root["camera_name"] = result.camera_name;
  root["device"] = result.device;
  root["camera"] = camera_json(result.camera);
  if (!result.incomplete.empty()) root["incomplete"] = result.incomplete;
  for (const auto& [name, value] : result.settings) root["settings"][name] = value;
  root["world"] = result.camera_from_world ? "scene" : "camera";
  if (result.camera_from_world)
    root["camera_from_world"] = with_quaternion(*result.camera_from_world);
  root["timings_ms"] = ordered_json::array();
  for (const StageSeconds& stage : result.stages)
    root["timings_ms"].push_back({{"stage", stage.name}, {"ms", 1000 * stage.seconds}});
  root["objects"] = ordered_json::array();
  for (const ObjectName& object : result.objects)
    root["objects"].push_back({{"id", object.id}, {"name", object.name}});
  root["detections"] = ordered_json::array();
  for (const Detection& detection : result.detections)
    root["detections"].push_back(detection_json(detection, result));
  write_file_atomically(file, json_text(root));
}

ImageResult load_image_result(const std::filesystem::path& file) {
  const nlohmann::json content = read_json(file);
  const JsonField root{content, file.string(), ""};
  const int version = read_version(root);
  ImageResult result;
  result.image = root.at("image").text();
  result.scene_id = root.at("scene_id").integer();
  result.image_id = root.at("image_id").integer();
  if (root.has("camera_name")) result.camera_name = root.at("camera_name").text();
  result.device = root.at("device").text();
  result.camera = read_camera(root.at("camera"));
  if (root.has("incomplete")) result.incomplete = root.at("incomplete").text();
  if (root.has("settings")) result.settings = read_settings(root.at("settings"));
  if (root.has("camera_from_world"))
    result.camera_from_world = read_pose(root.at("camera_from_world"));
  for (const JsonField& stage : root.at("timings_ms").elements())
    result.stages.push_back({stage.at("stage").text(), stage.at("ms").number() / 1000});
  for (const JsonField& object : root.at("objects").elements())
    result.objects.push_back({object.at("id").integer(), object.at("name").text()});
  for (const JsonField& detection : root.at("detections").elements())
    result.detections.push_back(read_detection(detection, result.objects, version));
  return result;
}

bool is_image_result(const std::filesystem::path& file) {
  const nlohmann::json content = read_json(file);
  return content.is_object() && content.contains(version_field);
}

}  // namespace edgescout
