#include "host/cli/shard_file.h"

#include <fmt/format.h>

#include "host/cli/batch_results.h"
#include "host/cli/batch_settings.h"
#include "host/io/binary_file.h"
#include "host/io/files.h"
#include "host/io/json_fields.h"
#include "host/io/json_text.h"
#include "kernels/error.h"

namespace edgescout {

namespace fs = std::filesystem;

namespace {

constexpr int SHARD_FILE_VERSION = 1;

fs::path shard_file(const fs::path& folder) { return folder / "shard.json"; }

std::string checksum_of(std::span<const InputImage> images) {
  BinaryWriter out;
  const BatchSettings none;
  for (const InputImage& image : images) {
    out.put_text(image.name);
    out.put_text(place_of(image).string());
    out.put(image.scene_id);
    out.put(image.image_id);
    for (const auto& [name, value] : none.of(image, "")) out.put_text(value);  // cameras
  }
  return checksum_text(out.bytes);
}

std::string images_text(const WholeBatch& batch) {
  return fmt::format("{}, {}", batch.images, batch.images_checksum);
}

InputImage image_from(const JsonField& fields) {
  InputImage image;
  image.name = fields.at("name").text();
  image.file = fields.at("file").text();
  image.scene_id = fields.at("scene_id").integer();
  image.image_id = fields.at("image_id").integer();
  return image;
}

}  // namespace

void save_shard(const ShardFile& file, const fs::path& folder) {
  nlohmann::ordered_json content{{"edgescout_shard", SHARD_FILE_VERSION},
                                 {"version", file.batch.version},
                                 {"verb", file.batch.verb},
                                 {"shard", file.shard.index},
                                 {"shards", file.shard.count},
                                 {"by_scene", file.batch.by_scene},
                                 {"batch_images", file.batch.images},
                                 {"batch_checksum", file.batch.images_checksum}};
  content["settings"] = nlohmann::ordered_json::object();
  for (const auto& [name, value] : file.batch.settings) content["settings"][name] = value;
  content["images"] = nlohmann::ordered_json::array();
  for (const auto& [image, place, number] : file.images)
    content["images"].push_back({{"number", number},
                                 {"name", image.name},
                                 {"file", image.file.string()},
                                 {"image", place.string()},
                                 {"scene_id", image.scene_id},
                                 {"image_id", image.image_id}});
  write_file_atomically(shard_file(folder), json_text(content));
}

ShardFile load_shard(const fs::path& folder) {
  const fs::path path = shard_file(folder);
  const nlohmann::json content = read_json(path);
  const JsonField fields{content, path.string(), ""};
  if (const int version = fields.at("edgescout_shard").integer(); version != SHARD_FILE_VERSION)
    fields.at("edgescout_shard").fail(std::to_string(version), std::to_string(SHARD_FILE_VERSION));
  ShardFile file;
  file.shard = {fields.at("shard").integer(), fields.at("shards").integer()};
  if (file.shard.index < 1 || file.shard.index > file.shard.count)
    fields.at("shard").fail(text_of(file.shard), "I/N with I from 1 to N");
  const JsonField by_scene = fields.at("by_scene");
  if (!by_scene.value.is_boolean()) by_scene.fail(by_scene.value.dump(), "true or false");
  file.batch = {fields.at("version").text(),        fields.at("verb").text(),
                by_scene.value.get<bool>(),         fields.at("batch_images").integer(),
                fields.at("batch_checksum").text(), {}};
  const JsonField settings = fields.at("settings");
  for (const auto& item : settings.value.items())
    file.batch.settings.emplace_back(item.key(), settings.at(item.key()).text());
  for (const JsonField& image : fields.at("images").elements())
    file.images.push_back(
        {image_from(image), image.at("image").text(), image.at("number").integer()});
  return file;
}

void require_same_batch(const WholeBatch& found, const WholeBatch& expected,
                        const std::string& file, const std::string& as) {
  const auto all = [](const WholeBatch& batch) {
    Settings settings{{"version", batch.version},
                      {"verb", batch.verb},
                      {"images of the batch", images_text(batch)}};
    settings.insert(settings.end(), batch.settings.begin(), batch.settings.end());
    return settings;
  };
  require_same(all(found), all(expected), file, as);
}

ShardOfBatch::ShardOfBatch(const std::optional<Shard>& shard, WholeBatch batch,
                           const BatchSettings& settings, std::span<const InputImage> images,
                           std::span<const InputImage> own) {
  if (!shard) return;
  batch.images = static_cast<int>(images.size());
  batch.images_checksum = checksum_of(images);
  batch.settings = settings.of({}, batch.by_scene ? "jointly" : "alone");
  file_ = ShardFile{*shard, std::move(batch), {}};
  std::size_t number = 0;
  for (const InputImage& image : own) {
    while (images[number].name != image.name) ++number;
    file_->images.push_back({image, place_of(image), static_cast<int>(number)});
  }
}

void require_own_folder(const fs::path& folder, const std::optional<Shard>& shard) {
  std::error_code unknown;
  if (!fs::exists(shard_file(folder), unknown)) return;
  const Shard found = load_shard(folder).shard;
  if (found != shard)
    throw InputError(shard_file(folder).string(), "shard", text_of(found),
                     (shard ? text_of(*shard) + " as in this run" : "no shard of a batch") +
                         " (or another --out)");
}

void ShardOfBatch::require_own(const fs::path& folder) const {
  require_own_folder(folder, file_ ? std::optional(file_->shard) : std::nullopt);
  std::error_code unknown;
  if (file_ && fs::exists(shard_file(folder), unknown))
    require_same_batch(load_shard(folder).batch, file_->batch, shard_file(folder).string(),
                       " as in this run (or another --out)");
}

void ShardOfBatch::save(const fs::path& folder) const {
  if (!file_) return;
  require_writable_folder(folder);
  save_shard(*file_, folder);
}

}  // namespace edgescout
