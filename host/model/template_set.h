// The templates of an object: the visible edge points of every viewpoint.
//
// In-plane rotation and image position need no templates of their own: they turn the camera, which
// does not change the visible points. Detection applies them relative to the viewing ray, not to
// the image plane, so the perspective at the image's border is right.
//
// Public header.
#pragma once

#include <cmath>
#include <filesystem>
#include <functional>
#include <vector>

#include "host/model/edge_model.h"
#include "host/model/viewpoints.h"
#include "host/model/visible_edges.h"

namespace edgescout {

struct TemplateOptions {
  int frequency = 5;        // of the icosphere: 10 f^2 + 2 viewpoints, about 60 / f degrees apart
  SphereRange range;        // of viewpoints, in the object frame
  int in_plane_steps = 24;  // rotations about the line of sight, over a full turn
  // From the camera to the object's centre. 0: from the object's size and the camera.
  double distance_min_m = 0;
  double distance_max_m = 0;
  double distance_ratio = 1.1;  // between neighbouring distances
  EdgeModelOptions edges;
  void validate() const;  // InputError naming the field and the violated bound
};

void describe(TemplateOptions& options, OptionVisitor& visit);

// Returns the options with distances that were 0 set: from where the object's diameter spans the
// image's larger side to where it spans a twentieth of it, 20 : 1 in four scales. InputError: an
// object so large, as one of a wrong unit, that they are beyond what an option may say.
TemplateOptions with_default_distances(TemplateOptions options, double diameter_m,
                                       const Camera& camera);

// Checks the distances. InputError naming the object: the nearest distance is more than a thousand
// times its diameter, as where one of them is in millimetres.
void require_distances_of_size(const std::string& name, double diameter_m,
                               const TemplateOptions& options);

// From a camera to an object's centre.
struct DistanceRange {
  double min_m = 0, max_m = 0;
  double middle_m() const { return std::sqrt(min_m * max_m); }
};

// Returns the scales of the options' distances, nearest first: parts of an equal ratio of at most
// 2.5 : 1. Each is searched on a tensor that is reduced to suit the object's size there.
std::vector<DistanceRange> distance_scales(const TemplateOptions& options);
// Returns the distances of the templates of one scale: both ends and, ascending, what lies at most
// options.distance_ratio apart between them.
std::vector<double> template_distances_m(const TemplateOptions& options,
                                         const DistanceRange& scale);
// Returns those of all scales, one after the other.
std::vector<double> template_distances_m(const TemplateOptions& options);

struct TemplateView {
  Eigen::Quaterniond camera_from_object;  // looking at the object's centre
  std::vector<ModelPoint> points;         // visible from there, object frame
};

struct TemplateSet {
  int object_id = 1;
  Symmetries symmetries;
  TemplateOptions options;
  EdgeModel model;
  std::vector<TemplateView> views;
};

// Builds the templates of an object. Calls `progress` with (views done, all views) from this
// thread. InputError: options out of bounds, distances that require_distances_of_size refuses, no
// viewpoint that shows an edge. LogicError: distances that are not set.
TemplateSet build_templates(const Object& object, const TemplateOptions& options, Backend& backend,
                            const std::function<void(int, int)>& progress = {});

// Returns the set of an object that is registered or followed from given poses: it has no views, so
// it cannot be searched for. InputError: the mesh shows no edge from anywhere.
TemplateSet without_views(const Object& object);

// Writes or reads one file: magic, version, length, checksum, payload. It holds the mesh, so a set
// needs no other file. Saving is atomic. Loading throws InputError naming the file: cut short, of
// another version, with a wrong checksum, or no template file.
void save_templates(const TemplateSet& set, const std::filesystem::path& file);
TemplateSet load_templates(const std::filesystem::path& file);
// Returns whether the start of a file is that of a template file; false where it cannot be read.
bool is_template_file(const std::filesystem::path& file);

}  // namespace edgescout
