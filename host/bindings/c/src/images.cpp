#include "host/bindings/c/src/images.h"

#include "host/bindings/c/src/contents.h"
#include "host/bindings/c/src/structs.h"
#include "host/io/camera_file.h"
#include "host/io/depth_file.h"
#include "host/io/pixels.h"

namespace edgescout::c {

namespace {

// `name` is that of the caller's struct.
Pixels pixels_of(const edgescout_image& given, const std::string& name) {
  if (given.format < 0 || given.format >= PIXEL_FORMATS)
    refuse(EDGESCOUT_BAD_INPUT, name + ".format", std::to_string(given.format),
           "EDGESCOUT_MONO8 or another format");
  require(given.pixels, (name + ".pixels").c_str());
  return {given.pixels, given.width, given.height, given.row_stride_bytes,
          PixelFormat(given.format)};
}

}  // namespace

Image image_of(const edgescout_image* image) {
  const auto given = read_struct(image, "image");
  return grey_image(pixels_of(given, "image"), options_of<ImageOptions>(given.options));
}

MeasuredDepth depth_of(const edgescout_image* depth) {
  const auto given = read_struct(depth, "depth");
  const auto options = options_of<DepthOptions>(given.options);
  return {depth_image(pixels_of(given, "depth"), options, "depth"), options.noise};
}

namespace {

Image undistorted_image(const edgescout_image* image, const edgescout_camera* camera) {
  const Image grey = image_of(image);
  return undistort(grey,
                   camera_for_image(*shared(camera), grey.width, grey.height, false, "camera"));
}

edgescout_image shown_image(const std::variant<Image, RgbImage>& picture) {
  edgescout_image shown{};
  std::visit(
      [&](const auto& image) {
        shown.pixels = image.pixels.data();
        shown.width = image.width;
        shown.height = image.height;
      },
      picture);
  const bool is_grey = std::holds_alternative<Image>(picture);
  shown.format = is_grey ? EDGESCOUT_MONO8 : EDGESCOUT_RGB8;
  shown.row_stride_bytes = std::int64_t(shown.width) * (is_grey ? 1 : 3);
  return shown;
}

}  // namespace

}  // namespace edgescout::c

using namespace edgescout::c;

edgescout_status edgescout_picture_load(const char* file, const edgescout_options* options,
                                        edgescout_picture** out) {
  return create(out, [&] {
    require(file, "file");
    return edgescout::load_image(file, options_of<edgescout::ImageOptions>(options));
  });
}

edgescout_status edgescout_picture_grey(const edgescout_image* image, edgescout_picture** out) {
  return create(out, [&] { return image_of(image); });
}

edgescout_status edgescout_picture_undistorted(const edgescout_image* image,
                                               const edgescout_camera* camera,
                                               edgescout_picture** out) {
  return create(out, [&] { return undistorted_image(image, camera); });
}

edgescout_status edgescout_picture_get(const edgescout_picture* picture, edgescout_image* out) {
  return guarded([&] { write_struct(shown_image(*shared(picture)), out, "out"); });
}

edgescout_status edgescout_picture_save_png(const edgescout_picture* picture, const char* file) {
  return guarded([&] {
    const auto given = shared(picture);
    require(file, "file");
    std::visit([&](const auto& image) { edgescout::save_png(image, file); }, *given);
  });
}
