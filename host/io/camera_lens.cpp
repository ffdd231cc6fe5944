#include "host/io/camera_lens.h"

#include <algorithm>

#include "host/core/lens.h"
#include "host/io/camera_lens_coefficients.h"
#include "host/io/camera_lens_model.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

// The counts that a model may have; more only where they are zero.
std::vector<std::size_t> counts_of(LensModel lens) {
  switch (lens) {
    case LensModel::BrownConrady:
      return {0, 4, 5, 8, 12, 14};
    case LensModel::ModifiedBrownConrady:
      return {0, 4, 5};
    case LensModel::Fisheye:
      return {4, 12};
    case LensModel::ThinPrismFisheye:
      return {8};
    case LensModel::FieldOfView:
      return {1};
  }
  throw LogicError("counts_of: no such lens model");
}

LensModel model_of(LensWord word) {
  switch (word) {
    case LensWord::Modified:
      return LensModel::ModifiedBrownConrady;
    case LensWord::Fisheye:
      return LensModel::Fisheye;
    case LensWord::FieldOfView:
      return LensModel::FieldOfView;
    default:
      return LensModel::BrownConrady;
  }
}

}  // namespace

void set_lens(Camera& camera, LensModel lens, const std::vector<double>& coefficients,
              const std::string& source, const std::string& field) {
  std::vector<double> kept = coefficients;
  const std::vector<std::size_t> counts = counts_of(lens);
  const auto fits = [&] { return std::ranges::find(counts, kept.size()) != counts.end(); };
  while (!fits() && kept.size() > counts.front() && kept.back() == 0) kept.pop_back();
  std::string expected;
  for (std::size_t count : counts)
    expected += (expected.empty() ? "" : ", ") + std::to_string(count);
  if (!fits())
    throw InputError(source, field, std::to_string(coefficients.size()) + " coefficients",
                     expected + " of the lens model " + to_string(lens) + " (more only where 0)");
  camera.lens = lens;
  camera.distortion.fill(0);
  std::ranges::copy(kept, camera.distortion.begin());
}

void read_lens(CameraFields& fields, Camera& camera) {
  const FoundModel model = read_lens_model(fields);
  if (model.word == LensWord::Pinhole) warn_of_lens_in_titles(fields);
  const LensModel lens = model_of(model.word);
  const FoundCoefficients found = read_lens_coefficients(fields, model);
  const bool is_named = model.word != LensWord::Ideal && model.word != LensWord::Pinhole;
  if (is_named && found.field.empty())
    throw InputError(fields.source(), fields.at("distortion_coefficients"), "nothing",
                     "the coefficients of the model in " + model.field);
  const bool bends = std::ranges::any_of(found.values, [](double k) { return k != 0; });
  if (model.word == LensWord::Ideal && bends)
    throw InputError(fields.source(), found.field, "coefficients that are not 0",
                     "none, as " + model.field + " says");
  // RealSense's models have five coefficients, of which one or four count.
  set_lens(camera, bends || lens == LensModel::Fisheye ? lens : LensModel::BrownConrady,
           found.values, fields.source(), found.field);
}

}  // namespace edgescout
