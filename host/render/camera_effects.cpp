#include "host/render/camera_effects.h"

#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "host/render/optics.h"
#include "host/render/sensor.h"

namespace edgescout {
namespace {

constexpr std::string_view LENS_RESIDUE = "lens residue";

// One stream for each effect of an image. So a range that is switched on changes no other effect.
class Draws {
 public:
  Draws(unsigned seed, std::size_t view) : seed_(seed), view_(view) {}
  Random stream(std::string_view effect) const { return Random(seed_).split(effect).split(view_); }
  double of(std::string_view effect, const Range& range) const {
    Random random = stream(effect);
    return draw(range, random);
  }

 private:
  unsigned seed_;
  std::size_t view_;
};

void pass_lens(cv::Mat& light, const RenderOptions& options, const Camera& camera,
               const Draws& drawn) {
  const CameraRanges& ranges = options.camera;
  distort_radially(light, camera, drawn.of(LENS_RESIDUE, ranges.lens_residue_px));
  defocus(light, drawn.of("defocus", ranges.defocus_px));
  blur_by_motion(light, drawn.of("motion blur", ranges.motion_px),
                 drawn.of("motion direction", {0, std::numbers::pi}));
  if (options.blur_px > 0)
    cv::GaussianBlur(light, light, {0, 0}, options.blur_px, options.blur_px, cv::BORDER_REPLICATE);
  vignette(light, drawn.of("vignetting", ranges.vignetting));
  scale_contrast(light, drawn.of("contrast", ranges.contrast));
  if (const double factor = drawn.of("brightness", ranges.brightness); factor != 1) light *= factor;
}

}  // namespace

double lens_residue_px(const RenderOptions& options, std::size_t view) {
  return Draws(options.seed, view).of(LENS_RESIDUE, options.camera.lens_residue_px);
}

Image develop(cv::Mat light, const RenderOptions& options, const Camera& camera, std::size_t view) {
  const CameraRanges& ranges = options.camera;
  const Draws drawn(options.seed, view);
  pass_lens(light, options, camera, drawn);
  const double gamma = drawn.of("gamma", ranges.gamma);
  add_sensor_noise(light, drawn.of("noise level", ranges.noise_grey), gamma,
                   drawn.stream("sensor noise"));
  cv::Mat grey = display_curve(light, gamma);
  add_grey_noise(grey, options.noise_grey, drawn.stream("noise"));
  sharpen(grey, drawn.of("sharpening", ranges.sharpening),
          drawn.of("sharpening radius", ranges.sharpening_radius_px));
  return through_jpeg(round_to_image(grey),
                      static_cast<int>(std::lround(drawn.of("jpeg", ranges.jpeg_quality))));
}

}  // namespace edgescout
