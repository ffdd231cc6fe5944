// The object candidates of an active detection: found in single images, refined over all of them
// (paper, Algorithm 2, lines 2 and 3).
#pragma once

#include <span>
#include <vector>

#include "host/active/particles.h"
#include "host/detect/detect_options.h"
#include "host/detect/scanned_view.h"

namespace edgescout {

// Candidates of all objects, in the world, most probable first, without the instances in `known`.
// The last image is the new one: hits of all images are registered in it and in its support views
// (detect/support_views.h). LogicError: an image that was not scanned (scan_once).
std::vector<Detection> candidates_in_images(std::span<const TemplateSet> sets,
                                            std::span<const ScannedView> images,
                                            std::span<const ObjectPose> known, Backend& backend,
                                            const DetectOptions& options,
                                            const TimeLimit* limit = nullptr);

// Registers candidates over all views of the scene (Eq. 11) and gives them the probability that
// follows from all views (register/pose_classifier.h). Drops those that lie on no edge at all,
// those that measured depth contradicts (is_contradicted), so that no combination has them, those
// that options.scan.world excludes by more than SAME_POSE, and duplicates. Keeps the
// best_non_colliding of the rest, most probable first.
std::vector<Detection> refined_candidates(const Scene& scene, std::span<const TemplateSet> sets,
                                          std::span<const Detection> candidates, std::size_t most,
                                          const DetectOptions& options);

// The `most` candidates with the best chance to exist *next to* the others, in the order given: by
// exclusive_probabilities (detect/plausible_pairs.h), with no probability above 98 %. Many wrong
// poses lie in and across an instance that exists, on its edges and those of its neighbours, and
// the views make each of them nearly certain. By probability alone they would leave no place for
// another instance that collides with nothing.
std::vector<Detection> best_non_colliding(const std::vector<Detection>& candidates,
                                          std::size_t most, std::span<const EdgeModel> models,
                                          double penetration_m, ThreadPool& pool);

// Candidates that may be instances without a particle: their probability is at least
// `min_probability`, and no particle lies within `radius` times the object's diameter (modulo
// symmetry).
std::vector<Detection> without_particles(std::span<const Detection> candidates,
                                         std::span<const Particle> particles,
                                         std::span<const TemplateSet> sets, double radius,
                                         double min_probability);

// How many of the candidates lie near no candidate of `before`, within the same radius.
std::size_t count_new(std::span<const Detection> candidates, std::span<const Detection> before,
                      std::span<const TemplateSet> sets, double radius);

}  // namespace edgescout
