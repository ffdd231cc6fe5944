#include "host/io/bop_targets.h"

#include "host/io/json_fields.h"

namespace edgescout {

namespace {

// 12, or ["cam1", 12].
BopView read_view(const JsonField& field) {
  if (!field.value.is_array()) return {"", field.integer()};
  const std::vector<JsonField> pair = field.elements();
  if (pair.size() != 2)
    field.fail(std::to_string(pair.size()) + " values", "a camera's name and a number");
  return {pair[0].text(), pair[1].integer()};
}

BopTarget read_target(const JsonField& entry) {
  BopTarget target;
  target.scene_id = entry.at("scene_id").integer();
  const JsonField images = entry.at("im_id");
  target.is_group = images.value.is_array();
  if (!target.is_group) target.views.push_back(read_view(images));
  if (target.is_group)
    for (const JsonField& view : images.elements()) target.views.push_back(read_view(view));
  if (target.views.empty()) images.fail("an empty list", "at least one image");
  if (entry.has("obj_id")) target.object_id = entry.at("obj_id").integer();
  if (!target.object_id || !entry.has("inst_count")) return target;
  target.instances = entry.at("inst_count").integer();
  if (*target.instances < 0) entry.at("inst_count").fail("a negative number", "0 or more");
  return target;
}

}  // namespace

std::vector<BopTarget> load_bop_targets(const std::filesystem::path& file) {
  const nlohmann::json content = read_json(file);
  std::vector<BopTarget> targets;
  for (const JsonField& entry : JsonField{content, file.string(), ""}.elements())
    targets.push_back(read_target(entry));
  return targets;
}

}  // namespace edgescout
