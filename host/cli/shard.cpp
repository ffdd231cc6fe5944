#include "host/cli/shard.h"

#include <algorithm>
#include <charconv>
#include <numeric>

#include "host/cli/batch_results.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

constexpr int MOST_SHARDS = 1'000'000;

// Nothing: the text is no whole number of digits alone.
std::optional<int> whole_number(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = error == std::errc() && end == text.data() + text.size();
  return is_number ? std::optional(value) : std::nullopt;
}

}  // namespace

std::string text_of(const Shard& shard) {
  return std::to_string(shard.index) + "/" + std::to_string(shard.count);
}

Shard shard_from(const std::string& text) {
  const std::size_t slash = text.find('/');
  const std::optional<int> index = whole_number(std::string_view(text).substr(0, slash));
  const std::optional<int> count =
      slash == text.npos ? std::nullopt : whole_number(std::string_view(text).substr(slash + 1));
  if (!index || !count || *index < 1 || *index > *count || *count > MOST_SHARDS)
    throw InputError("command line", "--shard", text,
                     "I/N with I from 1 to N and N up to " + std::to_string(MOST_SHARDS));
  return {*index, *count};
}

void add_shard(CLI::App& verb, std::optional<Shard>& shard) {
  verb.add_option_function<std::string>(
          "--shard", [&shard](const std::string& text) { shard = shard_from(text); },
          "Work on part I of N of the images. Views that are worked on together stay in one part. "
          "`edgescout merge` joins the parts")
      ->type_name("I/N")
      ->group("Batch");
}

std::vector<bool> in_shard(std::span<const std::span<const InputImage>> groups,
                           const Shard& shard) {
  std::vector<std::string> places;
  for (const std::span<const InputImage>& group : groups)
    places.push_back(place_of(group.front()).string());
  std::vector<std::size_t> sorted(groups.size());
  std::iota(sorted.begin(), sorted.end(), std::size_t{0});
  std::ranges::stable_sort(sorted, {}, [&](std::size_t group) { return places[group]; });
  std::vector<bool> belongs(groups.size(), false);
  for (auto rank = static_cast<std::size_t>(shard.index - 1); rank < sorted.size();
       rank += static_cast<std::size_t>(shard.count))
    belongs[sorted[rank]] = true;
  return belongs;
}

std::vector<InputImage> images_of_shard(std::span<const InputImage> images, bool by_scene,
                                        const std::optional<Shard>& shard) {
  if (!shard) return {images.begin(), images.end()};
  const std::vector<std::span<const InputImage>> groups = groups_of(images, by_scene);
  const std::vector<bool> belongs = in_shard(groups, *shard);
  std::vector<InputImage> chosen;
  for (std::size_t g = 0; g < groups.size(); ++g)
    if (belongs[g]) chosen.insert(chosen.end(), groups[g].begin(), groups[g].end());
  return chosen;
}

}  // namespace edgescout
