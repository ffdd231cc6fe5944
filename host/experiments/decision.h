// One whole decision where to look next, as a scout makes it, on a rendered bin: what benchmarks
// time.
#pragma once

#include "host/active/next_view.h"
#include "host/experiments/bin.h"

namespace edgescout {

struct DecisionSize {
  int views = 32, candidates = 40, particles = 200, combinations = 1000;  // the paper's
};

// A bin's parts, each as several candidates some millimetres off, as a first image leaves them, and
// particles around them; an image of 1024x768 was taken from a view beside those that are judged.
// Of that image there is no edge: particles' points count as seen where they project into it.
struct DecisionWork {
  std::vector<EdgeModel> models;
  std::vector<TemplateTable> tables;
  Camera camera{1024, 768, 1000, 1000, 511.5, 383.5, {}};
  std::vector<Se3> views;  // the first one was taken
  std::vector<char> closed;
  std::vector<RegisterView> real;
  std::vector<Detection> candidates;
  std::vector<Particle> particles;
  DecisionSize size;
};

// Of the full experiments, the one that decisions are timed on.
Bin decision_bin(ThreadPool& pool);
// `bin` holds the project's own parts.
DecisionWork make_decision_work(const Bin& bin, const DecisionSize& size, Backend& backend);

// Which candidates exclude each other, scenes, visible edges and surfaces of every candidate in
// every view, their maps, information: the view of most.
int decide(const DecisionWork& work, Backend& backend);

}  // namespace edgescout
