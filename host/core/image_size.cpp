#include "host/core/image_size.h"

#include "kernels/error.h"

namespace edgescout {

namespace {

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

// `image`: grey or depth, with its number of pixels.
void require(const auto& image, std::size_t pixels, const Camera& camera, const std::string& source,
             const std::string& name) {
  const std::string size = size_text(image.width, image.height);
  if (image.width != camera.width || image.height != camera.height)
    throw InputError(source, name + " size", size,
                     "the camera's " + size_text(camera.width, camera.height));
  if (pixels != std::size_t(image.width) * std::size_t(image.height))
    throw InputError(source, name, std::to_string(pixels) + " pixels", size);
}

}  // namespace

void require_size_of(const Camera& camera, const Image& image, const std::string& source,
                     const std::string& name) {
  require(image, image.pixels.size(), camera, source, name);
}

void require_size_of(const Camera& camera, const DepthImage& depth, const std::string& source,
                     const std::string& name) {
  require(depth, depth.z_m.size(), camera, source, name);
}

}  // namespace edgescout
