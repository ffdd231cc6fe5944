// Refines given poses over prepared views: what detection does with its candidates.
//
// Public header.
#pragma once

#include <span>

#include "host/pipeline.h"
#include "host/register/refine.h"

namespace edgescout {

struct RegisterObjectsOptions {
  TensorOptions tensor;
  RefineOptions refine;
  TimeLimit limit;
  void validate() const;
};

// What a registration of images takes: options of their edges, too.
struct RegistrationOptions {
  EdgesOptions edges;
  RegisterObjectsOptions work;
};
// Names every option of it to `visit`: the one list for bindings.
void describe(RegistrationOptions& options, OptionVisitor& visit);

// Detection::convergence of a start that no image shows.
inline constexpr const char* OUT_OF_SIGHT = "out of sight";

// Refines the starts and returns a detection for each, in their order. They are in the world of the
// views (with one view, its camera frame may be the world). InputError: an image too large for the
// device. A start that no image shows could be registered to any edge: it gets probability 0 and
// OUT_OF_SIGHT. LogicError: no view, a start whose pose is not finite, an object without a model.
Detections register_objects(std::span<const ObjectView> prepared, std::span<const EdgeModel> models,
                            std::span<const ObjectPose> starts, Backend& backend,
                            const RegisterObjectsOptions& options);

}  // namespace edgescout
