// What the result of an image is made with beside the image itself: models, options, cameras. It is
// written with every result, so that a batch that is taken up again tells its own results from
// those of another run.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/cli/inputs.h"
#include "host/io/results.h"
#include "host/model/template_set.h"

namespace edgescout {

// Not the device: what one left undone another may do.
struct BatchSettings {
  Settings common;               // of all images
  std::optional<Camera> camera;  // of all images; absent: each brings its own

  // `views`: jointly(...), or "alone".
  Settings of(const InputImage& input, const std::string& views) const;
  // Of images that are worked on together; all have a world pose.
  std::string jointly(const std::vector<const InputImage*>& views) const;
};

Settings settings_of(std::span<const TemplateSet> sets);
std::pair<std::string, std::string> setting_of(int object_id, const EdgeModel& model);

// Stands for what is too long to be told.
std::string checksum_text(std::string_view bytes);

// InputError naming `file` and the first setting that differs or that only one side has.
void require_same(const Settings& found, const Settings& expected, const std::string& file);

}  // namespace edgescout
