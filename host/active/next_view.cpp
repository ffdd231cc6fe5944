#include "host/active/next_view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "host/active/candidate_scene.h"
#include "host/active/seen_points.h"
#include "host/active/views.h"
#include "host/core/log.h"
#include "host/core/option_bounds.h"
#include "kernels/error.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

// Views whose maps are made at once: enough to keep every thread and device busy, few enough to
// stay in memory, 8 bytes a pixel, were every candidate as large as the image.
std::size_t views_at_once(std::size_t candidates, const Camera& map_camera) {
  constexpr std::size_t maps = 2048, pixels = std::size_t(1) << 27;
  const std::size_t image = std::size_t(map_camera.width) * std::size_t(map_camera.height);
  return std::max<std::size_t>(1, std::min(maps, pixels / image) / candidates);
}

// The particles that have a weight, and what real views told about them.
struct Watched {
  std::vector<const Particle*> particles;
  std::vector<SeenPoints> seen;
  std::vector<ParticleBelief> beliefs;
};

Watched watch(const Planning& planning, ThreadPool& pool, const NextViewOptions& options) {
  Watched watched;
  for (const Particle& particle : planning.particles)
    if (particle.log_weight > -std::numeric_limits<double>::infinity())
      watched.particles.push_back(&particle);
  // The paper's own formula: seen is what projects into an image, and the real views stand in
  // Upsilon alone.
  const double seen_px = options.use_paper_formula ? 0 : options.seen_px;
  watched.seen.resize(watched.particles.size());
  pool.for_each(watched.particles.size(), [&](std::size_t i) {
    const Particle& particle = *watched.particles[i];
    watched.seen[i] = seen_in(planning.tables[particle.object], particle.world_from_object,
                              planning.real_views, seen_px);
  });
  for (std::size_t i = 0; i < watched.particles.size(); ++i) {
    const Particle& particle = *watched.particles[i];
    watched.beliefs.push_back({options.use_paper_formula ? 0 : particle.log_weight,
                               watched.seen[i].count, planning.tables[particle.object].total,
                               particle.upsilon_px2 / (options.reduction * options.reduction)});
  }
  return watched;
}

// All particles' points that would show in a view.
struct ShowingPoints {
  std::vector<ParticlePoint> points;
  std::vector<std::uint32_t> first{0};
};

ShowingPoints showing(const Planning& planning, const Watched& watched,
                      const Se3& camera_from_world, const Camera& map_camera, ThreadPool& pool) {
  std::vector<std::vector<ParticlePoint>> lists(watched.particles.size());
  pool.for_each(lists.size(), [&](std::size_t i) {
    const Particle& particle = *watched.particles[i];
    lists[i] =
        showing_points(planning.tables[particle.object],
                       camera_from_world * particle.world_from_object, map_camera, watched.seen[i]);
  });
  ShowingPoints all;
  for (const std::vector<ParticlePoint>& list : lists) {
    all.points.insert(all.points.end(), list.begin(), list.end());
    all.first.push_back(std::uint32_t(all.points.size()));
  }
  return all;
}

// Eq. 15 with the likelihood of Eq. 20, of every view in `open`.
std::vector<double> mutual_information(const Planning& planning, std::span<const std::size_t> open,
                                       Backend& backend, const NextViewOptions& options) {
  std::vector<double> information(open.size(), 0);
  const Watched watched = watch(planning, backend.threads(), options);
  if (planning.candidates.empty() || !planning.combinations || planning.combinations->rows == 0 ||
      watched.particles.empty())
    return information;
  check(planning.combinations->columns == planning.candidates.size(),
        "view_information: combinations of other candidates");
  const CombinationBits bits{planning.combinations->rows, planning.combinations->columns,
                             planning.combinations->words};
  const Camera map_camera = scaled(planning.camera, 1 / options.reduction);
  const ChamferOptions chamfer{float(options.cap_px / options.reduction)};
  const double sigma_px = options.sigma_px / options.reduction;
  const InformationOptions likelihood{2 * sigma_px * sigma_px, options.use_paper_formula};
  const std::size_t block = views_at_once(planning.candidates.size(), map_camera);
  for (std::size_t first = 0; first < open.size(); first += block) {
    std::vector<Se3> cameras;
    for (std::size_t i = first; i < std::min(first + block, open.size()); ++i)
      cameras.push_back(planning.views[open[i]]);
    const CandidateScene scene =
        draw_candidates(planning.models, planning.candidates, map_camera, cameras, backend,
                        options.visibility, options.tolerance);
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      const ShowingPoints points =
          showing(planning, watched, cameras[i], map_camera, backend.threads());
      if (points.points.empty()) continue;
      ChamferView view = scene.seen_from(i);
      view.points = points.points;
      view.first_point = points.first;
      information[first + i] = backend.mutual_information(
          *backend.combination_chamfer(view, bits, chamfer), watched.beliefs, likelihood);
    }
  }
  return information;
}

// Sec. 6.4: sum over the candidates of psi times the number of points that no real view has seen:
// that project into none of their images.
std::vector<double> disocclusion(const Planning& planning, std::span<const std::size_t> open,
                                 ThreadPool& pool) {
  std::vector<double> gain(open.size(), 0);
  for (const Detection& candidate : planning.candidates) {
    const TemplateTable& table = planning.tables[candidate.object];
    const SeenPoints seen = seen_in(table, candidate.world_from_object, planning.real_views, 0);
    pool.for_each(open.size(), [&](std::size_t i) {
      for (const ParticlePoint& point : showing_points(
               table, planning.views[open[i]] * candidate.world_from_object, planning.camera, seen))
        gain[i] += candidate.psi * point.unseen;
    });
  }
  return gain;
}

std::vector<double> random_values(std::size_t views, std::span<const std::size_t> open,
                                  std::size_t step, std::uint64_t seed) {
  // Every view draws, open or not: which one is taken at a step does not depend on what failed
  // before.
  Random random = Random(seed).split("next view").split(step);
  std::vector<double> all(views);
  for (double& x : all) x = random.uniform();
  std::vector<double> values;
  for (const std::size_t v : open) values.push_back(all[v]);
  return values;
}

std::vector<double> along_sequence(std::size_t views, std::span<const std::size_t> open,
                                   std::span<const int> sequence) {
  std::vector<double> values;
  for (const std::size_t v : open) {
    const auto place = std::ranges::find(sequence, int(v));
    const double rank = sequence.empty() ? double(v) : double(place - sequence.begin());
    values.push_back(1 - rank / double(std::max(views, sequence.size()) + 1));
  }
  return values;
}

// The probability that nothing unknown stands before a camera, one a view.
std::vector<double> free_sights(std::span<const Eigen::Vector3d> directions,
                                const std::optional<Eigen::Vector3d>& above, double exponent) {
  std::vector<double> free;
  for (const Eigen::Vector3d& direction : directions)
    free.push_back(above ? std::pow(std::max(0.0, direction.dot(*above)), exponent) : 1);
  return free;
}

// What of a view no real one has told already.
double unrepeated(const Eigen::Vector3d& direction, std::span<const Eigen::Vector3d> real,
                  double view_correlation_angle_rad) {
  double left = 1;
  for (const Eigen::Vector3d& other : real) {
    const double angle =
        std::acos(std::clamp(direction.dot(other), -1.0, 1.0)) / view_correlation_angle_rad;
    left = std::min(left, 1 - std::exp(-angle * angle));
  }
  return left;
}

// What is left of a view's information where some cannot be seen and some has been told; the same
// of what is unknown.
struct Shares {
  double known = 1, unknown = 1;
};

// One an open view.
std::vector<Shares> shares_left(std::span<const std::size_t> open, const Planning& planning,
                                const NextViewOptions& options) {
  std::vector<Shares> shares(open.size());
  const std::optional<Eigen::Vector3d> center_m = looked_at_m(planning.views);
  if (!center_m) return shares;
  std::vector<Se3> taken;
  for (const RegisterView& view : planning.real_views) taken.push_back(view.camera_from_world);
  const std::vector<Eigen::Vector3d> directions = directions_to(planning.views, *center_m),
                                     real = directions_to(taken, *center_m);
  const std::vector<double> free =
      free_sights(directions, direction_above(directions), options.visibility_exponent);
  for (std::size_t i = 0; i < open.size(); ++i) {
    const auto left = [&](double view_correlation_angle_rad) {
      return free[open[i]] *
             (view_correlation_angle_rad > 0
                  ? unrepeated(directions[open[i]], real, view_correlation_angle_rad)
                  : 1);
    };
    shares[i] = {left(options.view_correlation_angle_rad),
                 left(options.exploration_correlation_angle_rad)};
  }
  return shares;
}

std::vector<double> information_of(const Planning& planning, std::span<const std::size_t> open,
                                   Backend& backend, const NextViewOptions& options) {
  switch (options.strategy) {
    case Strategy::Information:
      return mutual_information(planning, open, backend, options);
    case Strategy::Disocclusion:
      return disocclusion(planning, open, backend.threads());
    case Strategy::Random:
      return random_values(planning.views.size(), open, planning.real_views.size(), options.seed);
    case Strategy::Fixed:
      return along_sequence(planning.views.size(), open, options.sequence);
  }
  throw LogicError("unknown strategy");
}

double motion_cost(const Planning& planning, const Se3& view, const NextViewOptions& options) {
  if (planning.real_views.empty()) return 0;
  const Se3& last = planning.real_views.back().camera_from_world;
  return options.motion_cost_per_m *
             (inverse(view).translation_m - inverse(last).translation_m).norm() +
         options.motion_cost_per_rad * angle_between_rad(view, last);
}

}  // namespace

std::string to_string(Strategy strategy) {
  switch (strategy) {
    case Strategy::Information:
      return "mi-max";
    case Strategy::Disocclusion:
      return "dis";
    case Strategy::Random:
      return "random";
    case Strategy::Fixed:
      return "fixed";
  }
  throw LogicError("unknown strategy");
}

Strategy strategy_from(const std::string& word) {
  for (const Strategy strategy :
       {Strategy::Information, Strategy::Disocclusion, Strategy::Random, Strategy::Fixed})
    if (word == to_string(strategy)) return strategy;
  throw InputError("options", "next_view.strategy", word, "mi-max, dis, random or fixed");
}

void NextViewOptions::validate() const {
  const OptionBounds in("next_view");
  in("reduction", reduction, 1, 16);
  in("cap", cap_px, reduction / CHAMFER_STEPS_PER_PX,
     reduction * CHAMFER_CAP / CHAMFER_STEPS_PER_PX);
  in("sigma", sigma_px, cap_px / std::sqrt(2 * INFORMATION_MAX_SHARPNESS), 1e3);
  in("tolerance", tolerance, 0, 10);
  in("seen", seen_px, 0, EdgeIndex::CELL_PX);
  in("visibility_exponent", visibility_exponent, 0, 100);
  in("view_correlation_angle_rad", view_correlation_angle_rad, 0, 100);
  in("exploration_bonus_nats", exploration_bonus_nats, 0, 1e3);
  in("exploration_correlation_angle_rad", exploration_correlation_angle_rad, 0, 100);
  // The others, and the paper's own formula, do not count in nats.
  const double dearest = strategy == Strategy::Information && !use_paper_formula ? 1e9 : 0;
  in("motion_cost_per_m", motion_cost_per_m, 0, dearest);
  in("motion_cost_per_rad", motion_cost_per_rad, 0, dearest);
  visibility.validate();
}

std::vector<ViewInformation> view_information(const Planning& planning, Backend& backend,
                                              const NextViewOptions& options) {
  options.validate();
  check(planning.tables.size() == planning.models.size(), "view_information: one table an object");
  check(planning.closed.empty() || planning.closed.size() == planning.views.size(),
        "view_information: one mark a view");
  std::vector<ViewInformation> views(planning.views.size());
  std::vector<std::size_t> open;
  for (std::size_t v = 0; v < views.size(); ++v) {
    const bool closed = (!planning.closed.empty() && planning.closed[v]) ||
                        (options.reachable && !options.reachable(int(v)));
    if (!closed) open.push_back(v);
  }
  if (open.empty()) return views;
  const std::vector<double> information = information_of(planning, open, backend, options);
  const bool in_nats = options.strategy == Strategy::Information && !options.use_paper_formula;
  const std::vector<Shares> shares =
      in_nats ? shares_left(open, planning, options) : std::vector<Shares>(open.size());
  const double exploration_bonus_nats = in_nats ? options.exploration_bonus_nats : 0;
  for (std::size_t i = 0; i < open.size(); ++i)
    views[open[i]] = {true, shares[i].known * information[i], shares[i].known,
                      exploration_bonus_nats * shares[i].unknown,
                      motion_cost(planning, planning.views[open[i]], options)};
  if (std::ranges::none_of(information, [](double x) { return x > 0; }))
    log(LogLevel::Warning,
        "no view promises any information: nothing is known that it could be about, or no view "
        "sees it");
  return views;
}

std::optional<int> best_view(std::span<const ViewInformation> views) {
  const auto rank = [&](int v) { return std::pair(views[v].value(), views[v].share); };
  std::optional<int> best;
  for (int v = 0; v < int(views.size()); ++v)
    if (views[v].open && (!best || rank(v) > rank(*best))) best = v;
  return best;
}

}  // namespace edgescout
