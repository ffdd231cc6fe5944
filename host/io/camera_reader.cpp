#include "host/io/camera_reader.h"

#include "host/io/camera_lens.h"

namespace edgescout {

namespace {

// MATLAB counts pixels from 1. Its fields are spelt in this way.
bool is_from_matlab(const CameraFields& fields) {
  return fields.has_spelt("IntrinsicMatrix") || fields.has_spelt("RadialDistortion") ||
         (fields.has_spelt("FocalLength") && fields.has_spelt("PrincipalPoint"));
}

}  // namespace

Camera read_camera(CameraFields& fields) {
  Camera camera;
  if (!read_model_with_parameters(fields, camera)) {
    read_lens(fields, camera);  // first: another model has other intrinsics
    read_intrinsics(fields, camera);
    if (is_from_matlab(fields)) --camera.cx, --camera.cy;
    read_size(fields, camera);
  }
  read_roi_and_binning(fields, camera);
  fields.require_all_understood();
  return camera;
}

}  // namespace edgescout
