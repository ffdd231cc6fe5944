// What the bins of the next best view hold beside foreign parts, and what is searched for in them.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "host/core/types.h"
#include "host/model/template_set.h"

namespace edgescout {

// Three of the project's own parts.
const std::vector<Object>& bin_types();
// Three parts that others drew, of `data`/cad, each with its origin in the middle of its box:
// AX-01, a bearing box of the paper; a flange; a plug adapter, which a half turn maps onto itself.
// InputError naming the file.
std::vector<Object> cad_bin_types(const std::filesystem::path& data);

// One set a type.
std::vector<TemplateSet> templates_between(std::span<const Object> types, double distance_min_m,
                                           double distance_max_m, Backend& backend);
// At any distance from the views.
std::vector<TemplateSet> bin_templates(std::span<const Object> types, Backend& backend);

}  // namespace edgescout
