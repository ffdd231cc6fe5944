// Cameras of AliceVision (Meshroom): focal lengths and sensors in mm, the principal point from the
// middle of the image.
#include <algorithm>
#include <array>
#include <map>

#include "host/io/camera_programs.h"
#include "host/io/camera_tree.h"

namespace edgescout {

using nlohmann::json;

namespace {

using AliceVersion = std::array<int, 3>;

AliceVersion alice_version(const JsonField& root) {
  AliceVersion version{};
  const std::vector<double> numbers = numbers_in_field(root.at("version"));
  if (numbers.size() != version.size())
    root.at("version").fail(std::to_string(numbers.size()) + " numbers",
                            "the 3 of AliceVision's version");
  for (std::size_t i = 0; i < version.size(); ++i)
    version[i] = whole_number_in_field({json(numbers[i]), root.source, root.path + "version"});
  return version;
}

// The versions of the format differ in units and in what the ratio of the pixels' sides divides.
void set_alice_pinhole(const JsonField& camera, const AliceVersion& version, json& read) {
  const double width = number_at(camera, "width"), height = number_at(camera, "height");
  double fx = 0, fy = 0;
  if (version < AliceVersion{1, 2, 2}) {
    const std::vector<double> focal = numbers_in_field(camera.at("pxFocalLength"));
    if (focal.empty() || focal.size() > 2)
      camera.at("pxFocalLength").fail(std::to_string(focal.size()) + " numbers", "1 or 2");
    fx = focal.front(), fy = focal.back();
  } else {
    const double ratio = camera.has("pixelRatio") ? number_at(camera, "pixelRatio") : 1;
    fx = number_at(camera, "focalLength") / number_at(camera, "sensorWidth") * width;
    fy = version < AliceVersion{1, 2, 5} ? fx / ratio : fx * ratio;
  }
  const std::vector<double> point = numbers_in_field(camera.at("principalPoint"));
  if (point.size() != 2)
    camera.at("principalPoint").fail(std::to_string(point.size()) + " numbers", "2");
  const bool is_from_corner = version < AliceVersion{1, 2, 1};
  read["fx"] = fx;
  read["fy"] = fy;
  read["cx"] = point[0] + (is_from_corner ? 0 : width / 2);
  read["cy"] = point[1] + (is_from_corner ? 0 : height / 2);
  read["width"] = width;
  read["height"] = height;
}

struct AliceLens {
  const char* word;
  std::vector<std::size_t> places;  // of each coefficient in the order of the model
};
const std::map<std::string, AliceLens, std::less<>> alice_lenses{
    {"pinhole", {"pinhole", {}}},
    {"none", {"pinhole", {}}},
    {"radial1", {"plumb_bob", {0}}},
    {"radialk1", {"plumb_bob", {0}}},
    {"radial3", {"plumb_bob", {0, 1, 4}}},
    {"radialk3", {"plumb_bob", {0, 1, 4}}},
    {"brown", {"plumb_bob", {0, 1, 4, 2, 3}}},
    {"fisheye4", {"fisheye", {0, 1, 2, 3}}},
    {"fisheye", {"fisheye", {0, 1, 2, 3}}},
    {"fisheye1", {"fov", {0}}}};

void set_alice_lens(const JsonField& camera, json& read) {
  const JsonField type = camera.at("type");
  // Later versions keep the projection and the distortion apart.
  const bool is_apart = camera.has("distortionType") && type.text() == "pinhole";
  const JsonField named = is_apart ? camera.at("distortionType") : type;
  const auto lens = alice_lenses.find(named.text());
  if (lens == alice_lenses.end())
    named.fail("a calibration of AliceVision, model " + named.text(),
               "AliceVision's pinhole, radial1, radial3, brown, fisheye4 or fisheye1");
  const JsonField list = camera.at("distortionParams");
  const std::vector<double> written =
      is_trivial(list.value) ? std::vector<double>{} : numbers_in_field(list);
  const std::vector<std::size_t>& places = lens->second.places;
  if (written.size() > places.size() || (!written.empty() && written.size() < places.size()))
    list.fail(std::to_string(written.size()) + " coefficients",
              std::to_string(places.size()) + " of AliceVision's model " + named.text());
  std::vector<double> ordered(lens->second.word == std::string("fov") ? 1 : 5);
  for (std::size_t i = 0; i < written.size(); ++i) ordered[places[i]] = written[i];
  read["distortion_model"] = written.empty() ? "pinhole" : lens->second.word;
  read["D"] = ordered;
}

json alice_camera(const JsonField& camera, const AliceVersion& version) {
  for (const auto& [key, value] : camera.value.items()) {
    const bool is_known =
        is_any_of(key, {"type", "distortionType", "distortionParams", "distortionLocked",
                        "distortionInitializationMode", "principalPoint", "undistortionType"});
    if (!is_known && changes_the_image(plain_name(key), value))
      camera.at(key).fail("a value of AliceVision", "0 or nothing");
  }
  json read = json::object();
  set_alice_pinhole(camera, version, read);
  set_alice_lens(camera, read);
  return read;
}

}  // namespace

bool is_of_alicevision(const json& tree) {
  return tree.is_object() && tree.contains("intrinsics") && tree["intrinsics"].is_array() &&
         !tree["intrinsics"].empty() &&
         std::ranges::all_of(tree["intrinsics"], [](const json& camera) {
           return camera.is_object() && camera.contains("intrinsicId");
         });
}

json alicevision_cameras(const JsonField& root) {
  const AliceVersion version = alice_version(root);
  json cameras = json::object();
  for (const json& camera : root.value["intrinsics"]) {
    const std::string name = text_in_field({camera["intrinsicId"], root.source, "intrinsicId"});
    add_field(cameras, name, alice_camera({camera, root.source, "intrinsics/" + name}, version),
              root.source);
  }
  return cameras;
}

}  // namespace edgescout
