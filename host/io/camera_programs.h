// Internal to host/io: cameras of programs whose files have units of their own, as the fields and
// units of other files.
#pragma once

#include "host/io/camera_fields.h"

namespace edgescout {

// The number of this field. InputError: there is none.
inline double number_at(const JsonField& object, const std::string& name) {
  return number_in_field(object.at(name));
}

// OpenSfM: a camera, several by name, or reconstructions, whose poses and points are left out.
bool is_of_opensfm(const nlohmann::json& tree);
nlohmann::json opensfm_cameras(const JsonField& tree);

// AliceVision (Meshroom).
bool is_of_alicevision(const nlohmann::json& tree);
nlohmann::json alicevision_cameras(const JsonField& root);

// Project Aria: the factory calibration of a recording.
bool is_of_aria(const nlohmann::json& tree);
nlohmann::json aria_cameras(const JsonField& root);

}  // namespace edgescout
