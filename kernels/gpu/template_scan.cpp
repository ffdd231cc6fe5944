#include "kernels/gpu/template_scan.h"

#include <algorithm>
#include <cstring>

#include "template_planes.spv.h"
#include "template_scan.spv.h"

namespace edgescout::gpu {

namespace {

static_assert(sizeof(TemplateRegion) == 4 * TEMPLATE_SCAN_REGION_WORDS);
static_assert(sizeof(TemplateAnchors) == 4 * TEMPLATE_SCAN_ANCHORS_WORDS);
static_assert(sizeof(ViewpointPoints) == 8 && sizeof(Pose) == 48);

// Of one batch: some tenths of a second on the graphics of a small processor.
constexpr std::uint64_t max_lookups = std::uint64_t{1} << 31;
constexpr std::size_t max_planes_bytes = std::size_t{1} << 30;

TemplatePlanesGrid grid_of(const TensorShape& shape, int anchor_step) {
  const auto step = static_cast<std::uint32_t>(anchor_step), left = TEMPLATE_SCAN_COLUMNS * step,
             top = TEMPLATE_SCAN_ROWS * step,
             columns = groups_for(static_cast<std::uint32_t>(shape.width) + 2 * left, step);
  return {static_cast<std::uint32_t>(shape.height) + 2 * top, columns / 4 + 2, left, top, step};
}

// Of one copy.
std::uint64_t plane_words(const TemplatePlanesGrid& grid, int bins) {
  return std::uint64_t(bins + 1) * grid.rows * grid.anchor_step * grid.stride;
}

// A word of four columns and a row a lane: a graphics card fills its groups of lanes, a
// processor's vectors have eight.
std::uint32_t lanes_of(const Device& device) {
  return device.info().hardware ? std::clamp(device.subgroup_size(), 32u, 64u) : 8;
}

// Words that go to the device in one piece.
class Input {
 public:
  // Returns where they begin.
  template <class T>
  std::uint32_t append(std::span<const T> values) {
    const std::size_t at = words_.size();
    words_.resize(at + values.size_bytes() / 4);
    if (!values.empty()) std::memcpy(words_.data() + at, values.data(), values.size_bytes());
    return static_cast<std::uint32_t>(at);
  }
  std::span<const std::uint32_t> words() const { return words_; }

 private:
  std::vector<std::uint32_t> words_;
};

}  // namespace

TemplateScanner::TemplateScanner(const Device& device)
    : device_(device),
      planes_kernel_(device,
                     {"template_planes", template_planes_spv, 5, sizeof(TemplatePlanesPush), {}}),
      scan_kernel_(device, {"template_scan",
                            template_scan_spv,
                            4,
                            sizeof(TemplateScanPush),
                            {lanes_of(device)},
                            1}) {}

bool TemplateScanner::holds_planes(const TensorShape& shape, int anchor_step) const {
  const std::uint64_t bytes = 16 * plane_words(grid_of(shape, anchor_step), shape.bins);
  return bytes <= max_planes_bytes && bytes / 4 <= device_.limits().maxTexelBufferElements &&
         bytes <= device_.max_band_bytes() && bytes <= device_.max_allocation_bytes();
}

std::size_t TemplateScanner::regions_that_fit(const TemplateScan& scan, std::size_t first) const {
  const std::size_t most_bytes = device_.max_band_bytes();
  const std::uint64_t points = std::ranges::max(scan.viewpoints, {}, &ViewpointPoints::count).count;
  const std::size_t fixed = scan.viewpoints.size_bytes() + scan.distances_m.size_bytes() +
                            (scan.same_numbers ? scan.numbers.size_bytes() : 0);
  const std::size_t of_one = sizeof(TemplateRegion) + sizeof(Pose) * scan.turns() +
                             sizeof(TemplateAnchors) * scan.distances_m.size() +
                             (scan.same_numbers ? 0 : 4 * scan.templates());
  std::uint64_t lookups = 0;
  std::size_t count = 0;
  for (; first + count < scan.regions.size(); ++count) {
    std::uint64_t anchors = 0;
    for (std::size_t d = 0; d < scan.distances_m.size(); ++d) {
      const TemplateAnchors& at = scan.anchors[(first + count) * scan.distances_m.size() + d];
      anchors = std::max(anchors, std::uint64_t(at.columns) * at.rows);
    }
    lookups += points * anchors * scan.templates();
    const std::size_t bytes =
        std::max(fixed + (count + 1) * of_one, 4 * (count + 1) * scan.templates());
    if (count > 0 && (lookups > max_lookups || bytes > most_bytes)) break;
  }
  return count;
}

void TemplateScanner::record_planes(Batch& batch, const DeviceTensor& tensor, std::uint64_t view_id,
                                    int anchor_step) {
  if (planes_of_ == view_id && grid_.anchor_step == static_cast<std::uint32_t>(anchor_step)) return;
  shape_ = tensor.shape();
  grid_ = grid_of(shape_, anchor_step);
  planes_of_ = 0;
  recorded_planes_of_ = view_id;
  const std::uint64_t words = plane_words(grid_, shape_.bins);
  planes_.reserve(device_, 4 * words, "template planes");
  const TemplatePlanesPush push{tensor.grid(), grid_, static_cast<std::uint32_t>(words)};
  batch.dispatch(planes_kernel_.of(tensor), spread(groups_for(words, TEMPLATE_PLANES_GROUP)),
                 {tensor.band(0), tensor.band(1), tensor.band(2), tensor.band(3), planes_}, push);
  batch.barrier();
}

void TemplateScanner::record(Batch& batch, const Buffer<float>& points, const TemplateScan& scan,
                             std::size_t first_region, std::size_t regions) {
  const std::size_t distances = scan.distances_m.size(), templates = scan.templates();
  const auto anchors = scan.anchors.subspan(first_region * distances, regions * distances);
  const auto numbers = scan.same_numbers
                           ? scan.numbers
                           : scan.numbers.subspan(first_region * templates, regions * templates);
  TemplateScanPush push{};
  push.planes = grid_;
  push.width = static_cast<std::uint32_t>(shape_.width);
  push.height = static_cast<std::uint32_t>(shape_.height);
  push.bins = static_cast<std::uint32_t>(shape_.bins);
  const Intrinsics& k = scan.project.intrinsics;
  push.fx = k.fx, push.fy = k.fy, push.cx = k.cx, push.cy = k.cy;
  push.nearest_m = scan.project.nearest_m;
  push.point_count = static_cast<std::uint32_t>(points.size() / TEMPLATE_PROJECT_PLANES);
  push.in_plane_steps = scan.in_plane_steps;
  push.distances = static_cast<std::uint32_t>(distances);
  push.turns = static_cast<std::uint32_t>(scan.turns());
  push.templates = static_cast<std::uint32_t>(templates);
  for (const TemplateAnchors& at : anchors)
    if (at.columns > 0) {
      push.most_columns = std::max(push.most_columns, at.columns);
      push.most_rows = std::max(push.most_rows, at.rows);
    }
  Input input;
  input.append(scan.viewpoints);
  push.distances_at = input.append(scan.distances_m);
  push.numbers_at = input.append(numbers);
  push.numbers_a_region = scan.same_numbers ? 0 : push.templates;
  push.regions_at = input.append(scan.regions.subspan(first_region, regions));
  push.anchors_at = input.append(anchors);
  push.turned_at =
      input.append(scan.turned.subspan(first_region * scan.turns(), regions * scan.turns()));
  host_hits_.resize(regions * templates);
  input_.reserve(device_, input.words().size(), "scan input");
  hits_.reserve(device_, host_hits_.size(), "scan hits");
  batch.upload(input_, input.words());
  batch.barrier();
  Groups groups = spread(push.templates);
  groups.z = static_cast<std::uint32_t>(regions);
  batch.dispatch(scan_kernel_, groups, {planes_, points, input_, hits_}, push);
  batch.download<std::uint32_t>(hits_, host_hits_);
}

void TemplateScanner::collect(const TemplateScan& scan, std::size_t first_region,
                              std::span<TemplateHit> hits) {
  planes_of_ = recorded_planes_of_;
  const std::size_t templates = scan.templates();
  constexpr std::uint32_t anchor_mask = (1u << TEMPLATE_SCAN_ANCHOR_BITS) - 1;
  for (std::size_t i = 0; i < host_hits_.size(); ++i) {
    const std::size_t region = first_region + i / templates;
    TemplateHit& hit = hits[first_region * templates + i];
    const std::uint32_t packed = host_hits_[i];
    if (packed == TEMPLATE_SCAN_NONE) {
      hit = {TEMPLATE_SCAN_NONE, 0, 0};
      continue;
    }
    const TemplateAnchors& at = scan.anchors_of(region, scan.number(region, i % templates));
    const std::uint32_t anchor = packed & anchor_mask;
    hit = {packed >> TEMPLATE_SCAN_ANCHOR_BITS,
           at.x0 + scan.anchor_step * static_cast<int>(anchor % at.columns),
           at.y0 + scan.anchor_step * static_cast<int>(anchor / at.columns)};
  }
}

}  // namespace edgescout::gpu
