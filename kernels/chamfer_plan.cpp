#include "kernels/chamfer_plan.h"

#include <algorithm>
#include <atomic>
#include <compare>
#include <optional>

#include "kernels/error.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

constexpr std::uint32_t nowhere = ~0u;
constexpr std::uint32_t max_masks = 1u << 24;

// For every pixel of the image a sorted list.
template <class T>
struct PixelLists {
  std::vector<std::uint32_t> first;  // pixels + 1
  std::vector<T> entries;
  std::span<const T> at(std::size_t pixel) const {
    return std::span(entries).subspan(first[pixel], first[pixel + 1] - first[pixel]);
  }
};

// Calls `visit(c, i, pixel)` for the pixels of all candidates' windows in rows [y0, y1) of the
// image; i is the place in `nearest`.
template <class Visit>
void visit_windows(const ChamferView& view, int y0, int y1, const Visit& visit) {
  for (std::uint32_t c = 0; c < view.candidates.size(); ++c) {
    const CandidateMap& map = view.candidates[c];
    const MapWindow& w = map.window;
    const int left = std::max(0, w.x0), right = std::min(view.width, w.x0 + int(w.width));
    for (int y = std::max(y0, w.y0); y < std::min(y1, w.y0 + int(w.height)); ++y)
      for (int x = left; x < right; ++x)
        visit(c, map.first_pixel + w.index(x, y),
              std::size_t(y) * std::size_t(view.width) + std::size_t(x));
  }
}

// Lists of what `entry_of(c, i, pixel)` says, an optional of T; a band of rows at a time.
template <class T, class EntryOf>
PixelLists<T> gather(const ChamferView& view, ThreadPool& pool, const EntryOf& entry_of) {
  const int band_rows = std::max(1, view.height / (4 * pool.threads()));
  const auto bands = std::size_t((view.height + band_rows - 1) / band_rows);
  const auto for_bands = [&](const auto& body) {
    pool.for_each(bands, [&](std::size_t b) {
      body(int(b) * band_rows, std::min(view.height, int(b + 1) * band_rows));
    });
  };
  PixelLists<T> lists;
  lists.first.resize(std::size_t(view.width) * view.height + 1, 0);
  for_bands([&](int y0, int y1) {
    visit_windows(view, y0, y1, [&](std::uint32_t c, std::size_t i, std::size_t pixel) {
      lists.first[pixel + 1] += entry_of(c, i, pixel).has_value();
    });
  });
  for (std::size_t pixel = 0; pixel + 1 < lists.first.size(); ++pixel)
    lists.first[pixel + 1] += lists.first[pixel];
  lists.entries.resize(lists.first.back());
  for_bands([&](int y0, int y1) {
    const std::size_t begin = std::size_t(y0) * view.width, end = std::size_t(y1) * view.width;
    std::vector<std::uint32_t> next(lists.first.begin() + begin, lists.first.begin() + end);
    visit_windows(view, y0, y1, [&](std::uint32_t c, std::size_t i, std::size_t pixel) {
      if (const std::optional<T> entry = entry_of(c, i, pixel))
        lists.entries[next[pixel - begin]++] = *entry;
    });
    for (std::size_t pixel = begin; pixel < end; ++pixel)
      std::sort(lists.entries.begin() + lists.first[pixel],
                lists.entries.begin() + lists.first[pixel + 1]);
  });
  return lists;
}

struct Surface {
  float hides_from_m;  // its depth and its candidate's tolerance
  std::uint32_t candidate;
  // The compiler's own comparison with 0 is no null pointer: NOLINTNEXTLINE(modernize-use-nullptr)
  auto operator<=>(const Surface&) const = default;
};

class Planner {
 public:
  Planner(const ChamferView& view, const ChamferOptions& options, ThreadPool& pool)
      : view_(view), options_(options), pool_(pool), base_(view.first_point.front()) {}

  ChamferPlan make() {
    plan_.cap = options_.cap_steps();
    surfaces_ = gather<Surface>(view_, pool_, [&](std::uint32_t c, std::size_t i, std::size_t) {
      const float hides_from_m = view_.surface_m[i] + view_.tolerance_m[c];
      return hides_from_m < std::numeric_limits<float>::infinity()
                 ? std::optional(Surface{hides_from_m, c})
                 : std::nullopt;
    });
    for (const Surface& surface : surfaces_.entries) plan_.hiders.push_back(surface.candidate);
    plan_.masks.resize(1 + view_.candidates.size());
    for (std::uint32_t c = 0; c < view_.candidates.size(); ++c) plan_.masks[1 + c].member = c;
    place_points();
    mask_edges();
    make_rows();
    sort_visits();
    return std::move(plan_);
  }

 private:
  // The surfaces that hide a depth are the first of the pixel's.
  std::uint32_t surfaces_before(std::size_t pixel, float z_m) const {
    std::uint32_t count = 0;
    for (const Surface& surface : surfaces_.at(pixel)) {
      if (!(surface.hides_from_m < z_m)) break;
      ++count;
    }
    return count;
  }
  // A pixel with n surfaces has n + 1 slots: as many of the surfaces in front of a point as there
  // are.
  std::size_t slots() const { return surfaces_.entries.size() + surfaces_.first.size() - 1; }
  std::size_t first_slot(std::size_t pixel) const { return surfaces_.first[pixel] + pixel; }

  // Read first: lines that are only read need not change hands between threads.
  static void mark(std::atomic<bool>& used) {
    if (!used.load(std::memory_order_relaxed)) used.store(true, std::memory_order_relaxed);
  }

  void place_points() {
    slot_.assign(view_.first_point.back() - base_, nowhere);
    slot_used_ = std::vector<std::atomic<bool>>(slots());
    pixel_used_ = std::vector<std::atomic<bool>>(surfaces_.first.size() - 1);
    for_particles([&](std::size_t i) {
      for (std::uint32_t p = view_.first_point[i]; p < view_.first_point[i + 1]; ++p) {
        const ParticlePoint& point = view_.points[p];
        int x = 0, y = 0;
        if (!nearest_pixel(point.x_px, point.y_px, view_.width, view_.height, x, y)) continue;
        const std::size_t pixel = std::size_t(y) * view_.width + x;
        const std::size_t slot = first_slot(pixel) + surfaces_before(pixel, point.z_m);
        slot_[p - base_] = static_cast<std::uint32_t>(slot);
        mark(pixel_used_[pixel]);
        mark(slot_used_[slot]);
      }
    });
  }

  // Neighbours on an edge mostly have the same in front of them, and share a mask.
  void mask_edges() {
    std::vector<std::uint32_t> front, last;
    for (std::uint32_t c = 0; c < view_.candidates.size(); ++c) {
      const CandidateMap& map = view_.candidates[c];
      first_edge_.push_back(edge_mask_.size());
      std::uint32_t mask = 1 + c;
      last.clear();
      for (std::uint32_t e = 0; e < map.edge_count; ++e) {
        hiders_of(view_.edges[map.first_edge + e], c, front);
        if (front != last) mask = front.empty() ? 1 + c : add_mask(c, front);
        std::swap(front, last);
        edge_mask_.push_back(mask);
      }
    }
  }
  void hiders_of(const MapEdge& edge, std::uint32_t own, std::vector<std::uint32_t>& front) const {
    front.clear();
    int x = 0, y = 0;
    if (!nearest_pixel(edge.x_px, edge.y_px, view_.width, view_.height, x, y)) return;
    const std::size_t pixel = std::size_t(y) * view_.width + x;
    for (const Surface& surface : surfaces_.at(pixel).first(surfaces_before(pixel, edge.z_m)))
      if (surface.candidate != own) front.push_back(surface.candidate);
    std::ranges::sort(front);
  }
  std::uint32_t add_mask(std::uint32_t member, std::span<const std::uint32_t> hiders) {
    plan_.masks.push_back({member, static_cast<std::uint32_t>(plan_.hiders.size()),
                           static_cast<std::uint32_t>(hiders.size())});
    plan_.hiders.insert(plan_.hiders.end(), hiders.begin(), hiders.end());
    return static_cast<std::uint32_t>(plan_.masks.size() - 1);
  }

  void make_rows() {
    const std::uint32_t farthest = plan_.cap - 1;
    const std::uint32_t farthest_d2 = farthest * farthest + farthest;  // that rounds below the cap
    PixelLists<std::uint32_t> reach =
        gather<std::uint32_t>(view_, pool_, [&](std::uint32_t c, std::size_t i, std::size_t pixel) {
          const std::uint32_t word = pixel_used_[pixel].load(std::memory_order_relaxed)
                                         ? view_.nearest[i]
                                         : CANDIDATE_MAP_EMPTY;
          if (word >> 16 > farthest_d2) return std::optional<std::uint32_t>();
          check((word & 0xffffu) < view_.candidates[c].edge_count,
                "combination_chamfer: a nearest edge point that is none");
          return std::optional(chamfer_steps(word) << 24 |
                               edge_mask_[first_edge_[c] + (word & 0xffffu)]);
        });
    row_of_slot_.assign(slots(), nowhere);
    for (std::size_t pixel = 0; pixel + 1 < surfaces_.first.size(); ++pixel) {
      if (!pixel_used_[pixel].load(std::memory_order_relaxed)) continue;
      const std::uint32_t first = surfaces_.first[pixel],
                          count = surfaces_.first[pixel + 1] - first;
      for (std::uint32_t before = 0; before <= count; ++before) {
        const std::size_t slot = first_slot(pixel) + before;
        if (!slot_used_[slot].load(std::memory_order_relaxed)) continue;
        row_of_slot_[slot] = static_cast<std::uint32_t>(plan_.rows.size());
        const std::uint32_t visible =
            before > 0 ? static_cast<std::uint32_t>(plan_.masks.size()) : 0;
        // The surfaces' candidates are the first of the hiders, in the surfaces' order.
        if (before > 0) plan_.masks.push_back({CHAMFER_NO_MEMBER, first, before});
        plan_.rows.push_back(
            {reach.first[pixel], reach.first[pixel + 1] - reach.first[pixel], visible});
      }
    }
    check(plan_.masks.size() <= max_masks && plan_.rows.size() < (1u << 31),
          "combination_chamfer: too many surfaces in front of points");
    plan_.reach = std::move(reach.entries);
  }

  // Calls `body(visit, hideable)` for a particle's visits in the order of its points.
  template <class Body>
  void for_visits(std::size_t particle, const Body& body) const {
    ChamferVisit visit;
    const auto leave = [&] {
      if (visit.count > 0) body(visit, plan_.rows[visit.row].visible != 0);
    };
    for (std::uint32_t p = view_.first_point[particle]; p < view_.first_point[particle + 1]; ++p) {
      if (slot_[p - base_] == nowhere) continue;
      const std::uint32_t row = row_of_slot_[slot_[p - base_]];
      if (row != visit.row || visit.count == CHAMFER_POINTS_AT_ONCE) {
        leave();
        visit = {row, 0, 0};
      }
      ++visit.count;
      visit.unseen = static_cast<std::uint16_t>(visit.unseen + view_.points[p].unseen);
    }
    leave();
  }

  void sort_visits() {
    plan_.particles.resize(view_.particles());
    for_particles([&](std::size_t i) {
      for_visits(i, [&](const ChamferVisit&, bool hideable) {
        ++plan_.particles[i].end;
        plan_.particles[i].first_hideable += !hideable;
      });
    });
    std::uint32_t next = 0;
    for (ChamferRun& run : plan_.particles) {
      run.first += next;
      run.first_hideable += next;
      run.end += next;
      next = run.end;
    }
    plan_.visits.resize(next);
    for_particles([&](std::size_t i) {
      ChamferRun& run = plan_.particles[i];
      std::uint32_t open = run.first, hideable = run.first_hideable;
      for_visits(i, [&](const ChamferVisit& visit, bool may_hide) {
        plan_.visits[may_hide ? hideable++ : open++] = visit;
        run.points += visit.count;
        run.unseen += visit.unseen;
      });
    });
  }

  template <class Body>
  void for_particles(const Body& body) {
    pool_.for_each(view_.particles(), body);
  }

  const ChamferView& view_;
  const ChamferOptions& options_;
  ThreadPool& pool_;
  std::uint32_t base_;  // the first particle's first point
  ChamferPlan plan_;
  PixelLists<Surface> surfaces_;
  std::vector<std::uint32_t> slot_, row_of_slot_;
  std::vector<std::atomic<bool>> slot_used_, pixel_used_;
  std::vector<std::size_t> first_edge_;  // of a candidate's, in:
  std::vector<std::uint32_t> edge_mask_;
};

}  // namespace

ChamferPlan plan_chamfer(const ChamferView& view, const ChamferOptions& options, ThreadPool& pool) {
  return Planner(view, options, pool).make();
}

}  // namespace edgescout
