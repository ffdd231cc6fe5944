// Internal to host/io: makes cameras from the fields of a file.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/core/camera.h"
#include "host/io/camera_fields.h"

namespace edgescout {

struct NamedCamera {
  std::string name;  // in the file; empty: the file's only camera
  Camera camera;
};

// Reads a camera with pixel centres at integers, of the image that the file's ROI and binning
// leave. Its size is 0 x 0 where the file has none. InputError naming the field.
Camera read_camera(CameraFields& fields);

// The steps of it.
void read_size(CameraFields& fields, Camera& camera);
void read_intrinsics(CameraFields& fields, Camera& camera);
void read_roi_and_binning(CameraFields& fields, Camera& camera);

// The cameras of OpenSfM, AliceVision (Meshroom) and Project Aria in the fields and units of other
// files. Other trees come back unchanged. InputError: a lens model that is not read.
nlohmann::json with_common_fields(nlohmann::json tree, const std::string& source);
// The program that wrote a text which no reader understands. Empty: it is not known.
std::optional<std::string> program_that_is_not_read(const std::string& text);

// A model's name with one list of all its parameters: COLMAP's, BOP's cam_model. False: the fields
// are of another form.
bool read_model_with_parameters(CameraFields& fields, Camera& camera);

// Cameras as fields side by side (M1, D1, M2, D2; color_intrinsics ..), as an object with one
// object for each side. Null: the fields are of another form.
nlohmann::json split_stereo_pair(const nlohmann::json& fields);

// Azure Kinect's calibration in units of the image: one camera for each mode of the sensor. Empty:
// the fields are of another form.
std::vector<NamedCamera> read_azure_kinect(CameraFields& fields);

}  // namespace edgescout
