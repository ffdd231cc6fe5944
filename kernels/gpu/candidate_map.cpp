#include "kernels/gpu/candidate_map.h"

#include <algorithm>

#include "candidate_map.spv.h"

namespace edgescout::gpu {

namespace {

static_assert(sizeof(MapEdge) == 4 * MAP_EDGE_WORDS);
static_assert(sizeof(CandidateMap) == 4 * CANDIDATE_MAP_WORDS);

constexpr std::size_t max_map_bytes = std::size_t{64} << 20;

}  // namespace

CandidateMaps::CandidateMaps(const Device& device)
    : device_(device),
      kernel_(device, {"candidate_map", candidate_map_spv, 4, sizeof(CandidateMapPush), {}}) {}

std::size_t CandidateMaps::take(std::span<const CandidateMap> maps) const {
  const std::size_t most =
      std::min<std::size_t>(max_map_bytes, device_.max_band_bytes()) / sizeof(std::uint32_t);
  std::size_t count = 0, pixels = 0, edges = 0;
  while (count < maps.size()) {
    pixels += maps[count].window.size();
    edges += maps[count].edge_count * std::size_t{MAP_EDGE_WORDS};
    if (count > 0 && std::max(pixels, edges) > most) break;
    ++count;
  }
  return count;
}

void CandidateMaps::record(Batch& batch, std::span<const MapEdge> edges,
                           std::span<const CandidateMap> maps, int width, int height) {
  // Only what these maps name, one after the other.
  std::vector<MapEdge> own_edges;
  std::vector<CandidateMap> own_maps(maps.begin(), maps.end());
  std::vector<std::uint32_t> tiles;
  std::uint32_t pixels = 0, most_edges = 0;
  for (std::uint32_t m = 0; m < own_maps.size(); ++m) {
    CandidateMap& map = own_maps[m];
    const auto points = edges.subspan(map.first_edge, map.edge_count);
    map.first_edge = static_cast<std::uint32_t>(own_edges.size());
    map.first_pixel = pixels;
    most_edges = std::max(most_edges, map.edge_count);
    own_edges.insert(own_edges.end(), points.begin(), points.end());
    pixels += static_cast<std::uint32_t>(map.window.size());
    for (std::uint32_t y = 0; y < groups_for(map.window.height, CANDIDATE_TILE); ++y)
      for (std::uint32_t x = 0; x < groups_for(map.window.width, CANDIDATE_TILE); ++x)
        tiles.insert(tiles.end(), {m, y << 16 | x});
  }
  edges_.reserve(device_, own_edges.size(), "candidates' edge points");
  maps_.reserve(device_, own_maps.size(), "candidate maps");
  tiles_.reserve(device_, tiles.size(), "candidate tiles");
  nearest_.reserve(device_, pixels, "nearest edge points");
  batch.upload<MapEdge>(edges_, own_edges);
  batch.upload<CandidateMap>(maps_, own_maps);
  batch.upload<std::uint32_t>(tiles_, tiles);
  batch.barrier();
  const auto count = static_cast<std::uint32_t>(tiles.size() / 2);
  const CandidateMapPush push{count, static_cast<std::uint32_t>(width),
                              static_cast<std::uint32_t>(height), most_edges};
  batch.dispatch(kernel_, spread(count), {edges_, maps_, tiles_, nearest_}, push);
  host_nearest_.resize(pixels);
  batch.download<std::uint32_t>(nearest_, host_nearest_);
}

void CandidateMaps::collect(std::span<const CandidateMap> maps,
                            std::span<std::uint32_t> nearest) const {
  const std::uint32_t* from = host_nearest_.data();
  for (const CandidateMap& map : maps) {
    std::copy_n(from, map.window.size(), nearest.begin() + map.first_pixel);
    from += map.window.size();
  }
}

}  // namespace edgescout::gpu
