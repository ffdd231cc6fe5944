// Internal to host/io: reads the lens of a camera: its model and its coefficients.
#pragma once

#include <vector>

#include "host/core/camera.h"
#include "host/io/camera_fields.h"

namespace edgescout {

// Sets lens and coefficients from the fields that name a model, lists of coefficients and single
// coefficients (k1, p1 ..). Without a model, coefficients are OpenCV's. InputError: a model that is
// unknown or contradicts another field, coefficients that the model does not have.
void read_lens(CameraFields& fields, Camera& camera);

// The coefficients of `lens` in the order of OpenCV and Kannala-Brandt. More than the model has are
// accepted where they are zero. InputError naming the field: another number of them.
void set_lens(Camera& camera, LensModel lens, const std::vector<double>& coefficients,
              const std::string& source, const std::string& field);

}  // namespace edgescout
