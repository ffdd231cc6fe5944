// Names of fields that change where a point is seen, or what image the calibration is for. They are
// names that no reader knows: what is read is never asked here.
#include <algorithm>
#include <cctype>

#include "host/core/words.h"
#include "host/io/camera_fields.h"

namespace edgescout {

using nlohmann::json;

namespace {

bool is_numbered(std::string_view name, std::string_view letters, std::size_t most_digits) {
  return name.size() >= 2 && name.size() <= 1 + most_digits &&
         letters.find(name[0]) != std::string_view::npos &&
         std::ranges::all_of(name.substr(1), [](unsigned char c) { return std::isdigit(c); });
}

// Of a product or of a program's settings.
bool says_nothing_of_the_image(std::string_view name) {
  return is_any_of(name,
                   {"numradialdistortioncoefficients", "numcoefficients", "numcoeffs",
                    "estimatetangentialdistortion", "estimateskew", "lensname", "lensserial",
                    "lensserialnumber", "lensmake", "lensid", "lensmodelname", "lensposition"});
}

// The word for another lens than OpenCV's, under whatever name: "cam_type: fisheye". A title may
// hold such a word as well.
bool is_lens_word(std::string_view name, const json& value) {
  if (!value.is_string() ||
      contains_any_of(name, {"name", "id", "topic", "label", "title", "frame", "comment"}))
    return false;
  return is_any_of(plain_name(value.get<std::string>()),
                   {"fisheye", "equidistant", "equi", "kannalabrandt", "kannalabrandt4",
                    "kannalabrandt8", "kb4", "kb8", "opencvfisheye", "omnidirectional", "omni",
                    "doublesphere", "eucm", "ucm", "mei", "scaramuzza", "ftheta"});
}

// The order of parameters that stand elsewhere without names: "k1 k2 k3 p1 p2".
// A camera may be called K1.
bool is_order_of_coefficients(const json& value) {
  std::vector<std::string> words;
  if (value.is_string()) {
    words = words_of(value.get_ref<const std::string&>(), " ,;[]()");
  } else if (value.is_array() && std::ranges::all_of(value, &json::is_string)) {
    words = value.get<std::vector<std::string>>();
  }
  constexpr std::size_t longest_name = 5;
  const auto is_short = [](const std::string& word) { return word.size() <= longest_name; };
  const auto has = [&](std::string_view name) {
    return std::ranges::any_of(words, [&](const auto& word) { return plain_name(word) == name; });
  };
  return std::ranges::all_of(words, is_short) && has("k1") &&
         (has("k2") || has("p1") || has("fx") || has("f"));
}

// A table of where pixels lie, or the file that holds it. Tables of colours say nothing of that.
bool is_table(std::string_view name, const json& value) {
  const bool is_structured = value.is_string() || value.is_structured();
  if (!is_structured ||
      contains_any_of(name, {"color", "colour", "gamma", "tone", "vignet", "depth", "response"}))
    return false;
  return name.starts_with("lut") || name.ends_with("lut") ||
         contains_any_of(name, {"lookup", "remap", "raymap", "raytable"}) ||
         is_any_of(name, {"mapx", "mapy", "xmap", "ymap", "map1", "map2", "mapxy", "xymap",
                          "xytable", "rays", "raydirections", "pixelrays"});
}

bool is_lens(std::string_view name, const json& value) {
  if (value.is_number() && (is_numbered(name, "kps", 2) || is_numbered(name, "abcdeglr", 1) ||
                            (name.starts_with("kc") && is_numbered(name.substr(1), "c", 1)) ||
                            is_any_of(name, {"xi", "alpha", "beta", "omega", "s", "t1", "t2",
                                             "dist", "alphac", "meixi", "omnixi", "ucmxi"})))
    return true;
  if (is_list(value) && is_any_of(name, {"dc", "drect", "drectified", "draw", "rad", "tan"}))
    return true;
  const bool is_pair = value.is_array() && value.size() == 2;  // p1 and p2
  if (((value.is_string() || value.is_array()) && is_distortion_name(name)) ||
      (is_pair && name == "p") || is_lens_word(name, value) || is_table(name, value) ||
      is_order_of_coefficients(value))
    return true;
  return name.starts_with("tau") || name.ends_with("poly") || is_any_of(name, {"codx", "cody"}) ||
         contains_any_of(name,
                         {"distort",    "aberration", "fisheye",     "lens",        "prism",
                          "tangential", "radial",     "coef",        "decent",      "barrel",
                          "pincushion", "warp",       "kappa",       "tilt",        "scheimpflug",
                          "shear",      "skew",       "omnidir",     "mirrorparam", "affineparam",
                          "polynom",    "polyparam",  "telecentric", "entocentric"});
}

bool is_one(const json& value) {
  if (value.is_string()) return is_any_of(plain_name(value.get<std::string>()), {"1", "1x1"});
  if (value.is_array()) return std::ranges::all_of(value, is_one);
  return value == 1;
}

// A part of the image, binned or resized.
bool is_region(std::string_view name, const json& value) {
  if (value.is_number() &&
      is_any_of(name, {"left", "top", "x1", "y1", "x2", "y2", "xmin", "ymin", "xmax", "ymax"}))
    return true;
  const bool is_scale =
      contains_any_of(
          name, {"binning", "decimat", "subsampl", "downsampl", "downscal", "upscal", "zoom"}) ||
      name.starts_with("resiz") ||
      is_any_of(name, {"imageresize", "isresized", "binx", "biny", "xbin", "ybin", "hbin", "vbin",
                       "imagescale", "imgscale", "scalefactor", "scalingfactor"});
  const bool is_bin = name == "bin" && (value.is_number() || value.is_array());  // no file's name
  if (is_scale || is_bin) return !is_one(value);
  const bool is_word = value.is_string() && !is_list(value);
  if (!is_word && is_any_of(name, {"window", "region"})) return true;
  return name.starts_with("roi") || name.ends_with("roi") || name.ends_with("aoi") ||
         is_any_of(name, {"xoffset", "yoffset", "offsetx", "offsety", "cxoffset", "cyoffset",
                          "xstart", "ystart", "startx", "starty", "imagewindow", "sensorwindow",
                          "sensorarea", "activearea", "imagearea", "imageregion", "pad"}) ||
         contains_any_of(name, {"crop", "regionofinterest", "areaofinterest", "subwindow",
                                "viewport", "padding", "principalpoint"});
}

// Turned or mirrored. A matrix of that name is a pose.
bool is_orientation(std::string_view name, const json& value) {
  if (contains_any_of(name, {"flip", "mirror", "transpos"}) ||
      is_any_of(name, {"reversex", "reversey"}))
    return true;
  if (!value.is_number()) return false;
  if (name.ends_with("orientation")) return value != 1;  // of EXIF
  return name == "rotate" || name.ends_with("rotation") ||
         is_any_of(name, {"rotationdeg", "rotationdegrees", "rotationangle", "rotated"});
}

// Objects that are about something else than the image.
bool is_pose(std::string_view name) {
  return contains_any_of(name, {"extrinsic", "pose", "imu", "transform", "handeye"});
}

}  // namespace

bool changes_the_image(std::string_view name, const json& value) {
  return !is_trivial(value) && !says_nothing_of_the_image(name) &&
         (is_lens(name, value) || is_region(name, value) || is_orientation(name, value));
}

std::optional<JsonField> field_that_changes_the_image(const JsonField& field, int depth) {
  const std::string name = plain_name(field.path.substr(field.path.find_last_of("/.") + 1));
  if (changes_the_image(name, field.value)) return field;
  const bool is_searched =
      field.value.is_object() && !field.value.contains("data") && depth < 4 && !is_pose(name);
  if (!is_searched || CameraFields(field.value, field.source, field.path).has_intrinsics())
    return {};
  for (const auto& [key, value] : field.value.items())
    if (auto found =
            field_that_changes_the_image({value, field.source, field.path + "/" + key}, depth + 1))
      return found;
  return {};
}

}  // namespace edgescout
