// The options of a call, as text by their names.
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "host/active/scout_options.h"
#include "host/bindings/c/src/status.h"
#include "host/core/option_text.h"
#include "host/io/depth_options.h"
#include "host/io/image_options.h"
#include "host/model/template_set.h"
#include "host/register_objects.h"
#include "host/track/track_options.h"

namespace edgescout::c {

// In the order of EDGESCOUT_IMAGE_OPTIONS and the others.
using OptionValues = std::variant<ImageOptions, TemplateOptions, PipelineOptions,
                                  RegistrationOptions, ScoutOptions, TrackOptions, DepthOptions>;

class OptionSet {
 public:
  // EDGESCOUT_BAD_INPUT: no such kind.
  explicit OptionSet(std::int32_t kind);
  OptionSet(const OptionSet& other);
  OptionSet& operator=(const OptionSet&) = delete;

  const OptionValues& values() const { return values_; }
  const char* kind() const;
  std::size_t size() const { return options_.size(); }
  void set(const std::string& name, const std::string& value);
  std::size_t index_of(const std::string& name) const;
  edgescout_option shown(std::size_t index) const;

 private:
  // Texts that callers hold.
  struct Shown {
    std::string default_value, value;
    std::vector<const char*> words;
  };
  void list();

  OptionValues values_;
  mutable std::vector<OptionText> options_;  // refer into the values
  std::vector<Shown> shown_;
};

// A copy of the values; the defaults where `options` is NULL. EDGESCOUT_WRONG_KIND: of another
// kind.
template <typename Options>
Options options_of(const edgescout_options* options);

}  // namespace edgescout::c
