// Divides a batch into parts that run apart from each other, on several machines.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/cli/inputs.h"

namespace edgescout {

// The part `index` of `count`: 1 to `count`.
struct Shard {
  int index = 1, count = 1;
  friend bool operator==(const Shard&, const Shard&) = default;
};

// "2/8"
std::string text_of(const Shard& shard);

// InputError: the text is not I/N with 1 <= I <= N <= 1,000,000.
Shard shard_from(const std::string& text);

// --shard I/N
void add_shard(CLI::App& verb, std::optional<Shard>& shard);

// Returns for each group of images whether it belongs to the shard. The groups are sorted by the
// places of their first images and dealt out in turn: every group is in one shard, the shards'
// sizes differ by one at most, and the order of the groups does not matter.
std::vector<bool> in_shard(std::span<const std::span<const InputImage>> groups, const Shard& shard);

// The images of the groups that belong to the shard; without one, all.
std::vector<InputImage> images_of_shard(std::span<const InputImage> images, bool by_scene,
                                        const std::optional<Shard>& shard);

}  // namespace edgescout
