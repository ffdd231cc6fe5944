// What is given to detection and what it finds, with the names of the objects.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "host/bindings/python/src/arrays.h"
#include "host/core/depth_image.h"
#include "host/io/depth_options.h"
#include "host/pipeline.h"
#include "host/register/measured_depth.h"

namespace edgescout::python {

// One Templates, which is shared and not copied, or a sequence of them.
class GivenSets {
 public:
  explicit GivenSets(const py::object& templates);  // ValueError: none
  std::span<const TemplateSet> sets() const {
    return one_ ? std::span<const TemplateSet>(one_.get(), 1) : several_;
  }

 private:
  std::shared_ptr<const TemplateSet> one_;
  std::vector<TemplateSet> several_;
};

// Depth that comes with a call: None, or an array; of several images a sequence of both.
struct GivenDepth {
  const py::object& values;
  const DepthOptions* options = nullptr;  // null: the defaults
};

// What an image shows, and where it was taken.
struct TakenImage {
  Image image;
  Camera camera;
  Se3 camera_from_world;
  std::optional<DepthImage> depth;  // of the same camera
  DepthNoise depth_noise;
};

// A camera without a size takes the image's. ValueError: they differ, or image_of refuses it.
TakenImage taken_image(const py::handle& image, const Camera& camera, const Se3& camera_from_world);

// ValueError: values that are no depth image, another size than the image's.
void give_depth(TakenImage& taken, const GivenDepth& depth);
// ValueError, beside that: not one depth an image.
void give_depth(std::span<TakenImage> taken, const GivenDepth& depth);

// Its depth without the lens; null where it has none.
std::shared_ptr<const MeasuredDepth> measured_depth(const TakenImage& taken);

// Of a sequence of images. One camera took all of them, or each of a sequence took one. ValueError:
// not one pose an image, not one camera or one an image.
std::vector<TakenImage> taken_images(const py::object& images, const py::object& camera,
                                     const py::object& camera_from_world);

// A detection with the identity of its object.
struct FoundObject : Detection {
  int object_id = 1;
  std::string name;
};

struct FoundObjects {
  std::vector<FoundObject> found;
  Completion completion = Completion::Complete;
  std::vector<StageSeconds> stages;
};

FoundObjects named(Detections&& detections, std::span<const TemplateSet> sets);

void add_found_objects(py::module_& module);

}  // namespace edgescout::python
