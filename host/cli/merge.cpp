// edgescout merge: joins the results of a batch's shards.
#include <fmt/format.h>

#include <iostream>

#include "host/cli/common_arguments.h"
#include "host/cli/exit_codes.h"
#include "host/cli/merge_shards.h"
#include "host/cli/verbs.h"
#include "host/core/log.h"
#include "host/io/folder_lock.h"
#include "kernels/error.h"

namespace edgescout {

namespace fs = std::filesystem;

namespace {

struct MergeRequest {
  std::vector<fs::path> shards;
  std::string out;
  int thumbnails = TableFiles{}.thumbnails;
};

// The tables of a shard are not to be replaced by those of the whole.
void require_own_folder(const MergeRequest& request) {
  std::error_code not_there;
  for (const fs::path& shard : request.shards)
    if (fs::equivalent(shard, request.out, not_there))
      throw InputError("command line", "--out", "the folder of a shard", "another one");
  require_no_other_results(request.out, {});
}

// The first of them, and how many more there are.
void warn_of_missing(const std::vector<MissingPart>& missing) {
  constexpr std::size_t most = 10;
  for (std::size_t i = 0; i < std::min(most, missing.size()); ++i)
    log(LogLevel::Warning,
        fmt::format("missing: {}: {}{}", missing[i].what, missing[i].reason,
                    missing[i].images == 1 ? "" : fmt::format(", {} images", missing[i].images)));
  if (missing.size() > most)
    log(LogLevel::Warning,
        fmt::format("missing: {} more; summary.json lists them", missing.size() - most));
}

int merge(const MergeRequest& request) {
  require_own_folder(request);
  const FolderLock lock(request.out);
  MergedBatch merged = merge_shards(request.shards, request.out);
  BatchSummary& summary = merged.summary;
  write_tables(merged.tables, summary, merged.device, {request.out, request.thumbnails});
  warn_of_missing(summary.missing);
  int missing = 0;
  for (const MissingPart& part : summary.missing) missing += part.images;
  std::cout << fmt::format(
      "{} images in {} shards: {} done, {} failed, {} missing; {} poses; results in {}\n",
      summary.images, request.shards.size(), summary.done, summary.failures.size(), missing,
      summary.poses, request.out);
  const bool is_whole = summary.missing.empty() && summary.failures.empty();
  return is_whole && summary.out_of_sight == 0 ? exit_done : exit_some_failed;
}

}  // namespace

void add_merge(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand(
      "merge", "Join the results of a batch that ran in parts (--shard) on several machines");
  auto request = std::make_shared<MergeRequest>();
  verb->add_option("shards", request->shards, "Folders of the parts, in any order")
      ->required()
      ->type_name("OUT");
  add_results_folder(*verb, request->out);
  add_thumbnails(*verb, request->thumbnails);
  verb->callback([request, &exit_code] { exit_code = merge(*request); });
}

}  // namespace edgescout
