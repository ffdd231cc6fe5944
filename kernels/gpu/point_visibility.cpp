#include "kernels/gpu/point_visibility.h"

#include <algorithm>

#include "kernels/gpu/point_range.h"
#include "point_visibility.spv.h"

namespace edgescout::gpu {

namespace {

static_assert(sizeof(VisibilityJob) == 4 * VISIBILITY_JOB_WORDS);

std::uint32_t groups_of(std::uint32_t points) { return groups_for(points, POINT_VISIBILITY_GROUP); }

}  // namespace

PointVisibility::PointVisibility(const Device& device)
    : device_(device),
      kernel_(device,
              {"point_visibility", point_visibility_spv, 4, sizeof(PointVisibilityPush), {}}) {}

std::size_t PointVisibility::that_fit(const DepthRaster& raster, std::size_t triangles,
                                      const VisibilityPoints& points,
                                      std::span<const VisibilityJob> jobs, int size) const {
  const std::size_t most_jobs = raster.max_jobs(triangles, size, size),
                    most_bytes = device_.max_band_bytes();
  PointRange own;
  std::size_t count = 0, words = 0;
  while (count < jobs.size()) {
    const VisibilityJob& job = jobs[count];
    own.include(job.first_point, job.point_count);
    words += POINT_VISIBILITY_WORDS * std::size_t(groups_of(points.shared + job.point_count));
    const std::size_t bytes = std::max({(count + 1) * sizeof(VisibilityJob), 4 * words,
                                        12 * (std::size_t(points.shared) + own.size())});
    if (count > 0 && (count == most_jobs || bytes > most_bytes)) break;
    ++count;
  }
  return count;
}

void PointVisibility::record(Batch& batch, DepthRaster& raster, const TriangleMesh& mesh,
                             const VisibilityPoints& points, std::span<const VisibilityJob> jobs,
                             int size) {
  PointRange own;
  for (const VisibilityJob& job : jobs) own.include(job.first_point, job.point_count);
  std::vector<DepthJob> drawn;
  std::vector<VisibilityJob> moved(jobs.begin(), jobs.end());
  counts_.clear();
  std::uint32_t words = 0, longest = 0;
  for (VisibilityJob& job : moved) {
    drawn.push_back({job.camera_from_object, job.intrinsics});
    if (job.point_count > 0) job.first_point += points.shared - own.begin;
    job.first_word = words;
    const std::uint32_t count = points.shared + job.point_count;
    counts_.push_back(count);
    words += POINT_VISIBILITY_WORDS * groups_of(count);
    longest = std::max(longest, count);
  }
  std::vector<float> list(points.points_m.begin(), points.points_m.begin() + 3 * points.shared);
  const auto others = points.points_m.subspan(3 * std::size_t(own.begin), 3 * own.size());
  list.insert(list.end(), others.begin(), others.end());
  host_words_.resize(words);
  points_.reserve(device_, list.size(), "points to look at");
  jobs_.reserve(device_, moved.size(), "visibility jobs");
  words_.reserve(device_, words, "visibility flags");
  batch.upload<float>(points_, list);
  batch.upload<VisibilityJob>(jobs_, moved);
  raster.record(batch, mesh, drawn, size, size);
  batch.barrier();
  Groups groups = spread(static_cast<std::uint32_t>(jobs.size()));
  groups = {groups_of(longest), groups.x, groups.y};
  const PointVisibilityPush push{static_cast<std::uint32_t>(size), points.shared,
                                 static_cast<std::uint32_t>(jobs.size())};
  batch.dispatch(kernel_, groups, {raster.maps(), points_, jobs_, words_}, push);
  batch.download<std::uint32_t>(words_, host_words_);
}

void PointVisibility::collect(std::span<std::uint8_t> flags) const {
  std::size_t next = 0, word = 0;
  for (const std::uint32_t count : counts_) {
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t lane = i % POINT_VISIBILITY_GROUP;
      const std::uint32_t* bits =
          host_words_.data() + word + POINT_VISIBILITY_WORDS * (i / POINT_VISIBILITY_GROUP);
      const std::uint32_t visible = bits[lane / 32] >> (lane % 32) & 1,
                          borders = bits[2 + lane / 32] >> (lane % 32) & 1;
      flags[next++] =
          static_cast<std::uint8_t>(visible * POINT_VISIBLE | borders * POINT_BORDERS_BACKGROUND);
    }
    word += POINT_VISIBILITY_WORDS * groups_of(count);
  }
}

}  // namespace edgescout::gpu
