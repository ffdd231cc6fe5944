#include "kernels/gpu/support_map.h"

#include <span>

#include "kernels/edge_stages.h"
#include "kernels/support_map_push.h"
#include "support_map.spv.h"

namespace edgescout::gpu {

namespace {

constexpr std::size_t TABLE_WORDS = sizeof(SupportTables) / sizeof(std::int32_t);

Kernel make_support_pass(const Device& device, std::uint32_t pass) {
  return Kernel(device, {"support_map", support_map_spv, 5, sizeof(SupportMapPush), {pass}});
}

}  // namespace

SupportMapper::SupportMapper(const Device& device)
    : device_(device),
      candidates_(device),
      passes_{make_support_pass(device, SUPPORT_DIRECTIONS),
              make_support_pass(device, SUPPORT_SPREAD)} {}

void SupportMapper::record(Batch& batch, const ImageView& image, Buffer<std::uint32_t>& map,
                           Buffer<std::uint32_t>& pixels) {
  check_image_size(device_, image);
  const std::size_t count = std::size_t(image.width) * std::size_t(image.height);
  tables_.reserve(device_, TABLE_WORDS, "support tables");
  directions_.reserve(device_, count, "support directions");
  map.reserve(device_, count, "support map");
  batch.upload(tables_, std::span(&support_tables(), 1));
  candidates_.record(batch, image, SUPPORT_SIGMA_PX, edge_threshold(SUPPORT_MIN_GRADIENT), pixels);
  const SupportMapPush push{static_cast<std::uint32_t>(image.width),
                            static_cast<std::uint32_t>(image.height)};
  for (const Kernel& pass : passes_) {
    batch.dispatch(pass, {groups_for(push.width, SUPPORT_MAP_GROUP), push.height},
                   {candidates_.gradient(), candidates_.labels(), tables_, directions_, map}, push);
    batch.barrier();
  }
}

}  // namespace edgescout::gpu
