// Images with known poses, rendered or from files: what every experiment is judged on.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "host/core/types.h"
#include "host/edge/edges.h"
#include "host/register/d2co.h"
#include "host/render/scene.h"

namespace edgescout {

class ThreadPool;

struct KnownImage {
  Image image;    // undistorted
  Camera camera;  // ideal
  Se3 camera_from_world;
};

struct KnownInstance {
  std::string name;  // unlike that of any other instance of the scene
  int object = 0;    // index into the scene's objects
  Se3 world_from_object;
  double visible = 1;  // of its silhouette, in the first image; 1 where nobody knows
};

struct KnownScene {
  std::string set;              // "rendered", "d2co-starts" ..
  std::string name;             // of the scene within the set
  std::vector<Object> objects;  // the types that are looked for
  std::vector<KnownImage> images;
  std::vector<KnownInstance> instances;  // in the first image
};

// Less than this is visible: an instance takes no part.
inline constexpr double LEAST_VISIBLE = 0.1;
// More than this is visible: lightly occluded; else highly (the paper's 30 %).
inline constexpr double LIGHTLY_OCCLUDED = 0.7;

// The five types of the rendered scenes: (a) to (e), as in the paper's figures.
std::vector<Object> rendered_types();
KnownScene rendered_scene(const std::string& name, const std::vector<Object>& types,
                          const RenderOptions& options, ThreadPool& pool);

// A BOP scene's image, or several of them as one scene. Types: the meshes named obj_NNNNNN.ply
// under `models`, with the symmetries of its models_info.json. InputError naming the missing file.
KnownScene bop_scene(const std::string& set, const std::filesystem::path& scene_folder,
                     const std::filesystem::path& models, const std::vector<int>& image_ids);

// Edge points of every image, as found once for all tensors.
using SceneEdges = std::vector<std::vector<EdgePoint>>;
SceneEdges edges_of(const KnownScene& scene, Backend& backend,
                    EdgeMethod method = EdgeMethod::Gradient);

// What registration asks of the images, one view each: edges, tensors, the image itself.
std::vector<RegisterView> register_views(const KnownScene& scene, const SceneEdges& edges,
                                         const TensorOptions& tensor, Backend& backend);

}  // namespace edgescout
