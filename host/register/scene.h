// What every step of registration and detection works on: models, views, a backend, and until when.
//
// Public header.
#pragma once

#include <algorithm>
#include <span>

#include "host/core/time_limit.h"
#include "host/model/edge_model.h"
#include "host/register/object_view.h"
#include "kernels/backend.h"

namespace edgescout {

// Refers to data of the caller. ObjectPose::object indexes `models`; the views are calibrated
// images of one static scene in one world frame.
struct Scene {
  std::span<const EdgeModel> models;
  std::span<const ObjectView> views;
  Backend& backend;
  // Where it is over, registration makes no further iteration and searches around no start.
  const TimeLimit* limit = nullptr;  // null: none
  bool is_time_over() const { return limit && limit->is_over(); }
  // Whether a view has the values of a depth image on the backend (add_tensors).
  bool has_depth() const {
    return std::ranges::any_of(views,
                               [](const ObjectView& v) { return v.depth_values != nullptr; });
  }
};

}  // namespace edgescout
