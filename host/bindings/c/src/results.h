// What calls found, with the identity of the objects.
#pragma once

#include "host/bindings/c/src/contents.h"

namespace edgescout::c {

FoundObject named(Detection detection, std::span<const TemplateSet> sets);
FoundObjects named(Detections detections, std::span<const TemplateSet> sets);

}  // namespace edgescout::c
