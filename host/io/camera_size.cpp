// The image that a calibration is for: its size, region of interest and binning.
#include <algorithm>
#include <cmath>
#include <limits>

#include "host/io/camera_reader.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

int size_side(const JsonField& field) {
  const int side = whole_number_in_field(field);
  if (side < 0) field.fail(std::to_string(side), "an image size in px");
  return side;
}

// "640x480" and lists of two.
std::vector<double> two_sides(const JsonField& field) {
  if (field.value.is_string()) {
    std::string text = field.value.get<std::string>();
    for (char& c : text)
      if (c == 'x' || c == 'X' || c == '*') c = ' ';
    const nlohmann::json spaced = text;
    return numbers_in_field({spaced, field.source, field.path});
  }
  return numbers_in_field(field);
}

std::vector<double> without_channels(std::vector<double> sides) {
  if (sides.size() == 3 && sides[2] <= 4) sides.pop_back();  // the shape of an array
  return sides;
}

// Programs disagree whether a list is (width, height) or (height, width). The principal point
// decides, and for a square image it does not matter.
void set_listed_size(Camera& camera, const JsonField& field, bool height_first) {
  const std::vector<double> sides = without_channels(two_sides(field));
  const auto is_side = [](double side) {
    return side >= 0 && side <= std::numeric_limits<int>::max() && side == std::floor(side);
  };
  if (sides.size() != 2 || !std::ranges::all_of(sides, is_side))
    field.fail(field.value.dump().substr(0, 60), "width and height in px");
  const auto off_centre = [&](double width, double height) {
    return std::abs(camera.cx / width - 0.5) + std::abs(camera.cy / height - 0.5);
  };
  const double first = off_centre(sides[0], sides[1]), second = off_centre(sides[1], sides[0]);
  const bool swapped = first == second ? height_first : second < first;
  camera.width = static_cast<int>(sides[swapped ? 1 : 0]);
  camera.height = static_cast<int>(sides[swapped ? 0 : 1]);
}

// Whether a field beside width and height holds the size of an image: "resolution: VGA" holds a
// word, "size: [9, 6]" the corners of a board.
bool holds_a_size(const JsonField& field) {
  constexpr double least_side = 32;
  const bool is_number_alone = field.value.is_number() || field.value.is_boolean();
  if (is_number_alone || is_trivial(field.value)) return false;
  try {
    const std::vector<double> sides = without_channels(two_sides(field));
    return sides.size() == 2 && std::min(sides[0], sides[1]) >= least_side;
  } catch (const InputError&) {
    return false;
  }
}

// The order of a list is not sure (set_listed_size).
void require_same_size(const Camera& camera, const JsonField& field) {
  if (!holds_a_size(field)) return;
  const std::vector<double> sides = without_channels(two_sides(field));
  const bool is_same = (sides[0] == camera.width && sides[1] == camera.height) ||
                       (sides[0] == camera.height && sides[1] == camera.width);
  if (!is_same)
    field.fail(field.value.dump().substr(0, 60), std::to_string(camera.width) + " x " +
                                                     std::to_string(camera.height) +
                                                     " as in width and height");
}

struct Region {
  double x = 0, y = 0;
  int width = 0, height = 0;  // 0: the whole image
};

double offset_in(const JsonField& field) {
  const double offset = number_in_field(field);
  if (offset < 0) field.fail(field.value.dump(), "an offset of at least 0 px");
  return offset;
}

Region read_region(const JsonField& field) {
  if (!field.value.is_object())
    field.fail(field.value.dump().substr(0, 60), "x_offset, y_offset, width and height");
  CameraFields roi(field.value, field.source, field.path);
  Region region;
  if (const auto x = roi.take({"xoffset", "offsetx", "x", "left"})) region.x = offset_in(*x);
  if (const auto y = roi.take({"yoffset", "offsety", "y", "top"})) region.y = offset_in(*y);
  if (const auto width = roi.take({"width", "w"})) region.width = size_side(*width);
  if (const auto height = roi.take({"height", "h"})) region.height = size_side(*height);
  roi.take({"dorectify"});  // says how to rectify, nothing of this image
  for (const std::string& name : roi.unread())
    throw InputError(field.source, name, "a field of a region",
                     "x_offset, y_offset, width, height");
  if ((region.width == 0) != (region.height == 0))
    field.fail("one side", "both width and height, or neither");
  return region;
}

void cut_out(Camera& camera, const Region& region, const JsonField& field) {
  const bool is_calibrations_size = region.width == camera.width && region.height == camera.height;
  if (region.width == 0 && (region.x != 0 || region.y != 0))
    field.fail("an offset without a size", "width and height of the region as well");
  camera.cx -= region.x;
  camera.cy -= region.y;
  // A file whose size is the region's may hold the intrinsics of the region already.
  if (is_calibrations_size && (camera.cx < 0 || camera.cy < 0))
    field.fail("an offset that moves the principal point out of the image",
               "intrinsics of the whole sensor, or no region where they are the region's already");
  if (region.width == 0) return;
  camera.width = region.width;
  camera.height = region.height;
}

int binning_of(CameraFields& fields, std::initializer_list<std::string_view> names) {
  const auto field = fields.take(names);
  if (!field) return 1;
  const int binning = whole_number_in_field(*field);
  if (binning < 0 || binning > 64) field->fail(std::to_string(binning), "0 to 64");
  return std::max(binning, 1);
}

// Not of what the camera stands in: a list of all cameras' sizes, a screen.
bool is_of(const CameraFields& fields, const JsonField& field) {
  return fields.path().empty() || field.path.starts_with(fields.path() + "/");
}

}  // namespace

void read_size(CameraFields& fields, Camera& camera) {
  const auto width =
      fields.take({"width", "imagewidth", "imgwidth", "imwidth", "w", "sensorwidth", "camerawidth",
                   "imagewidthpx", "widthpx", "resolutionx", "resx", "resolutionwidth", "nx"});
  const auto height = fields.take({"height", "imageheight", "imgheight", "imheight", "h",
                                   "sensorheight", "cameraheight", "imageheightpx", "heightpx",
                                   "resolutiony", "resy", "resolutionheight", "ny"});
  if (width) camera.width = size_side(*width);
  if (height) camera.height = size_side(*height);
  const bool height_first = fields.has_spelt("ImageSize") || fields.has_spelt("K");
  if (const auto listed = fields.take(
          {"resolution", "imagesize", "imgsize", "imsize", "size", "imageresolution", "imageshape",
           "shape", "imgshape", "imagedimension", "imagedimensions", "imagedims", "dim", "dims"})) {
    if (!width && !height)
      set_listed_size(camera, *listed, height_first);
    else if (width && height && camera.width > 0 && camera.height > 0 && is_of(fields, *listed))
      require_same_size(camera, *listed);
  }
  if ((camera.width == 0) != (camera.height == 0))
    throw InputError(fields.source(), fields.at(camera.width ? "image_height" : "image_width"),
                     "nothing", "both sizes or neither");
}

void read_roi_and_binning(CameraFields& fields, Camera& camera) {
  // ROS (REP 104): the region is in pixels of the sensor, whatever the binning.
  if (const auto roi = fields.take({"roi", "regionofinterest"}); roi && !is_trivial(roi->value))
    cut_out(camera, read_region(*roi), *roi);
  const int x = binning_of(fields, {"binningx", "binninghorizontal"}),
            y = binning_of(fields, {"binningy", "binningvertical"});
  if (x == 1 && y == 1) return;
  camera.width /= x;
  camera.height /= y;
  camera.fx /= x;
  camera.fy /= y;
  camera.skew /= x;
  camera.cx = (camera.cx + 0.5) / x - 0.5;
  camera.cy = (camera.cy + 0.5) / y - 0.5;
}

}  // namespace edgescout
