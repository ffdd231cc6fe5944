// Makes one whole decision on the next view, as a scout does, on a rendered bin. Benchmarks time
// it.
#pragma once

#include "host/active/next_view.h"
#include "host/experiments/bin.h"

namespace edgescout {

struct DecisionSize {
  int views = 32, candidates = 40, particles = 200, combinations = 1000;  // the paper's
};

// The input of a decision: several candidates of each of a bin's parts, some millimetres off, as
// after a first image, and particles around them. The image of 1024x768 was taken from one more
// view, the first. It has no edges: points of particles count as seen if they project into it.
struct DecisionWork {
  std::vector<EdgeModel> models;
  std::vector<TemplateTable> tables;
  Camera camera{1024, 768, 1000, 1000, 511.5, 383.5, {}};
  std::vector<Se3> views;  // camera_from_world; the first was taken
  std::vector<char> closed;
  std::vector<ObjectView> real_views;
  std::vector<Detection> candidates;
  std::vector<Particle> particles;
  DecisionSize size;
};

// The bin of the full experiments on which decisions are timed.
Bin decision_bin(ThreadPool& pool);
// `bin` must hold the project's own parts.
DecisionWork make_decision_work(const Bin& bin, const DecisionSize& size, Backend& backend);

// Finds the candidates that exclude each other, samples combinations, draws visible edges, surfaces
// and maps of every candidate in every view, and computes the information. Returns the best view.
int decide(const DecisionWork& work, Backend& backend);

}  // namespace edgescout
