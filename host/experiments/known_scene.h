// Images with known poses, rendered or from files: the ground truth of every experiment.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "host/core/types.h"
#include "host/edge/edges.h"
#include "host/register/object_view.h"
#include "host/render/scene.h"

namespace edgescout {

class ThreadPool;

struct KnownImage {
  Image image;    // undistorted
  Camera camera;  // ideal
  Se3 camera_from_world;
};

struct KnownInstance {
  std::string name;  // unique in the scene
  int object = 0;    // index into the scene's objects
  Se3 world_from_object;
  double visible = 1;  // fraction of its silhouette, in the first image; 1 if unknown
};

struct KnownScene {
  std::string set;              // "rendered", "d2co-starts" ..
  std::string name;             // of the scene in the set
  std::vector<Object> objects;  // the types to detect
  std::vector<KnownImage> images;
  std::vector<KnownInstance> instances;  // in the first image
};

// An instance with a smaller visible fraction is ignored.
inline constexpr double LEAST_VISIBLE = 0.1;
// An instance with a larger visible fraction is lightly occluded, else highly (the paper's 30 %).
inline constexpr double LIGHTLY_OCCLUDED = 0.7;

// The five types of the rendered scenes: (a) to (e), as in the paper's figures.
std::vector<Object> rendered_types();
KnownScene rendered_scene(const std::string& name, const std::vector<Object>& types,
                          const RenderOptions& options, ThreadPool& pool);

// Loads one image of a BOP scene, or several images as one scene. The types are the meshes
// obj_NNNNNN.ply in `models`, with the symmetries of its models_info.json. InputError naming the
// missing file.
KnownScene bop_scene(const std::string& set, const std::filesystem::path& scene_folder,
                     const std::filesystem::path& models, const std::vector<int>& image_ids);

// Edge points of every image. They are detected once and serve all tensors.
using SceneEdges = std::vector<std::vector<EdgePoint>>;
SceneEdges edges_of(const KnownScene& scene, Backend& backend,
                    EdgeMethod method = EdgeMethod::Gradient);

// Makes one view per image: with the edges, the tensors and the image itself.
std::vector<ObjectView> register_views(const KnownScene& scene, const SceneEdges& edges,
                                       const TensorOptions& tensor, Backend& backend);

}  // namespace edgescout
