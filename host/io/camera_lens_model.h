// Internal to host/io: which lens model the fields of a camera name.
#pragma once

#include <string>

#include "host/io/camera_fields.h"

namespace edgescout {

// What a word for a model says. Pinhole says how rays are projected, nothing of distortion.
enum class LensWord { Ideal, Pinhole, Brown, Modified, Fisheye, FieldOfView };

struct FoundModel {
  LensWord word = LensWord::Pinhole;
  std::string field;  // that names it; empty: none does
};

// Reads the fields that name a model, by a word, a number or a switch. Without one, the name of an
// object around the coefficients may say it. InputError: a model that is unknown, or two of them.
FoundModel read_lens_model(CameraFields& fields);

// Warns of a title that names a fisheye lens ("camera_name: fisheye_left"): it decides nothing.
void warn_of_lens_in_titles(const CameraFields& fields);

}  // namespace edgescout
