#include "host/io/camera_file.h"

#include <algorithm>
#include <cmath>

#include "host/core/option_names.h"
#include "host/io/camera_reader.h"
#include "host/io/camera_tree.h"
#include "host/io/files.h"
#include "host/io/one_line.h"
#include "kernels/error.h"

namespace edgescout {

using nlohmann::json;

namespace {

std::string size_of(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

// Programs also write focal lengths in parts of the image's width, or in mm.
void require_focal_px(const Camera& camera, const std::string& source) {
  constexpr double least_of_side = 0.02;  // of the shorter one: it would show 175 degrees
  const double longest_px = std::max(camera.fx, camera.fy);
  if (longest_px < least_of_side * std::min(camera.width, camera.height))
    throw InputError(source, "fx, fy",
                     std::to_string(camera.fx) + " and " + std::to_string(camera.fy) +
                         " px in an image of " + size_of(camera.width, camera.height),
                     "focal lengths in px (these may be in mm, or in parts of the width)");
}

void validate_in_file(const Camera& camera, const std::string& source) {
  require_focal_px(camera, source);
  // Without a size in the file, the principal point is checked when the image's size is known.
  Camera checked = camera;
  if (camera.width == 0) checked.width = checked.height = 1 << 20;
  validate(checked, source);
}

// Walks through a file down to the objects that hold intrinsics.
class CameraFinder {
 public:
  explicit CameraFinder(std::string source) : source_(std::move(source)) {}

  std::vector<FileCamera> find(const json& root) {
    visit(root, "", {}, 0);
    if (cameras_.empty()) fail_without_cameras(root);
    // What stands beside the cameras must say nothing of them.
    for (const FileObject& object : others_)
      CameraFields(object.value, source_, object.path).require_all_understood();
    return cameras_;
  }

 private:
  struct FileObject {
    std::string path;
    json value;
  };

  void visit(const json& node, const std::string& path, std::vector<JsonField> outer, int depth) {
    if (!node.is_structured() || depth > 8) return;
    if (node.is_array()) return visit_elements(node, path, outer, depth);
    if (const json pair = split_stereo_pair(node); !pair.is_null())
      return visit(pair, path, outer, depth + 1);
    CameraFields fields(node, source_, path, outer);
    if (fields.has_intrinsics()) return add(fields, path);
    for (const auto& [key, value] : node.items())
      if (!value.is_structured() || (value.is_array() && is_list(value)))
        outer.push_back({value, source_, join(path, key)});
    for (const auto& [key, value] : node.items()) {
      const std::size_t before = cameras_.size();
      visit(value, join(path, key), with_lens_beside(outer, node, key, path), depth + 1);
      if (value.is_object() && cameras_.size() == before && !is_lens_of_side(node, key))
        others_.push_back({join(path, key), value});
    }
  }

  void visit_elements(const json& list, const std::string& path,
                      const std::vector<JsonField>& outer, int depth) {
    const std::size_t before_all = cameras_.size();
    std::vector<FileObject> no_cameras;
    for (std::size_t i = 0; i < list.size(); ++i) {
      const std::string name = join(path, name_of(list[i], i));
      const std::size_t before = cameras_.size();
      visit(list[i], name, of_element(outer, i, list.size()), depth + 1);
      if (list[i].is_object() && cameras_.size() == before) no_cameras.push_back({name, list[i]});
    }
    // Lists of something else than cameras say nothing of these.
    if (cameras_.size() > before_all) std::ranges::move(no_cameras, std::back_inserter(others_));
  }

  // Basalt: a list of cameras beside a list of their resolutions.
  static std::vector<JsonField> of_element(const std::vector<JsonField>& outer, std::size_t index,
                                           std::size_t count) {
    std::vector<JsonField> fields;
    for (const JsonField& field : outer) {
      const bool is_each = field.value.is_array() && field.value.size() == count &&
                           std::ranges::all_of(field.value, &json::is_array);
      fields.push_back({is_each ? field.value[index] : field.value, field.source, field.path});
    }
    return fields;
  }

  // ZED: [LEFT_CAM_HD] has the matrix, [LEFT_DISTO] the coefficients for all sizes.
  static std::string side_of(const std::string& key) { return key.substr(0, key.find('_')); }
  static bool is_lens_section(const std::string& key, const json& value) {
    return value.is_object() && key.ends_with("_DISTO");
  }
  static bool is_lens_of_side(const json& node, const std::string& key) {
    return is_lens_section(key, node[key]) &&
           std::ranges::any_of(node.items(), [&](const auto& other) {
             return other.key() != key && side_of(other.key()) == side_of(key);
           });
  }
  std::vector<JsonField> with_lens_beside(std::vector<JsonField> outer, const json& node,
                                          const std::string& key, const std::string& path) const {
    for (const auto& [other, section] : node.items())
      if (other != key && is_lens_section(other, section) && side_of(other) == side_of(key))
        for (const auto& [name, value] : section.items())
          outer.push_back({value, source_, join(join(path, other), name)});
    return outer;
  }

  void add(CameraFields& fields, const std::string& path) {
    const std::string where = path.empty() ? source_ : source_ + ": " + path;
    for (const NamedCamera& camera : read_azure_kinect(fields))
      cameras_.push_back({camera.name, camera.camera, fields.unread()});
    if (fields.has({"modelparameters"})) return;
    const Camera camera = read_camera(fields);
    validate_in_file(camera, where);
    cameras_.push_back({path, camera, fields.unread()});
  }

  // The error of reading intrinsics says what is missing.
  [[noreturn]] void fail_without_cameras(const json& root) const {
    const json nothing = json::object();
    CameraFields fields(root.is_object() ? root : nothing, source_, "");
    read_camera(fields);
    throw InputError(source_, "file", "no camera", "a camera calibration");
  }

  static std::string join(const std::string& path, const std::string& name) {
    return path.empty() ? name : path + "/" + name;
  }

  static std::string name_of(const json& element, std::size_t index) {
    for (const char* field :
         {"name", "camera_name", "cameraName", "camera_id", "id", "serial", "type"})
      if (element.is_object() && element.contains(field)) {
        const json& value = element[field];
        return value.is_string() ? value.get<std::string>() : value.dump();
      }
    return std::to_string(index);
  }

  std::string source_;
  std::vector<FileCamera> cameras_;
  std::vector<FileObject> others_;
};

std::vector<FileCamera> find_cameras(const std::string& text, const std::string& source,
                                     bool is_json) {
  return with_errors_of_one_line([&] {
    try {
      return CameraFinder(source).find(
          with_common_fields(parse_camera_tree(text, source, is_json), source));
    } catch (const InputError&) {
      if (const std::optional<std::string> program = program_that_is_not_read(text))
        throw InputError(source, "file", "a calibration of " + *program,
                         "its export in the format of OpenCV");
      throw;
    }
  });
}

bool all_same(const std::vector<FileCamera>& cameras) {
  return std::ranges::all_of(cameras, [&](const FileCamera& other) {
    return same_camera(other.camera, cameras.front().camera);
  });
}

std::string listed(const std::vector<FileCamera>& cameras) {
  constexpr std::size_t shown = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(shown, cameras.size()); ++i) {
    const Camera& camera = cameras[i].camera;
    text += (i == 0 ? "" : ", ") + cameras[i].name;
    if (camera.width > 0) text += " (" + size_of(camera.width, camera.height) + ")";
  }
  return text + (cameras.size() > shown ? " .." : "");
}

bool is_named(const FileCamera& camera, const std::string& name) {
  return name.empty() || camera.name == name || camera.name.ends_with("/" + name);
}

}  // namespace

std::vector<FileCamera> load_cameras(const std::filesystem::path& file) {
  return find_cameras(read_file(file), file.string(), file.extension() == ".json");
}

std::vector<FileCamera> cameras_in(const std::string& text, const std::string& source) {
  return find_cameras(text, source, false);
}

std::vector<FileCamera> cameras_named(const std::string& name,
                                      const std::vector<FileCamera>& cameras,
                                      const std::string& source) {
  std::vector<FileCamera> named;
  std::ranges::copy_if(cameras, std::back_inserter(named),
                       [&](const FileCamera& camera) { return is_named(camera, name); });
  if (named.empty()) throw InputError(source, "cameras", listed(cameras), "one named " + name);
  return named;
}

Camera choose_camera(const std::vector<FileCamera>& cameras, const std::string& name,
                     const std::function<SizePx()>& image_size, const std::string& source) {
  std::vector<FileCamera> left = cameras_named(name, cameras, source);
  if (all_same(left)) return left.front().camera;
  if (image_size) {
    const SizePx size = image_size();
    std::erase_if(left, [&](const FileCamera& other) {
      const SizePx own(other.camera.width, other.camera.height);
      return own != size && own != SizePx();  // without a size it may be any
    });
    if (left.empty())
      throw InputError(source, "cameras", listed(cameras),
                       "one for images of " + size_of(size.first, size.second));
    if (all_same(left)) return left.front().camera;
  }
  throw InputError(source, "cameras", listed(left) + " that differ",
                   "one camera, or " + option_name("camera-name") + " with the name of one");
}

Camera load_camera(const std::filesystem::path& file, const std::string& name) {
  return choose_camera(load_cameras(file), name, {}, file.string());
}

Camera camera_for_image(const Camera& calibration, int width, int height, bool allow_scale,
                        const std::string& source) {
  Camera camera = calibration;
  camera.width = width;
  camera.height = height;
  if (calibration.width != 0 && (calibration.width != width || calibration.height != height)) {
    const double x = static_cast<double>(width) / calibration.width,
                 y = static_cast<double>(height) / calibration.height;
    const bool pure_scale = std::abs(x / y - 1) <= 0.005;
    if (!pure_scale || !allow_scale)
      throw InputError(
          source, "image size", size_of(width, height),
          "the calibration's " + size_of(calibration.width, calibration.height) +
              (pure_scale ? " (a pure scale: allow it with " + option_name("scale-camera") + ")"
                          : ""));
    // Each axis has its own factor, since the image's size is rounded. See scaled() for the half
    // pixels.
    camera.fx *= x;
    camera.fy *= y;
    camera.skew *= x;
    camera.cx = x * (camera.cx + 0.5) - 0.5;
    camera.cy = y * (camera.cy + 0.5) - 0.5;
  }
  require_focal_px(camera, source);
  validate(camera, source);
  return camera;
}

}  // namespace edgescout
