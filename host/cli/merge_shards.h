// Joins the results of a batch's shards.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "host/cli/batch_results.h"

namespace edgescout {

struct MergedBatch {
  BatchSummary summary;
  BatchTables tables{false};
  std::string device;  // of all results, with commas between
};

// Reads the folders of shards, in any order. The images are in the order of the batch. What is
// missing is listed in the summary: shards that are not given, and images of the others that have
// neither result nor failure. Nothing is written.
// InputError: a folder holds no shard; two hold the same one; a shard is of another batch, with the
// first difference.
MergedBatch merge_shards(const std::vector<std::filesystem::path>& folders,
                         const std::filesystem::path& out);

}  // namespace edgescout
