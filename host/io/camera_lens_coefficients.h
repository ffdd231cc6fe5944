// Internal to host/io: the coefficients that the fields of a camera give its lens model.
#pragma once

#include <string>
#include <vector>

#include "host/io/camera_fields.h"
#include "host/io/camera_lens_model.h"

namespace edgescout {

struct FoundCoefficients {
  std::vector<double> values;  // in the order of OpenCV, or of Kannala-Brandt
  std::string field;           // empty: none are given
};

// Reads lists of coefficients and single ones (k1, p1 ..). Some programs write both forms.
// InputError: the forms differ, a single coefficient that the model does not have, coefficients of
// which it is not sure to which model they belong.
FoundCoefficients read_lens_coefficients(CameraFields& fields, const FoundModel& model);

}  // namespace edgescout
