// Describes what the result of an image depends on apart from the image: models, options, cameras.
//
// These settings are written with every result. A resumed batch compares them, to recognise results
// of another run.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/cli/inputs.h"
#include "host/io/results.h"
#include "host/model/template_set.h"

namespace edgescout {

// The device is not among them: a batch may be resumed on another device.
struct BatchSettings {
  Settings common;               // of all images
  std::optional<Camera> camera;  // of all images; absent: each image has its own

  // `views`: jointly(...), or "alone".
  Settings of(const InputImage& input, const std::string& views) const;
  // Describes the images of one joint detection. All must have a world pose.
  std::string jointly(const std::vector<const InputImage*>& views) const;
};

Settings settings_of(std::span<const TemplateSet> sets);
std::pair<std::string, std::string> setting_of(int object_id, const EdgeModel& model);

// Returns a checksum in place of a value that is too long to be written.
std::string checksum_text(std::string_view bytes);

// InputError naming `file` and the first setting that differs or is missing on one side. `as` ends
// the line: what the settings are compared with.
void require_same(const Settings& found, const Settings& expected, const std::string& file,
                  const std::string& as = " as in this run (or no --resume, or another --out)");

}  // namespace edgescout
