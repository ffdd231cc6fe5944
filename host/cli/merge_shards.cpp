#include "host/cli/merge_shards.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "host/cli/shard_file.h"
#include "host/io/folder_lock.h"
#include "host/io/json_fields.h"
#include "host/io/json_text.h"
#include "kernels/error.h"

namespace edgescout {

namespace fs = std::filesystem;

namespace {

// A shard's folder, and what its summary.json says.
struct ReadShard {
  fs::path folder;
  ShardFile file;
  std::map<std::string, std::string> failures;  // message by file
  std::vector<TemplateOrigin> templates;
  std::string why_unfinished;  // of images that have neither result nor failure
};

void read_summary(ReadShard& shard) {
  const fs::path path = shard.folder / "summary.json";
  std::error_code unknown;
  if (!fs::exists(path, unknown)) {
    shard.why_unfinished = "the shard has not ended";
    return;
  }
  const nlohmann::json summary = read_json(path);
  const JsonField fields{summary, path.string(), ""};
  for (const JsonField& failure : fields.at("failures").elements())
    shard.failures[failure.at("file").text()] = failure.at("error").text();
  if (fields.has("templates"))
    for (const JsonField& origin : fields.at("templates").elements())
      shard.templates.push_back({origin.at("object_id").integer(), origin.at("source").text(),
                                 origin.at("seconds").number()});
  shard.why_unfinished = fields.has("error") ? fields.at("error").text() : "no result";
}

ReadShard read_shard(const fs::path& folder) {
  ReadShard shard{folder, load_shard(folder), {}, {}, ""};
  read_summary(shard);
  if (const std::optional<std::string> holder = holder_of(folder))
    shard.why_unfinished = "the shard is being worked on by " + *holder;
  return shard;
}

// Sorted by their numbers.
std::vector<ReadShard> read_shards(const std::vector<fs::path>& folders) {
  std::map<int, ReadShard> shards;
  for (const fs::path& folder : folders) {
    ReadShard shard = read_shard(folder);
    const std::string file = (folder / "shard.json").string();
    if (!shards.empty()) {
      const ReadShard& first = shards.begin()->second;
      const std::string as = " as in " + first.folder.string();
      if (shard.file.shard.count != first.file.shard.count)
        throw InputError(file, "shards", std::to_string(shard.file.shard.count),
                         std::to_string(first.file.shard.count) + as);
      require_same_batch(shard.file.batch, first.file.batch, file, as);
    }
    const int index = shard.file.shard.index;
    if (const auto other = shards.find(index); other != shards.end())
      throw InputError(file, "shard", text_of(shard.file.shard) + " a second time",
                       "every shard once (it is in " + other->second.folder.string() + ")");
    shards.emplace(index, std::move(shard));
  }
  std::vector<ReadShard> sorted;
  for (auto& [index, shard] : shards) sorted.push_back(std::move(shard));
  return sorted;
}

// The result of an image. Nothing: there is none, or none of this image.
std::optional<ImageResult> result_in(const fs::path& folder, const ShardImage& listed) {
  const InputImage& input = listed.image;
  std::error_code unknown;
  if (!fs::exists(json_of(folder, input), unknown)) return {};
  try {
    ImageResult result = load_image_result(json_of(folder, input));
    const bool is_own = result.image == listed.place && result.scene_id == input.scene_id &&
                        result.image_id == input.image_id;
    return is_own ? std::optional(std::move(result)) : std::nullopt;
  } catch (const InputError&) {
    return {};  // damaged: --resume makes it anew
  }
}

class Merger {
 public:
  Merger(const std::vector<ReadShard>& shards, const fs::path& out) : shards_(shards), out_(out) {
    const WholeBatch& batch = shards.front().file.batch;
    merged_.tables = BatchTables(batch.by_scene);
    merged_.summary.verb = batch.verb;
    merged_.summary.by_scene = batch.by_scene;
    merged_.summary.images = batch.images;
  }

  MergedBatch merge() {
    for (const auto& [shard, image] : in_order()) add(*shard, *image);
    list_missing_shards();
    BatchSummary& summary = merged_.summary;
    summary.done = merged_.tables.done;
    for (const StageSeconds& stage : merged_.tables.stages) {
      summary.stage_seconds[stage.name] += stage.seconds;
      summary.seconds += stage.seconds;
    }
    add_templates();
    merged_.device = fmt::format("{}", fmt::join(merged_.tables.devices, ", "));
    return std::move(merged_);
  }

 private:
  using Member = std::pair<const ReadShard*, const ShardImage*>;

  std::vector<Member> in_order() const {
    std::vector<Member> members;
    for (const ReadShard& shard : shards_)
      for (const ShardImage& image : shard.file.images) members.emplace_back(&shard, &image);
    std::ranges::sort(members, {}, [](const Member& member) { return member.second->number; });
    return members;
  }

  void add(const ReadShard& shard, const ShardImage& listed) {
    const InputImage& input = listed.image;
    const std::string file = input.file.string();
    if (const std::optional<ImageResult> result = result_in(shard.folder, listed)) {
      merged_.tables.add(input, *result, fs::relative(shard.folder, out_));
    } else if (const auto failure = shard.failures.find(file); failure != shard.failures.end()) {
      merged_.summary.failures[file] = failure->second;
      merged_.tables.add_failed(input, failure->second);
    } else {
      const std::string reason = shard.folder.string() + ": " + shard.why_unfinished;
      merged_.summary.missing.push_back({"image " + file, 1, reason});
      merged_.tables.add_missing(input, reason);
    }
  }

  // The images of shards that are not given are not known, only their number.
  void list_missing_shards() {
    const int count = shards_.front().file.shard.count;
    std::string missing;
    int images = merged_.summary.images;
    auto given = shards_.begin();
    for (int index = 1; index <= count; ++index) {
      if (given != shards_.end() && given->file.shard.index == index)
        images -= static_cast<int>((given++)->file.images.size());
      else
        missing += (missing.empty() ? "" : ", ") + text_of(Shard{index, count});
    }
    if (!missing.empty())
      merged_.summary.missing.push_back({"shards " + missing, images, "no folder given"});
  }

  // Shards may have their templates from different places.
  void add_templates() {
    std::map<int, std::set<std::string>> sources;
    for (const ReadShard& shard : shards_)
      for (const TemplateOrigin& origin : shard.templates) {
        auto& all = merged_.summary.templates;
        auto known = std::ranges::find(all, origin.object_id, &TemplateOrigin::object_id);
        if (known == all.end()) known = all.insert(known, {origin.object_id, "", 0});
        std::set<std::string>& of_object = sources[origin.object_id];
        of_object.insert(origin.source);
        known->source = fmt::format("{}", fmt::join(of_object, ", "));
        known->seconds += origin.seconds;
      }
  }

  const std::vector<ReadShard>& shards_;
  const fs::path& out_;
  MergedBatch merged_;
};

}  // namespace

MergedBatch merge_shards(const std::vector<fs::path>& folders, const fs::path& out) {
  const std::vector<ReadShard> shards = read_shards(folders);
  return Merger(shards, out).merge();
}

}  // namespace edgescout
