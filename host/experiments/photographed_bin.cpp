#include "host/experiments/photographed_bin.h"

#include <numbers>

#include "host/experiments/bin_types.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

class PhotographedCell : public BinCell {
 public:
  explicit PhotographedCell(const KnownScene& scene)
      : images_(scene.images), visible_(scene.instances.size(), 1) {}
  Camera camera() const override { return images_[0].camera; }
  std::vector<Se3> views() const override {
    std::vector<Se3> views;
    for (const KnownImage& image : images_) views.push_back(image.camera_from_world);
    return views;
  }
  Shot acquire(int view) override {
    const KnownImage& image = images_[static_cast<std::size_t>(view)];
    return {image.image, image.camera_from_world};
  }
  const std::vector<double>& visible(int) override { return visible_; }

 private:
  std::vector<KnownImage> images_;
  std::vector<double> visible_;
};

void require_one_camera(const KnownScene& scene) {
  for (const KnownImage& image : scene.images)
    if (!same_camera(image.camera, scene.images[0].camera))
      throw InputError(scene.set + "/" + scene.name, "cameras", "several",
                       "one that takes every image");
}

}  // namespace

Bin photographed_bin(const KnownScene& scene, int first_view) {
  require_one_camera(scene);
  Bin bin;
  bin.number = bin.first_view = first_view;
  bin.parts = static_cast<int>(scene.instances.size());
  bin.cell = std::make_unique<PhotographedCell>(scene);
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const KnownInstance& instance = scene.instances[i];
    bin.instances.push_back({instance.object, instance.world_from_object, 1, 1, i});
  }
  return bin;
}

std::vector<TemplateSet> pile_templates(const KnownScene& scene, Backend& backend) {
  double sum_m = 0;
  for (const KnownImage& image : scene.images)
    for (const KnownInstance& instance : scene.instances)
      sum_m += (image.camera_from_world * instance.world_from_object).translation_m.norm();
  const double mean_m = sum_m / static_cast<double>(scene.images.size() * scene.instances.size());
  return templates_between(scene.objects, mean_m / std::numbers::sqrt2,
                           mean_m * std::numbers::sqrt2, backend);
}

}  // namespace edgescout
