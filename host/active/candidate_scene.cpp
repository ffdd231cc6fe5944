#include "host/active/candidate_scene.h"

#include <algorithm>

#include "host/core/thinned.h"
#include "host/register/d2co.h"
#include "kernels/error.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

struct Box {
  float x_min = 0, y_min = 0, x_max = 0, y_max = 0;
};

// The part of the map that contains the mesh's projected bounding box. False where the bounding box
// reaches behind the camera.
bool projected_box(const Mesh& mesh, const Se3& camera_from_object, const Camera& camera,
                   Box& box) {
  box = {1e9f, 1e9f, -1e9f, -1e9f};
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d corner(i & 1 ? mesh.box_max_m.x() : mesh.box_min_m.x(),
                                 i & 2 ? mesh.box_max_m.y() : mesh.box_min_m.y(),
                                 i & 4 ? mesh.box_max_m.z() : mesh.box_min_m.z());
    const Eigen::Vector3d x = camera_from_object * corner;
    if (x.z() <= DEPTH_NEAR_M) return false;
    const Eigen::Vector2f p = project(camera, x).cast<float>();
    box = {std::min(box.x_min, p.x()), std::min(box.y_min, p.y()), std::max(box.x_max, p.x()),
           std::max(box.y_max, p.y())};
  }
  return true;
}

std::vector<MapEdge> projected(std::span<const ModelPoint> points, const Se3& camera_from_object,
                               const Camera& camera) {
  std::vector<MapEdge> edges;
  for (const ModelPoint& point : points) {
    const Eigen::Vector3d x = camera_from_object * Eigen::Vector3d(point.x_m, point.y_m, point.z_m);
    if (x.z() <= DEPTH_NEAR_M) continue;
    const Eigen::Vector2d p = project(camera, x);
    edges.push_back({float(p.x()), float(p.y()), float(x.z())});
  }
  return edges;
}

// The maps of one object's candidates: indices into CandidateScene::maps and the poses to draw.
struct ObjectMaps {
  std::vector<std::size_t> maps;
  std::vector<Se3> camera_from_object;
};

std::vector<ObjectMaps> maps_by_object(std::size_t objects, std::span<const Detection> candidates,
                                       std::span<const Se3> camera_from_world) {
  std::vector<ObjectMaps> by_object(objects);
  for (std::size_t v = 0; v < camera_from_world.size(); ++v)
    for (std::size_t c = 0; c < candidates.size(); ++c) {
      ObjectMaps& own = by_object[candidates[c].object];
      own.maps.push_back(v * candidates.size() + c);
      own.camera_from_object.push_back(camera_from_world[v] * candidates[c].world_from_object);
    }
  return by_object;
}

// Draws candidates into a CandidateScene, one object after the other.
class CandidatePainter {
 public:
  CandidatePainter(CandidateScene& scene, const Camera& camera, Backend& backend)
      : scene_(scene), camera_(camera), backend_(backend), edges_(scene.maps.size()) {}

  void project_edges(const EdgeModel& model, const ObjectMaps& own,
                     const CandidateSceneOptions& options);
  // Between the two: gives every map its place in the lists.
  void arrange();
  void draw_surfaces(const EdgeModel& model, const ObjectMaps& own);

 private:
  std::vector<DepthJob> depth_jobs(const ObjectMaps& own, std::span<const std::size_t> drawn) const;

  CandidateScene& scene_;
  const Camera& camera_;
  Backend& backend_;
  std::vector<std::vector<MapEdge>> edges_;  // by map
};

// Sets the window of every map of the object.
void CandidatePainter::project_edges(const EdgeModel& model, const ObjectMaps& own,
                                     const CandidateSceneOptions& options) {
  std::vector<std::vector<ModelPoint>> visible =
      visible_edges(model, own.camera_from_object, backend_, options.visibility);
  backend_.threads().for_each(own.maps.size(), [&](std::size_t i) {
    Box box;
    if (!projected_box(model.mesh, own.camera_from_object[i], camera_, box)) return;
    if (!options.measured.empty())
      remove_hidden(visible[i], options.measured[own.maps[i] / scene_.candidates],
                    own.camera_from_object[i], options.tolerance * model.mesh.diameter_m);
    // The points are ordered by kind: creases, borders, contours. Thinning keeps some of each.
    if (visible[i].size() > CANDIDATE_MAP_MAX_EDGES)
      visible[i] = thinned(visible[i], int(CANDIDATE_MAP_MAX_EDGES));
    edges_[own.maps[i]] = projected(visible[i], own.camera_from_object[i], camera_);
    scene_.maps[own.maps[i]].window =
        map_window(box.x_min, box.y_min, box.x_max, box.y_max, camera_.width, camera_.height);
  });
}

void CandidatePainter::arrange() {
  std::size_t pixels = 0;
  for (std::size_t m = 0; m < scene_.maps.size(); ++m) {
    scene_.maps[m].first_pixel = std::uint32_t(pixels);
    pixels += scene_.maps[m].window.size();
    scene_.maps[m].first_edge = std::uint32_t(scene_.edges.size());
    scene_.maps[m].edge_count = std::uint32_t(edges_[m].size());
    scene_.edges.insert(scene_.edges.end(), edges_[m].begin(), edges_[m].end());
  }
  check(pixels <= 0xffffffffu, "draw_candidates: too many views at once");
  scene_.nearest.resize(pixels);
  scene_.surface_m.assign(pixels, DEPTH_EMPTY);
}

// Depth maps have one size, that of the object's largest window; each is cut to its own window.
void CandidatePainter::draw_surfaces(const EdgeModel& model, const ObjectMaps& own) {
  std::uint32_t width = 0, height = 0;
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < own.maps.size(); ++i) {
    const MapWindow& window = scene_.maps[own.maps[i]].window;
    if (window.size() > 0) shown.push_back(i);
    width = std::max(width, window.width), height = std::max(height, window.height);
  }
  if (shown.empty()) return;
  constexpr std::size_t most_values = 8u << 20;  // bounds the memory, however many maps there are
  const std::size_t block = std::max<std::size_t>(1, most_values / (std::size_t(width) * height));
  std::vector<float> depth;
  for (std::size_t first = 0; first < shown.size(); first += block) {
    const std::span<const std::size_t> drawn =
        std::span(shown).subspan(first, std::min(block, shown.size() - first));
    const std::vector<DepthJob> jobs = depth_jobs(own, drawn);
    depth.resize(jobs.size() * width * height);
    backend_.depth_raster(model.triangle_mesh(), jobs, int(width), int(height), depth);
    for (std::size_t j = 0; j < jobs.size(); ++j) {
      const CandidateMap& map = scene_.maps[own.maps[drawn[j]]];
      for (std::uint32_t y = 0; y < map.window.height; ++y)
        std::copy_n(depth.data() + (j * height + y) * width, map.window.width,
                    scene_.surface_m.data() + map.first_pixel + std::size_t(y) * map.window.width);
    }
  }
}

std::vector<DepthJob> CandidatePainter::depth_jobs(const ObjectMaps& own,
                                                   std::span<const std::size_t> drawn) const {
  std::vector<DepthJob> jobs;
  for (const std::size_t i : drawn) {
    const MapWindow& window = scene_.maps[own.maps[i]].window;
    jobs.push_back({to_pose(own.camera_from_object[i]),
                    {float(camera_.fx), float(camera_.fy), float(camera_.cx - window.x0),
                     float(camera_.cy - window.y0)}});
  }
  return jobs;
}

}  // namespace

ChamferView CandidateScene::chamfer_view(std::size_t view) const {
  ChamferView seen;
  seen.width = width;
  seen.height = height;
  seen.candidates = std::span(maps).subspan(view * candidates, candidates);
  seen.edges = edges;
  seen.nearest = nearest;
  seen.surface_m = surface_m;
  seen.tolerance_m = tolerance_m;
  return seen;
}

CandidateScene draw_candidates(std::span<const EdgeModel> models,
                               std::span<const Detection> candidates, const Camera& camera,
                               std::span<const Se3> camera_from_world, Backend& backend,
                               const CandidateSceneOptions& options) {
  check(options.measured.empty() || options.measured.size() == camera_from_world.size(),
        "draw_candidates: measured surfaces of every view");
  CandidateScene scene;
  scene.width = camera.width;
  scene.height = camera.height;
  scene.candidates = candidates.size();
  for (const Detection& candidate : candidates)
    scene.tolerance_m.push_back(
        float(options.tolerance * models[candidate.object].mesh.diameter_m));
  scene.maps.resize(camera_from_world.size() * candidates.size());
  const std::vector<ObjectMaps> by_object =
      maps_by_object(models.size(), candidates, camera_from_world);
  CandidatePainter painter(scene, camera, backend);
  for (std::size_t object = 0; object < models.size(); ++object)
    painter.project_edges(models[object], by_object[object], options);
  painter.arrange();
  for (std::size_t object = 0; object < models.size(); ++object)
    painter.draw_surfaces(models[object], by_object[object]);
  backend.candidate_map(scene.edges, scene.maps, scene.width, scene.height, scene.nearest);
  return scene;
}

}  // namespace edgescout
