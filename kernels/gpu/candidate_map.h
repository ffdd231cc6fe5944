// Records candidate_map (kernels/candidate_map.h, candidate_map_push.h).
#pragma once

#include <span>
#include <vector>

#include "kernels/candidate_map_push.h"
#include "kernels/gpu/batch.h"

namespace edgescout::gpu {

class CandidateMaps {
 public:
  explicit CandidateMaps(const Device& device);
  // How many of the maps, from the first, one batch draws: what the device binds at once, and not
  // so much that it fills its memory.
  std::size_t take(std::span<const CandidateMap> maps) const;
  // What take() says, of maps that check_candidate_maps() has passed.
  void record(Batch& batch, std::span<const MapEdge> edges, std::span<const CandidateMap> maps,
              int width, int height);
  // After the batch has run, into the caller's layout.
  void collect(std::span<const CandidateMap> maps, std::span<std::uint32_t> nearest) const;

 private:
  const Device& device_;
  Kernel kernel_;
  Buffer<MapEdge> edges_;
  Buffer<CandidateMap> maps_;
  Buffer<std::uint32_t> tiles_, nearest_;
  std::vector<std::uint32_t> host_nearest_;
};

}  // namespace edgescout::gpu
