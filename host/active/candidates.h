// The object candidates of an active detection: found in single images, refined over all of them
// (paper, Algorithm 2, lines 2 and 3).
#pragma once

#include <span>
#include <vector>

#include "host/active/particles.h"
#include "host/detect/detect.h"

namespace edgescout {

// Of all objects, in the world; the most probable first. Without the instances that are known. The
// images have been scanned for the objects (Observation::hits); the last one is new: what several
// of them say is registered in it and in those that help it (detect/support_views.h).
std::vector<Detection> candidates_in_images(std::span<const TemplateSet> sets,
                                            std::span<const Observation> images,
                                            std::span<const ObjectPose> known, Backend& backend,
                                            const DetectOptions& options);

// Registers candidates over all views (Eq. 11), gives them the probability that the views' features
// together amount to (detect/probability_over_views.h), drops those that lie on no edge at all and
// duplicates; of the rest best_non_colliding, most probable first.
std::vector<Detection> refined_candidates(std::span<const TemplateSet> sets,
                                          std::span<const EdgeModel> models,
                                          std::span<const Detection> candidates,
                                          std::span<const RegisterView> views, std::size_t most,
                                          Backend& backend, const DetectOptions& options);

// The `most` with the best chance to be there *beside* the others (exclusive_probabilities,
// detect/plausible_pairs.h, none being surer than 98 %), in the order given. Many wrong poses lie
// in and across an instance that is there, on its edges and its neighbours', and their views make
// each as good as certain: by probability alone they leave no place for another instance, which has
// nobody in its way.
std::vector<Detection> best_non_colliding(const std::vector<Detection>& candidates,
                                          std::size_t most, std::span<const EdgeModel> models,
                                          double penetration_m, ThreadPool& pool);

// Those that may be instances of which no particle knows: at least `min_probability`, and no
// particle within `radius` of the object's diameter (modulo symmetry).
std::vector<Detection> without_particles(std::span<const Detection> candidates,
                                         std::span<const Particle> particles,
                                         std::span<const TemplateSet> sets, double radius,
                                         double min_probability);

// Of those how many lie near no candidate there was before, within the same radius.
std::size_t count_new(std::span<const Detection> candidates, std::span<const Detection> before,
                      std::span<const TemplateSet> sets, double radius);

}  // namespace edgescout
