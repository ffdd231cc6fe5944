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

constexpr std::size_t max_row_bytes = std::size_t{64} << 20;

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
                         std::uint32_t realization_count)
    : particles(static_cast<std::uint32_t>(particle_count)),
      combinations(realization_count),
      sums(device, particle_count * realization_count, "chamfer sums"),
      counts(device, particle_count * realization_count, "chamfer counts") {
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

void CombinationChamfer::upload(Batch& batch, const ChamferPlan& plan,
                                const CombinationBits& combinations) {
  const std::vector<std::uint32_t> columns = columns_of(combinations);
  masks_.reserve(device_, plan.masks.size(), "chamfer masks");
  rows_.reserve(device_, plan.rows.size(), "chamfer rows");
  particles_.reserve(device_, plan.particles.size(), "particles");
  hiders_.reserve(device_, plan.hiders.size(), "hiding candidates");
  reach_.reserve(device_, plan.reach.size(), "edges in reach");
  visits_.reserve(device_, plan.visits.size(), "particles' visits");
  columns_.reserve(device_, columns.size(), "combinations");
  batch.upload<ChamferMask>(masks_, plan.masks);
  batch.upload<ChamferRow>(rows_, plan.rows);
  batch.upload<ChamferRun>(particles_, plan.particles);
  batch.upload<std::uint32_t>(hiders_, plan.hiders);
  batch.upload<std::uint32_t>(reach_, plan.reach);
  batch.upload<ChamferVisit>(visits_, plan.visits);
  batch.upload<std::uint32_t>(columns_, columns);
}

std::uint32_t CombinationChamfer::tile_words(const ChamferPlan& plan, std::uint32_t words) const {
  const std::size_t most = std::min<std::size_t>(max_row_bytes, device_.max_band_bytes());
  const std::size_t word_bytes =
      std::max(plan.rows.size() * 32, plan.masks.size() * sizeof(std::uint32_t));
  return static_cast<std::uint32_t>(
      std::clamp<std::size_t>(most / std::max<std::size_t>(word_bytes, 1), 1, std::max(words, 1u)));
}

void CombinationChamfer::record_tile(Batch& batch, const ChamferPlan& plan, const ChamferPush& tile,
                                     const DeviceCells& cells) {
  ChamferPush push = tile;
  const auto record = [&](const Kernel& kernel, std::size_t count, std::size_t groups,
                          std::initializer_list<Bound> bound) {
    push.count = static_cast<std::uint32_t>(count);
    batch.barrier();
    batch.dispatch(kernel, spread(static_cast<std::uint32_t>(groups)), bound, push);
  };
  const std::size_t masks = plan.masks.size(), rows = plan.rows.size(),
                    particles = plan.particles.size();
  record(masks_kernel_, masks, groups_for(masks * tile.words, CHAMFER_GROUP),
         {masks_, hiders_, columns_, bits_});
  record(rows_kernel_, rows, groups_for(rows * tile.words, CHAMFER_GROUP),
         {rows_, reach_, bits_, bytes_});
  record(sums_kernel_, particles,
         particles * groups_for(std::size_t{tile.words} * CHAMFER_HALVES, CHAMFER_GROUP),
         {particles_, visits_, rows_, bits_, bytes_, cells.sums, cells.counts});
}

void CombinationChamfer::record(Batch& batch, const ChamferPlan& plan,
                                const CombinationBits& combinations, const DeviceCells& cells) {
  upload(batch, plan, combinations);
  const std::uint32_t words = groups_for(combinations.count, 32), tile = tile_words(plan, words);
  bits_.reserve(device_, plan.masks.size() * tile, "masks of combinations");
  bytes_.reserve(device_, plan.rows.size() * tile * CHAMFER_QUADS, "rows of distances");
  for (std::uint32_t first = 0; first < words; first += tile)
    record_tile(batch, plan,
                {0, std::min(tile, words - first), first, words, combinations.count, plan.cap},
                cells);
}

}  // namespace edgescout::gpu
