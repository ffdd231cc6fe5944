#include "host/track/cropped_registration.h"

#include <algorithm>
#include <cmath>

#include "host/core/lens.h"
#include "host/register/measured_depth.h"
#include "host/register_objects.h"
#include "host/track/reduced_image.h"

namespace edgescout {

namespace {

constexpr double crop_margin = 0.5;        // of the object's radius, at every side
constexpr int least_px = 64;               // of a crop's side: tensors of less hold too few edges
constexpr double most_pixels = 400 * 400;  // of a crop: they are what its registration costs

struct Interval {
  int first, size;
};

// The whole pixels around `middle` that the image has; empty where it has none.
Interval pixels_around(double middle_px, double half_px, int image_px) {
  const double half = std::max(half_px, 0.5 * least_px);
  const double low = std::clamp(std::floor(middle_px - half), 0.0, double(image_px)),
               high = std::clamp(std::ceil(middle_px + half), 0.0, double(image_px));
  return {int(low), int(high - low)};
}

Image cut_out(const Image& image, const Interval& columns, const Interval& rows) {
  Image part{columns.size, rows.size, {}};
  part.pixels.reserve(std::size_t(part.width) * part.height);
  for (int y = rows.first; y < rows.first + rows.size; ++y) {
    const auto row = image.pixels.begin() + std::ptrdiff_t(y) * image.width + columns.first;
    part.pixels.insert(part.pixels.end(), row, row + columns.size);
  }
  return part;
}

// The same crop, reduced where it has too many pixels.
Crop with_few_pixels(Crop crop) {
  const double pixels = double(crop.image.width) * crop.image.height;
  crop.reduction = std::max(1, int(std::ceil(std::sqrt(pixels / most_pixels))));
  if (crop.reduction == 1) return crop;
  crop.image = reduced(crop.image, crop.reduction);
  crop.camera.width = crop.reduction * crop.image.width;
  crop.camera.height = crop.reduction * crop.image.height;
  crop.camera = scaled(crop.camera, 1.0 / crop.reduction);
  return crop;
}

// What the nearest pixels of another ideal camera at the same place measured.
std::shared_ptr<const MeasuredDepth> seen_from(const MeasuredDepth& depth, const Camera& measured,
                                               const Camera& ideal) {
  MeasuredDepth part{{ideal.width, ideal.height, {}}, depth.noise};
  for (int y = 0; y < ideal.height; ++y)
    for (int x = 0; x < ideal.width; ++x) {
      const Eigen::Vector2d at =
          project(measured, ray_through(ideal, Eigen::Vector2d(x, y))).array().round();
      const bool is_inside =
          at.x() >= 0 && at.y() >= 0 && at.x() < measured.width && at.y() < measured.height;
      part.image.z_m.push_back(is_inside ? depth.image.at(int(at.x()), int(at.y()))
                                         : DEPTH_MISSING);
    }
  return std::make_shared<const MeasuredDepth>(std::move(part));
}

}  // namespace

std::optional<Crop> crop_around(const SearchedImage& image, const EdgeModel& model,
                                const Se3& camera_from_object) {
  const Camera& camera = image.camera;
  const Eigen::Vector3d center_m = camera_from_object * model.center_m;
  if (!(center_m.z() > model.radius_m)) return std::nullopt;
  const Eigen::Vector2d middle_px = pixel_seeing(camera, center_m.head<2>() / center_m.z());
  if (!middle_px.allFinite()) return std::nullopt;
  const double half_px =
      (1 + crop_margin) * model.radius_m / center_m.z() * std::max(camera.fx, camera.fy);
  const Interval columns = pixels_around(middle_px.x(), half_px, camera.width),
                 rows = pixels_around(middle_px.y(), half_px, camera.height);
  if (std::min(columns.size, rows.size) < least_px / 2) return std::nullopt;
  Crop crop{cut_out(*image.image, columns, rows), camera};
  crop.camera.width = columns.size;
  crop.camera.height = rows.size;
  crop.camera.cx -= columns.first;
  crop.camera.cy -= rows.first;
  return with_few_pixels(std::move(crop));
}

std::optional<CroppedDetection> register_in_crop(const SearchedImage& image, const EdgeModel& model,
                                                 std::span<const Se3> starts, Backend& backend,
                                                 const TrackOptions& options,
                                                 const TimeLimit& limit) {
  if (limit.is_over()) return std::nullopt;
  const std::optional<Crop> crop = crop_around(image, model, starts.front());
  if (!crop) return std::nullopt;
  ObjectView view = prepare_view(crop->image, crop->camera, Se3{}, backend, options.pipeline);
  if (image.depth) view.depth = seen_from(*image.depth, image.ideal, view.camera);
  std::vector<ObjectPose> poses;
  for (const Se3& start : starts) poses.push_back({0, start});
  const RegisterObjectsOptions registration{options.pipeline.tensor, options.refine, limit};
  const Detections found = register_objects({&view, 1}, {&model, 1}, poses, backend, registration);
  if (found.completion != Completion::Complete) return std::nullopt;
  return CroppedDetection{*std::ranges::max_element(found.detections, {}, &Detection::probability),
                          crop->reduction};
}

}  // namespace edgescout
