#include "host/edge/depth_edges.h"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "host/edge/salient_edges.h"

namespace edgescout {

namespace {

constexpr int NEAR_PX = 2, MOST_PX = 24, STEP_PX = 2;
constexpr std::size_t FEWEST_JUMPS = 200, MOST_JUMPS = 3000;

struct Jumps {
  std::vector<cv::Point> at;  // the last pixel of the nearer surface

  // Between neighbours that were measured: `along` is the step to the next pixel of the line.
  void add_line(const DepthImage& depth, const DepthNoise& noise, cv::Point from, cv::Point along,
                int length) {
    constexpr int longest_gap_px = 5;
    constexpr double least_relative = 0.01, least_sigmas = 6;
    int last = -1;
    for (int i = 0; i < length; ++i) {
      const cv::Point here = from + i * along;
      const double z_m = depth.at(here.x, here.y);
      if (!(z_m > 0)) continue;
      if (last >= 0 && i - last <= longest_gap_px) {
        const cv::Point before = from + last * along;
        const double before_m = depth.at(before.x, before.y), nearer_m = std::min(z_m, before_m);
        if (std::abs(z_m - before_m) >
            std::max(least_relative * nearer_m, least_sigmas * noise.sigma_m(nearer_m)))
          at.push_back(z_m < before_m ? here : before);
      }
      last = i;
    }
  }
};

std::vector<cv::Point> jumps_of(const DepthImage& depth, const DepthNoise& noise) {
  Jumps jumps;
  for (int y = 0; y < depth.height; ++y) jumps.add_line(depth, noise, {0, y}, {1, 0}, depth.width);
  for (int x = 0; x < depth.width; ++x) jumps.add_line(depth, noise, {x, 0}, {0, 1}, depth.height);
  const std::size_t every = jumps.at.size() / MOST_JUMPS + 1;
  std::vector<cv::Point> some;
  for (std::size_t i = 0; i < jumps.at.size(); i += every) some.push_back(jumps.at[i]);
  return some;
}

// Where an edge is near, with a border of MOST_PX on all sides.
cv::Mat near_edges(const DepthImage& depth, std::span<const EdgePoint> edges) {
  cv::Mat near = cv::Mat::zeros(depth.height + 2 * MOST_PX, depth.width + 2 * MOST_PX, CV_8U);
  for (const EdgePoint& edge : salient_edges(edges, depth.width, depth.height)) {
    const int x = int(std::lround(edge.x_px)), y = int(std::lround(edge.y_px));
    if (x >= 0 && x < depth.width && y >= 0 && y < depth.height)
      near.at<std::uint8_t>(y + MOST_PX, x + MOST_PX) = 1;
  }
  cv::dilate(near, near,
             cv::getStructuringElement(cv::MORPH_ELLIPSE, {2 * NEAR_PX + 1, 2 * NEAR_PX + 1}));
  return near;
}

double share_on_edges(const cv::Mat& near, std::span<const cv::Point> jumps, cv::Point move) {
  std::size_t hits = 0;
  for (const cv::Point& jump : jumps)
    hits += near.at<std::uint8_t>(jump + move + cv::Point(MOST_PX, MOST_PX));
  return double(hits) / double(jumps.size());
}

DepthFit fit_of(const DepthEdges& found) {
  constexpr double most_by_chance = 0.7, least_gain = 0.3, same_gain = 0.6;
  if (found.by_chance > most_by_chance) return DepthFit::Unknown;
  // Of the jumps that chance leaves.
  const double gain = (found.best - found.by_chance) / (1 - found.by_chance),
               gain_in_place = (found.in_place - found.by_chance) / (1 - found.by_chance);
  if (gain < least_gain) return DepthFit::Elsewhere;
  return gain_in_place < same_gain * gain ? DepthFit::Moved : DepthFit::Fits;
}

}  // namespace

DepthEdges compare_depth_edges(const DepthImage& depth, const DepthNoise& noise,
                               std::span<const EdgePoint> edges) {
  DepthEdges found;
  const std::vector<cv::Point> jumps = jumps_of(depth, noise);
  found.jumps = jumps.size();
  if (jumps.size() < FEWEST_JUMPS || edges.empty()) return found;
  const cv::Mat near = near_edges(depth, edges);
  std::vector<std::pair<cv::Point, double>> shares;
  for (int y = -MOST_PX; y <= MOST_PX; y += STEP_PX)
    for (int x = -MOST_PX; x <= MOST_PX; x += STEP_PX) {
      const double share = share_on_edges(near, jumps, {x, y});
      shares.emplace_back(cv::Point(x, y), share);
      if (x == 0 && y == 0) found.in_place = share;
      if (share > found.best) found.best = share, found.dx_px = x, found.dy_px = y;
    }
  constexpr double far_px = 10;
  double sum = 0, count = 0;
  for (const auto& [move, share] : shares)
    if (std::hypot(move.x - found.dx_px, move.y - found.dy_px) > far_px) sum += share, count += 1;
  found.by_chance = sum / count;
  found.fit = fit_of(found);
  return found;
}

}  // namespace edgescout
