#include "host/io/from_mat.h"
#include "host/io/grey_levels.h"
#include "host/io/image.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

template <typename Value>
Image grey_image_of(std::span<const Value> values, int width, int height,
                    const ImageOptions& options) {
  options.validate();
  if (width < 1 || height < 1 || values.size() != std::size_t(width) * std::size_t(height))
    throw InputError("image", "values", std::to_string(values.size()),
                     std::to_string(width) + "x" + std::to_string(height));
  const cv::Mat grey(height, width, cv::traits::Type<Value>::value,
                     const_cast<Value*>(values.data()));
  return from_mat(to_8_bit(grey, options, "image"));
}

}  // namespace

Image grey_image(std::span<const std::uint16_t> values, int width, int height,
                 const ImageOptions& options) {
  return grey_image_of(values, width, height, options);
}

Image grey_image(std::span<const float> values, int width, int height,
                 const ImageOptions& options) {
  return grey_image_of(values, width, height, options);
}

}  // namespace edgescout
