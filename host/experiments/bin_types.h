// The parts in the bins of the next best view, apart from foreign parts, and their templates.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "host/core/types.h"
#include "host/model/template_set.h"

namespace edgescout {

// Three of the project's own parts.
const std::vector<Object>& bin_types();
// Loads three parts of other authors from `data`/cad and moves their origins to the middle of their
// boxes: AX-01, a bearing box of the paper; a flange; a plug adapter, which a half turn maps onto
// itself. InputError naming the file.
std::vector<Object> cad_bin_types(const std::filesystem::path& data);

// One set per type.
std::vector<TemplateSet> templates_between(std::span<const Object> types, double distance_min_m,
                                           double distance_max_m, Backend& backend);
// For all distances from the views of a bin.
std::vector<TemplateSet> bin_templates(std::span<const Object> types, Backend& backend);

}  // namespace edgescout
