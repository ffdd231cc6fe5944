#include "host/active/scout_options.h"
#include "host/bindings/python/src/option_fields.h"
#include "host/bindings/python/src/parts.h"
#include "host/io/depth_options.h"
#include "host/io/image_options.h"
#include "host/model/template_set.h"
#include "host/register_objects.h"
#include "host/track/track_options.h"

namespace edgescout::python {

void add_options(py::module_& module) {
  add_options_class<ImageOptions>(
      module, "ImageOptions",
      "How stored values become 8-bit grey. Names are those of the command line with underscores; "
      "help() explains them.",
      [](ImageOptions& options, OptionVisitor& visit) { describe(options, visit); });
  add_options_class<DepthOptions>(
      module, "DepthOptions",
      "How stored values become depth, and the sensor's noise. Names are those of the command line "
      "with underscores; help() explains them.",
      [](DepthOptions& options, OptionVisitor& visit) { describe(options, visit); });
  add_options_class<TemplateOptions>(
      module, "TemplateOptions",
      "Viewpoints and distances of an object's templates. Names are those of the command line with "
      "underscores; help() explains them.",
      [](TemplateOptions& options, OptionVisitor& visit) { describe(options, visit); });
  add_options_class<PipelineOptions>(
      module, "DetectOptions",
      "Options of detection. Names are those of the command line with underscores; help() explains "
      "them.",
      [](PipelineOptions& options, OptionVisitor& visit) { describe(options, visit); });
  add_options_class<RegistrationOptions>(
      module, "RegisterOptions",
      "Options of registration. Names are those of the command line with underscores; help() "
      "explains them.",
      [](RegistrationOptions& options, OptionVisitor& visit) { describe(options, visit); });
  add_options_class<ScoutOptions>(
      module, "ScoutOptions",
      "Options of the scout. Names are those of the command line with underscores; help() explains "
      "them.",
      [](ScoutOptions& options, OptionVisitor& visit) { describe_scout(options, visit); });
  add_options_class<TrackOptions>(
      module, "TrackOptions",
      "Options of the tracker. Names are those of the command line with underscores; help() "
      "explains them.",
      [](TrackOptions& options, OptionVisitor& visit) { describe_track(options, visit); });
}

}  // namespace edgescout::python
