// Random problems of edge_support.
#pragma once

#include <random>
#include <vector>

#include "kernels/backend.h"
#include "tests/kernels/pictures.h"

namespace edgescout::test {

// A view whose tensor, which edge_support does not read, is as small as can be.
inline ViewHandle support_view(Backend& backend, const Picture& picture, const ImageView& image) {
  TensorOptions options;
  options.bins = 4;
  return backend.make_view({}, picture.width, picture.height, image, {100, 100, 0, 0}, options);
}

struct SupportCase {
  std::vector<Picture> pictures;  // by view
  std::vector<SupportPoint> points;
  std::vector<SupportProblem> problems;

  std::vector<ViewHandle> views(Backend& backend) const {
    std::vector<ViewHandle> views;
    for (const Picture& p : pictures) views.push_back(support_view(backend, p, p.view()));
    return views;
  }
  std::vector<EdgeSupport> run(Backend& backend, std::span<const ViewHandle> views) const {
    std::vector<EdgeSupport> out(problems.size());
    backend.edge_support(views, points, problems, out);
    return out;
  }
  std::span<const SupportPoint> points_of(const SupportProblem& problem) const {
    return std::span(points).subspan(problem.first_point, problem.point_count);
  }
};

inline SupportPoint random_support_point(std::mt19937& rng, const Picture& picture) {
  return {static_cast<std::uint16_t>(rng() % std::uint32_t(picture.width)),
          static_cast<std::uint16_t>(rng() % std::uint32_t(picture.height)),
          static_cast<std::uint16_t>(rng() % 3000), static_cast<std::uint8_t>(rng() % SUPPORT_BINS),
          static_cast<std::uint8_t>(rng() % SUPPORT_PARTS)};
}

// Views of several sizes, also smaller than the displacements, and problems of 0 to `most` points
// in all of them by turns.
inline SupportCase support_case(std::mt19937& rng, int problems, std::uint32_t most) {
  SupportCase c;
  for (const auto& [width, height] : std::vector<std::pair<int, int>>{{90, 60}, {3, 5}, {141, 67}})
    c.pictures.push_back(random_picture(rng, width, height, width == 3));
  for (int i = 0; i < problems; ++i) {
    const auto view = static_cast<std::uint32_t>(i) % 3;
    const std::uint32_t count = i == 0 ? most : rng() % (most + 1);
    c.problems.push_back({static_cast<std::uint32_t>(c.points.size()), count, view});
    for (std::uint32_t n = 0; n < count; ++n)
      c.points.push_back(random_support_point(rng, c.pictures[view]));
  }
  return c;
}

}  // namespace edgescout::test
