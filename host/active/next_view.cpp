#include "host/active/next_view.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "host/active/candidate_scene.h"
#include "host/active/measured_surface.h"
#include "host/active/seen_points.h"
#include "host/active/views.h"
#include "host/core/log.h"
#include "kernels/error.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

// How many views' maps are made at once: enough to keep every thread and device busy, few enough
// for the memory, 8 bytes per pixel, even if every candidate were as large as the image.
std::size_t views_per_block(std::size_t candidates, const Camera& map_camera) {
  constexpr std::size_t maps = 2048, pixels = std::size_t(1) << 27;
  const std::size_t image = std::size_t(map_camera.width) * std::size_t(map_camera.height);
  return std::max<std::size_t>(1, std::min(maps, pixels / image) / candidates);
}

// How many views come next: all that fit in memory or, where the scene's limit is asked between two
// blocks, as many as take a tenth of a second.
class BlockSize {
 public:
  BlockSize(std::size_t most, const Scene& scene)
      : most_(most), is_limited_(scene.limit && scene.limit->is_set()), views_(most) {
    if (is_limited_) views_ = std::min(most, std::size_t(scene.backend.threads().threads()));
  }

  std::size_t views() const { return views_; }

  // So many views are done since the last call.
  void done(std::size_t views) {
    if (!is_limited_) return;
    constexpr double block_s = 0.1;
    const Clock::time_point now = Clock::now();
    const std::chrono::duration<double> elapsed = now - std::exchange(since_, now);
    const double fitting = double(views) * block_s / std::max(elapsed.count(), 1e-6);
    views_ = std::clamp<std::size_t>(std::size_t(std::min(fitting, double(most_))), 1, most_);
  }

 private:
  using Clock = TimeLimit::Clock;

  std::size_t most_;
  bool is_limited_;
  std::size_t views_;
  Clock::time_point since_ = Clock::now();
};

// The particles that have a weight, and which of their points real views have seen.
struct WeightedParticles {
  std::vector<const Particle*> particles;
  std::vector<SeenPoints> seen;
  std::vector<ParticleBelief> beliefs;  // for the kernel
};

WeightedParticles weighted_particles(const NextViewProblem& problem,
                                     const NextViewOptions& options) {
  WeightedParticles weighted;
  for (const Particle& particle : problem.particles)
    if (particle.log_weight > -std::numeric_limits<double>::infinity())
      weighted.particles.push_back(&particle);
  // In the paper's own formula a point was seen if it projects into an image, and the real views
  // count in Upsilon alone.
  const double seen_px = options.use_paper_formula ? 0 : options.seen_px;
  weighted.seen.resize(weighted.particles.size());
  problem.scene.backend.threads().for_each(weighted.particles.size(), [&](std::size_t i) {
    const Particle& particle = *weighted.particles[i];
    weighted.seen[i] = points_seen_in(problem.scene.views, problem.tables[particle.object],
                                      particle.world_from_object, seen_px);
  });
  for (std::size_t i = 0; i < weighted.particles.size(); ++i) {
    const Particle& particle = *weighted.particles[i];
    weighted.beliefs.push_back({options.use_paper_formula ? 0 : particle.log_weight,
                                weighted.seen[i].count, problem.tables[particle.object].total,
                                particle.upsilon_px2 / (options.reduction * options.reduction)});
  }
  return weighted;
}

// Points of all particles that would project into one view.
struct ParticlePoints {
  std::vector<ParticlePoint> points;
  std::vector<std::uint32_t> first{0};  // of each particle, and the end
};

// Removes the points behind what was measured.
void remove_hidden(std::vector<ParticlePoint>& points, const Occluders& measured,
                   double tolerance_m) {
  std::erase_if(points, [&](const ParticlePoint& point) {
    const Eigen::Vector3d ray = ray_through(measured.camera, {point.x_px, point.y_px});
    return measured.hide(double(point.z_m) * ray, tolerance_m);
  });
}

// `measured`: null where nothing was.
ParticlePoints particle_points(const NextViewProblem& problem, const WeightedParticles& weighted,
                               const Se3& camera_from_world, const Camera& map_camera,
                               const Occluders* measured, double tolerance) {
  ParticlePoints all;
  for (std::size_t i = 0; i < weighted.particles.size(); ++i) {
    const Particle& particle = *weighted.particles[i];
    std::vector<ParticlePoint> points = points_in_image(
        problem.tables[particle.object], camera_from_world * particle.world_from_object, map_camera,
        weighted.seen[i]);
    if (measured)
      remove_hidden(points, *measured,
                    tolerance * problem.scene.models[particle.object].mesh.diameter_m);
    all.points.insert(all.points.end(), points.begin(), points.end());
    all.first.push_back(std::uint32_t(all.points.size()));
  }
  return all;
}

// Eq. 15 with the likelihood of Eq. 20, for possible views in blocks.
class MutualInformation {
 public:
  MutualInformation(const NextViewProblem& problem, const WeightedParticles& weighted,
                    const NextViewOptions& options)
      : problem_(problem),
        weighted_(weighted),
        options_(options),
        map_camera_(scaled(problem.camera, 1 / options.reduction)) {}

  std::size_t block_size() const {
    return views_per_block(problem_.candidates.size(), map_camera_);
  }
  // Of cameras whose maps fit in memory at once.
  std::vector<double> of_block(std::span<const Se3> camera_from_world) const;

 private:
  const NextViewProblem& problem_;
  const WeightedParticles& weighted_;
  const NextViewOptions& options_;
  Camera map_camera_;
};

std::vector<double> MutualInformation::of_block(std::span<const Se3> camera_from_world) const {
  Backend& backend = problem_.scene.backend;
  const BitMatrix& combinations = *problem_.combinations;
  const CombinationBits bits{combinations.rows, combinations.columns, combinations.words};
  const ChamferOptions chamfer{float(options_.cap_px / options_.reduction)};
  const double sigma_px = options_.sigma_px / options_.reduction;
  const InformationOptions likelihood{2 * sigma_px * sigma_px, options_.use_paper_formula};
  const std::vector<Occluders> measured =
      measured_surfaces(problem_.scene.views, map_camera_, camera_from_world, backend);
  const CandidateScene candidates =
      draw_candidates(problem_.scene.models, problem_.candidates, map_camera_, camera_from_world,
                      backend, {options_.visibility, options_.tolerance, measured});
  std::vector<ParticlePoints> points(camera_from_world.size());
  backend.threads().for_each(points.size(), [&](std::size_t i) {
    points[i] = particle_points(problem_, weighted_, camera_from_world[i], map_camera_,
                                measured.empty() ? nullptr : &measured[i], options_.tolerance);
  });
  std::vector<std::size_t> seeing;  // views into which some point projects
  std::vector<ChamferView> views;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].points.empty()) continue;
    seeing.push_back(i);
    ChamferView& view = views.emplace_back(candidates.chamfer_view(i));
    view.points = points[i].points;
    view.first_point = points[i].first;
  }
  const std::vector<double> nats =
      backend.view_information(views, bits, chamfer, weighted_.beliefs, likelihood);
  std::vector<double> information(camera_from_world.size(), 0);
  for (std::size_t k = 0; k < seeing.size(); ++k) information[seeing[k]] = nats[k];
  return information;
}

// Of the views of `open`: camera_from_world.
std::vector<Se3> cameras_of(const NextViewProblem& problem, std::span<const std::size_t> open) {
  std::vector<Se3> cameras;
  for (const std::size_t view : open) cameras.push_back(problem.possible_views[view]);
  return cameras;
}

// One per view of `open`.
std::vector<double> mutual_information(const NextViewProblem& problem,
                                       std::span<const std::size_t> open,
                                       const NextViewOptions& options) {
  std::vector<double> information(open.size(), 0);
  const WeightedParticles weighted = weighted_particles(problem, options);
  if (problem.candidates.empty() || !problem.combinations || problem.combinations->rows == 0 ||
      weighted.particles.empty())
    return information;
  check(problem.combinations->columns == problem.candidates.size(),
        "view_information: combinations of other candidates");
  const MutualInformation mutual(problem, weighted, options);
  const std::vector<Se3> cameras = cameras_of(problem, open);
  BlockSize block(mutual.block_size(), problem.scene);
  for (std::size_t first = 0; first < open.size() && !problem.scene.is_time_over();) {
    const std::size_t count = std::min(block.views(), open.size() - first);
    std::ranges::copy(mutual.of_block(std::span(cameras).subspan(first, count)),
                      information.begin() + static_cast<std::ptrdiff_t>(first));
    first += count;
    block.done(count);
  }
  return information;
}

// Sec. 6.4: sum over the candidates of psi times the number of points that no real view has seen:
// points that project into none of the images.
std::vector<double> disocclusion(const NextViewProblem& problem,
                                 std::span<const std::size_t> open) {
  std::vector<double> gain(open.size(), 0);
  for (const Detection& candidate : problem.candidates) {
    const TemplateTable& table = problem.tables[candidate.object];
    const SeenPoints seen =
        points_seen_in(problem.scene.views, table, candidate.world_from_object, 0);
    problem.scene.backend.threads().for_each(open.size(), [&](std::size_t i) {
      for (const ParticlePoint& point :
           points_in_image(table, problem.possible_views[open[i]] * candidate.world_from_object,
                           problem.camera, seen))
        gain[i] += candidate.psi * point.unseen;
    });
  }
  return gain;
}

std::vector<double> random_values(std::size_t views, std::span<const std::size_t> open,
                                  std::size_t step, std::uint64_t seed) {
  // Every view gets a number, open or not: then the choice at a step does not depend on which views
  // failed before.
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

// The probability that nothing unknown hides the scene from a camera, one per view.
std::vector<double> free_line_of_sight(std::span<const Eigen::Vector3d> directions,
                                       const std::optional<Eigen::Vector3d>& above,
                                       double exponent) {
  std::vector<double> free;
  for (const Eigen::Vector3d& direction : directions)
    free.push_back(above ? std::pow(std::max(0.0, direction.dot(*above)), exponent) : 1);
  return free;
}

// The fraction of a view's information that no real view has given already.
double independent_share(const Eigen::Vector3d& direction, std::span<const Eigen::Vector3d> real,
                         double correlation_angle_rad) {
  if (!(correlation_angle_rad > 0)) return 1;
  double share = 1;
  for (const Eigen::Vector3d& other : real) {
    const double angle =
        std::acos(std::clamp(direction.dot(other), -1.0, 1.0)) / correlation_angle_rad;
    share = std::min(share, 1 - std::exp(-angle * angle));
  }
  return share;
}

double smallest_box_m3(std::span<const EdgeModel> models) {
  double smallest_m3 = INFINITY;
  for (const EdgeModel& model : models)
    smallest_m3 =
        std::min(smallest_m3, double((model.mesh.box_max_m - model.mesh.box_min_m).prod()));
  return smallest_m3;
}

// v / (v + o) of NextViewOptions::exploration_correlation_angle_rad, one per open view. Empty where
// no real view has depth or the workspace is not known.
std::vector<double> unmeasured_shares(const NextViewProblem& problem,
                                      std::span<const std::size_t> open,
                                      const NextViewOptions& options) {
  constexpr std::size_t block = 256;  // views whose surfaces are in memory at once
  const std::span<const ObjectView> real = problem.scene.views;
  if (!problem.workspace || std::ranges::none_of(real, has_measured_depth)) return {};
  Backend& backend = problem.scene.backend;
  const Camera map_camera = scaled(problem.camera, 0.5 / options.reduction);
  const UnmeasuredSpace space = unmeasured_space(real, *problem.workspace, backend.threads());
  const double object_m3 = smallest_box_m3(problem.scene.models);
  std::vector<double> shares(open.size());
  const std::vector<Se3> cameras = cameras_of(problem, open);
  for (std::size_t first = 0; first < cameras.size(); first += block) {
    const auto some = std::span(cameras).subspan(first, std::min(block, cameras.size() - first));
    const std::vector<Occluders> surfaces = measured_surfaces(real, map_camera, some, backend);
    backend.threads().for_each(some.size(), [&](std::size_t i) {
      const double volume_m3 = volume_seen_m3(space, surfaces[i], some[i]);
      if (volume_m3 > 0) shares[first + i] = volume_m3 / (volume_m3 + object_m3);
    });
  }
  return shares;
}

// The fraction of a view's information that remains after visibility and correlation: of that about
// candidates, and of the exploration bonus.
struct Shares {
  double candidates = 1, exploration = 1;
};

// One per open view.
std::vector<Shares> remaining_shares(const NextViewProblem& problem,
                                     std::span<const std::size_t> open,
                                     const NextViewOptions& options) {
  std::vector<Shares> shares(open.size());
  const std::optional<Eigen::Vector3d> center_m = looked_at_m(problem.possible_views);
  if (!center_m) return shares;
  std::vector<Se3> taken;
  for (const ObjectView& view : problem.scene.views) taken.push_back(view.camera_from_world);
  const std::vector<Eigen::Vector3d> directions = directions_to(problem.possible_views, *center_m),
                                     real = directions_to(taken, *center_m);
  const std::vector<double> free =
      free_line_of_sight(directions, direction_above(directions), options.visibility_exponent);
  const std::vector<double> unmeasured = unmeasured_shares(problem, open, options);
  for (std::size_t i = 0; i < open.size(); ++i) {
    const auto independent = [&](double correlation_angle_rad) {
      return independent_share(directions[open[i]], real, correlation_angle_rad);
    };
    shares[i].candidates = free[open[i]] * independent(options.view_correlation_angle_rad);
    shares[i].exploration = free[open[i]] * independent(options.exploration_correlation_angle_rad) *
                            (unmeasured.empty() ? 1 : unmeasured[i]);
  }
  return shares;
}

// One per open view, before shares, bonus and motion.
std::vector<double> strategy_values(const NextViewProblem& problem,
                                    std::span<const std::size_t> open,
                                    const NextViewOptions& options) {
  const std::size_t views = problem.possible_views.size();
  switch (options.strategy) {
    case Strategy::Information:
      return mutual_information(problem, open, options);
    case Strategy::Disocclusion:
      return disocclusion(problem, open);
    case Strategy::Random:
      return random_values(views, open, problem.scene.views.size(), options.seed);
    case Strategy::Fixed:
      return along_sequence(views, open, options.sequence);
  }
  throw LogicError("unknown strategy");
}

double motion_cost(const NextViewProblem& problem, const Se3& view,
                   const NextViewOptions& options) {
  if (problem.scene.views.empty()) return 0;
  const Se3& last = problem.scene.views.back().camera_from_world;
  return options.motion_cost_per_m *
             (inverse(view).translation_m - inverse(last).translation_m).norm() +
         options.motion_cost_per_rad * angle_between_rad(view, last);
}

std::vector<std::size_t> open_views(const NextViewProblem& problem,
                                    const NextViewOptions& options) {
  std::vector<std::size_t> open;
  for (std::size_t v = 0; v < problem.possible_views.size(); ++v) {
    const bool closed = (!problem.closed.empty() && problem.closed[v]) ||
                        (options.reachable && !options.reachable(int(v)));
    if (!closed) open.push_back(v);
  }
  return open;
}

}  // namespace

std::vector<ViewInformation> view_information(const NextViewProblem& problem,
                                              const NextViewOptions& options) {
  options.validate();
  check(problem.tables.size() == problem.scene.models.size(),
        "view_information: one table an object");
  check(problem.closed.empty() || problem.closed.size() == problem.possible_views.size(),
        "view_information: one mark a view");
  std::vector<ViewInformation> views(problem.possible_views.size());
  const std::vector<std::size_t> open = open_views(problem, options);
  if (open.empty()) return views;
  const std::vector<double> information = strategy_values(problem, open, options);
  const bool in_nats = is_in_nats(options);
  const std::vector<Shares> shares =
      in_nats ? remaining_shares(problem, open, options) : std::vector<Shares>(open.size());
  const double bonus_nats = in_nats ? options.exploration_bonus_nats : 0;
  for (std::size_t i = 0; i < open.size(); ++i)
    views[open[i]] = {true, shares[i].candidates * information[i], shares[i].candidates,
                      bonus_nats * shares[i].exploration,
                      motion_cost(problem, problem.possible_views[open[i]], options)};
  if (!problem.scene.is_time_over() &&
      std::ranges::none_of(information, [](double x) { return x > 0; }))
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
