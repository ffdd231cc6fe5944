// The edge detector, fast: gradient and thinning by bands of rows (files of their own), components
// by union-find over the list of candidates.
#include <algorithm>

#include "kernels/edge_stages.h"
#include "kernels/error.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

// Candidates under one root; a root is the first of its component.
class Components {
 public:
  explicit Components(std::size_t count) : parent_(count) {
    for (std::size_t i = 0; i < count; ++i) parent_[i] = static_cast<std::uint32_t>(i);
  }
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

Components connect(const std::vector<EdgePixel>& pixels) {
  Components components(pixels.size());
  std::uint32_t above = 0;  // first candidate that may still touch the next one from the row above
  for (std::uint32_t i = 0; i < pixels.size(); ++i) {
    const EdgePixel& p = pixels[i];
    if (i > 0 && pixels[i - 1].y == p.y && pixels[i - 1].x == p.x - 1) components.join(i - 1, i);
    while (pixels[above].y < p.y - 1 || (pixels[above].y == p.y - 1 && pixels[above].x < p.x - 1))
      ++above;
    for (std::uint32_t j = above; pixels[j].y == p.y - 1 && pixels[j].x <= p.x + 1; ++j)
      components.join(j, i);
  }
  return components;
}

}  // namespace

void edge_link_fast(std::int32_t high, int min_length_px, std::vector<EdgePixel>& pixels) {
  Components components = connect(pixels);
  std::vector<std::uint32_t> root(pixels.size());
  struct Chain {
    std::int32_t length = 0;
    std::uint32_t strongest = 0;
  };
  std::vector<Chain> chains(pixels.size());
  for (std::uint32_t i = 0; i < pixels.size(); ++i) {
    root[i] = components.root(i);
    Chain& chain = chains[root[i]];
    ++chain.length;
    chain.strongest = std::max(chain.strongest, pixels[i].m2);
  }
  const auto high2 = static_cast<std::uint32_t>(high * high);
  std::size_t kept = 0;
  for (std::uint32_t i = 0; i < pixels.size(); ++i) {
    const Chain& chain = chains[root[i]];
    if (chain.length >= min_length_px && chain.strongest >= high2) pixels[kept++] = pixels[i];
  }
  pixels.resize(kept);
}

std::vector<EdgePoint> detect_edges_fast(const ImageView& image, const EdgeOptions& options,
                                         ThreadPool& pool) {
  options.validate();
  check(image.width > 0 && image.height > 0 && image.pixels,
        "detect_edges: an image without pixels");
  EdgePlanes planes(image.width, image.height);
  edge_gradient_fast(image, edge_weights(options.sigma_px), pool, planes);
  std::vector<EdgePixel> pixels =
      edge_thin_fast(edge_threshold(options.low_threshold), pool, planes);
  edge_link_fast(edge_threshold(options.high_threshold), options.min_length_px, pixels);
  std::vector<EdgePoint> points(pixels.size());
  constexpr std::size_t share = 512;
  pool.for_each((points.size() + share - 1) / share, [&](std::size_t part) {
    for (std::size_t i = part * share; i < std::min(points.size(), (part + 1) * share); ++i)
      points[i] = edge_point_fast(planes, pixels[i]);
  });
  return points;
}

}  // namespace edgescout
