// The models, views and backend that every step of registration and detection works on.
//
// Public header.
#pragma once

#include <span>

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
};

}  // namespace edgescout
