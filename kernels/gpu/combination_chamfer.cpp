#include "kernels/gpu/combination_chamfer.h"

#include <algorithm>
#include <bit>

#include "chamfer_masks.spv.h"
#include "chamfer_rows.spv.h"
#include "chamfer_sums.spv.h"
#include "kernels/error.h"

namespace edgescout::gpu {

namespace {

static_assert(sizeof(ChamferMask) == 4 * CHAMFER_MASK_WORDS);
static_assert(sizeof(ChamferRow) == 4 * CHAMFER_ROW_WORDS);
static_assert(sizeof(ChamferRun) == 4 * CHAMFER_RUN_WORDS);
static_assert(sizeof(ChamferVisit) == 4 * CHAMFER_VISIT_WORDS);

constexpr std::size_t max_tile_bytes = std::size_t{64} << 20;

// Of tiles side by side: a card is not filled by one view.
std::size_t max_group_bytes(const Device& device) {
  return device.info().hardware ? 4 * max_tile_bytes : max_tile_bytes;
}

std::size_t mask_bytes(const DevicePlan& plan) { return plan.masks.size() * sizeof(std::uint32_t); }
std::size_t row_bytes(const DevicePlan& plan) { return plan.rows.size() * 32; }

template <class T>
Buffer<T> uploaded_values(Batch& batch, const Device& device, const std::vector<T>& values,
                          const char* name) {
  Buffer<T> buffer(device, values.size(), name);
  batch.upload<T>(buffer, values);
  return buffer;
}

// [candidate][word of 32 combinations]
std::vector<std::uint32_t> columns_of(const CombinationBits& combinations) {
  const std::size_t words = groups_for(combinations.count, 32),
                    row_words = combinations.row_words();
  std::vector<std::uint32_t> columns(words * combinations.candidates, 0);
  for (std::size_t j = 0; j < combinations.count; ++j)
    for (std::size_t w = 0; w < row_words; ++w)
      for (std::uint32_t rest = combinations.words[j * row_words + w]; rest != 0;
           rest &= rest - 1) {
        const std::size_t c = 32 * w + std::size_t(std::countr_zero(rest));
        if (c < combinations.candidates) columns[c * words + j / 32] |= 1u << (j % 32);
      }
  return columns;
}

}  // namespace

DeviceCells::DeviceCells(const Device& device, std::size_t particle_count,
                         std::uint32_t combination_count)
    : particles(static_cast<std::uint32_t>(particle_count)),
      combinations(combination_count),
      sums(device, particle_count * combination_count, "chamfer sums"),
      counts(device, particle_count * combination_count, "chamfer counts") {
  const std::size_t most = device.limits().maxStorageBufferRange;
  if (sums.bytes() > most)
    throw GpuError("combination_chamfer: " + std::to_string(particles) + " particles times " +
                   std::to_string(combinations) + " combinations, " + device.info().name +
                   " binds at most " + std::to_string(most / sizeof(std::uint32_t)) + " cells");
}

CombinationChamfer::CombinationChamfer(const Device& device)
    : device_(device),
      masks_kernel_(device, {"chamfer_masks", chamfer_masks_spv, 4, sizeof(ChamferPush), {}}),
      rows_kernel_(device, {"chamfer_rows", chamfer_rows_spv, 4, sizeof(ChamferPush), {}}),
      sums_kernel_(device, {"chamfer_sums", chamfer_sums_spv, 7, sizeof(ChamferPush), {}}) {}

DevicePlan CombinationChamfer::uploaded(Batch& batch, const ChamferPlan& plan) const {
  return {plan.cap,
          uploaded_values(batch, device_, plan.masks, "chamfer masks"),
          uploaded_values(batch, device_, plan.rows, "chamfer rows"),
          uploaded_values(batch, device_, plan.particles, "particles"),
          uploaded_values(batch, device_, plan.visits, "particles' visits"),
          uploaded_values(batch, device_, plan.hiders, "hiding candidates"),
          uploaded_values(batch, device_, plan.reach, "edges in reach")};
}

std::vector<std::vector<CombinationChamfer::Tile>> CombinationChamfer::side_by_side(
    std::uint32_t words) const {
  const std::size_t most = std::min<std::size_t>(max_tile_bytes, device_.max_band_bytes());
  std::vector<std::vector<Tile>> groups;
  const std::size_t most_of_group = max_group_bytes(device_);
  std::size_t group_bytes = 0;
  for (std::size_t view = 0; view < plans_.size(); ++view) {
    const std::size_t masks = mask_bytes(plans_[view]), rows = row_bytes(plans_[view]),
                      that_fit = most / std::max<std::size_t>({masks, rows, 1});
    const auto of_tile = static_cast<std::uint32_t>(std::clamp<std::size_t>(that_fit, 1, words));
    for (std::uint32_t first = 0; first < words; first += of_tile) {
      const Tile tile{view, first, std::min(of_tile, words - first)};
      const std::size_t bytes = tile.words * (masks + rows);
      if (groups.empty() || group_bytes + bytes > most_of_group) {
        groups.emplace_back();
        group_bytes = 0;
      }
      groups.back().push_back(tile);
      group_bytes += bytes;
    }
  }
  return groups;
}

void CombinationChamfer::reserve(std::span<const std::vector<Tile>> groups) {
  for (const std::vector<Tile>& tiles : groups) {
    if (memory_.size() < tiles.size()) memory_.resize(tiles.size());
    for (std::size_t t = 0; t < tiles.size(); ++t) {
      const DevicePlan& plan = plans_[tiles[t].view];
      memory_[t].bits.reserve(device_, plan.masks.size() * tiles[t].words, "masks of combinations");
      memory_[t].bytes.reserve(device_, plan.rows.size() * tiles[t].words * CHAMFER_QUADS,
                               "rows of distances");
    }
  }
}

void CombinationChamfer::record_tiles(Batch& batch, std::span<const Tile> tiles,
                                      const CombinationBits& combinations,
                                      std::span<const DeviceCells> cells) const {
  const auto push_of = [&](const Tile& tile, std::size_t count) {
    return ChamferPush{
        static_cast<std::uint32_t>(count),  tile.words,         tile.first_word,
        groups_for(combinations.count, 32), combinations.count, plans_[tile.view].cap};
  };
  batch.barrier();
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    const DevicePlan& plan = plans_[tiles[t].view];
    const std::size_t masks = plan.masks.size();
    batch.dispatch(masks_kernel_, spread(groups_for(masks * tiles[t].words, CHAMFER_GROUP)),
                   {plan.masks, plan.hiders, columns_, memory_[t].bits}, push_of(tiles[t], masks));
  }
  batch.barrier();
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    const DevicePlan& plan = plans_[tiles[t].view];
    const std::size_t rows = plan.rows.size();
    batch.dispatch(rows_kernel_, spread(groups_for(rows * tiles[t].words, CHAMFER_GROUP)),
                   {plan.rows, plan.reach, memory_[t].bits, memory_[t].bytes},
                   push_of(tiles[t], rows));
  }
  batch.barrier();
  for (std::size_t t = 0; t < tiles.size(); ++t) {
    const DevicePlan& plan = plans_[tiles[t].view];
    const DeviceCells& of_view = cells[tiles[t].view];
    const auto particles = static_cast<std::uint32_t>(plan.particles.size());
    const std::uint32_t groups = groups_for(tiles[t].words * CHAMFER_HALVES, CHAMFER_GROUP);
    batch.dispatch(sums_kernel_, spread(particles * groups),
                   {plan.particles, plan.visits, plan.rows, memory_[t].bits, memory_[t].bytes,
                    of_view.sums, of_view.counts},
                   push_of(tiles[t], particles));
  }
}

void CombinationChamfer::record(Batch& batch, std::span<const ChamferPlan> plans,
                                const CombinationBits& combinations,
                                std::span<const DeviceCells> cells) {
  check(plans.size() == cells.size(), "combination_chamfer: cells for every view");
  const std::vector<std::uint32_t> columns = columns_of(combinations);
  columns_.reserve(device_, columns.size(), "combinations");
  batch.upload<std::uint32_t>(columns_, columns);
  plans_.clear();
  for (const ChamferPlan& plan : plans) plans_.push_back(uploaded(batch, plan));
  const std::vector<std::vector<Tile>> groups = side_by_side(groups_for(combinations.count, 32));
  reserve(groups);
  for (const std::vector<Tile>& tiles : groups) record_tiles(batch, tiles, combinations, cells);
}

}  // namespace edgescout::gpu
