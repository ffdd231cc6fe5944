// Reads and writes shard.json: what a shard is a part of, and which images it has.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/cli/batch_settings.h"
#include "host/cli/inputs.h"
#include "host/cli/shard.h"
#include "host/io/results.h"

namespace edgescout {

// All that shards of one batch have in common.
struct WholeBatch {
  std::string version;  // of the program
  std::string verb;
  bool by_scene = false;  // the views of a scene are worked on together
  int images = 0;
  std::string images_checksum;  // of their names, places, numbers, cameras and order
  Settings settings;            // of all images
};

struct ShardImage {
  InputImage image;             // without cameras; its file as it was given
  std::filesystem::path place;  // place_of(image) where the shard ran: how results name it
  int number = 0;               // among the images of the batch, from 0
};

struct ShardFile {
  Shard shard;
  WholeBatch batch;
  std::vector<ShardImage> images;
};

// Writes FOLDER/shard.json atomically.
void save_shard(const ShardFile& file, const std::filesystem::path& folder);
// InputError naming file and field: it is missing, damaged or of another version.
ShardFile load_shard(const std::filesystem::path& folder);

// InputError naming `file` and the first thing that differs. `as` ends the line.
void require_same_batch(const WholeBatch& found, const WholeBatch& expected,
                        const std::string& file, const std::string& as);

// The part of ShardOfBatch::require_own that needs nothing but the numbers. InputError: the folder
// holds another shard than this, or a shard where this run has all images.
void require_own_folder(const std::filesystem::path& folder, const std::optional<Shard>& shard);

// The shard.json of a run, and the checks that it needs. A run of all images has none.
class ShardOfBatch {
 public:
  // `own` is the shard's part of `images`, in their order. What `batch` says of images and settings
  // is filled in.
  ShardOfBatch(const std::optional<Shard>& shard, WholeBatch batch, const BatchSettings& settings,
               std::span<const InputImage> images, std::span<const InputImage> own);
  // InputError: the folder holds another shard or a shard of another batch, or a shard where this
  // run has all images.
  void require_own(const std::filesystem::path& folder) const;
  // Writes FOLDER/shard.json, in a folder that is made if needed. Nothing in a run of all images.
  void save(const std::filesystem::path& folder) const;

 private:
  std::optional<ShardFile> file_;
};

}  // namespace edgescout
