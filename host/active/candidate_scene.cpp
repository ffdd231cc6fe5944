#include "host/active/candidate_scene.h"

#include <algorithm>

#include "host/register/d2co.h"
#include "kernels/error.h"
#include "kernels/thread_pool.h"

namespace edgescout {

namespace {

struct Box {
  float x_min = 0, y_min = 0, x_max = 0, y_max = 0;
};

// Where the mesh's bounding box, and with it the mesh, lies on the map; false where it reaches
// behind the camera.
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

// The maps of one object's candidates, by their place in the scene, with the poses they are drawn
// at.
struct Slots {
  std::vector<std::size_t> maps;
  std::vector<Se3> poses;
};

// Depth maps are as large as the largest window; each is cut to its own.
void draw_surfaces(CandidateScene& scene, const EdgeModel& model, const Slots& slots,
                   const Camera& camera, Backend& backend) {
  std::uint32_t width = 0, height = 0;
  std::vector<std::size_t> shown;
  for (std::size_t s = 0; s < slots.maps.size(); ++s) {
    const MapWindow& window = scene.maps[slots.maps[s]].window;
    if (window.size() > 0) shown.push_back(s);
    width = std::max(width, window.width), height = std::max(height, window.height);
  }
  if (shown.empty()) return;
  constexpr std::size_t most_values = 8u << 20;  // bounded memory however many there are
  const std::size_t chunk = std::max<std::size_t>(1, most_values / (std::size_t(width) * height));
  std::vector<float> depth;
  for (std::size_t first = 0; first < shown.size(); first += chunk) {
    std::vector<DepthJob> jobs;
    for (std::size_t i = first; i < std::min(first + chunk, shown.size()); ++i) {
      const MapWindow& window = scene.maps[slots.maps[shown[i]]].window;
      jobs.push_back({to_pose(slots.poses[shown[i]]),
                      {float(camera.fx), float(camera.fy), float(camera.cx - window.x0),
                       float(camera.cy - window.y0)}});
    }
    depth.resize(jobs.size() * width * height);
    backend.depth_raster(model.triangle_mesh(), jobs, int(width), int(height), depth);
    for (std::size_t j = 0; j < jobs.size(); ++j) {
      const CandidateMap& map = scene.maps[slots.maps[shown[first + j]]];
      for (std::uint32_t y = 0; y < map.window.height; ++y)
        std::copy_n(depth.data() + (j * height + y) * width, map.window.width,
                    scene.surface_m.data() + map.first_pixel + std::size_t(y) * map.window.width);
    }
  }
}

}  // namespace

ChamferView CandidateScene::seen_from(std::size_t view) const {
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
                               const VisibilityOptions& visibility, double tolerance) {
  CandidateScene scene;
  scene.width = camera.width;
  scene.height = camera.height;
  scene.candidates = candidates.size();
  for (const Detection& candidate : candidates)
    scene.tolerance_m.push_back(float(tolerance * models[candidate.object].mesh.diameter_m));
  std::vector<Slots> slots(models.size());
  for (std::size_t v = 0; v < camera_from_world.size(); ++v)
    for (std::size_t c = 0; c < candidates.size(); ++c) {
      slots[candidates[c].object].maps.push_back(v * candidates.size() + c);
      slots[candidates[c].object].poses.push_back(camera_from_world[v] *
                                                  candidates[c].world_from_object);
    }
  std::vector<std::vector<MapEdge>> edges(camera_from_world.size() * candidates.size());
  scene.maps.resize(edges.size());
  for (std::size_t object = 0; object < models.size(); ++object) {
    const Slots& own = slots[object];
    std::vector<std::vector<ModelPoint>> visible =
        visible_edges(models[object], own.poses, backend, visibility);
    backend.threads().for_each(own.maps.size(), [&](std::size_t s) {
      Box box;
      if (!projected_box(models[object].mesh, own.poses[s], camera, box)) return;
      // In the order of creases, borders and contours: of too many every so many stay, not the
      // first.
      if (visible[s].size() > CANDIDATE_MAP_MAX_EDGES)
        visible[s] = thinned(visible[s], int(CANDIDATE_MAP_MAX_EDGES));
      edges[own.maps[s]] = projected(visible[s], own.poses[s], camera);
      scene.maps[own.maps[s]].window =
          map_window(box.x_min, box.y_min, box.x_max, box.y_max, camera.width, camera.height);
    });
  }
  std::size_t pixels = 0;
  for (std::size_t m = 0; m < scene.maps.size(); ++m) {
    scene.maps[m].first_pixel = std::uint32_t(pixels);
    pixels += scene.maps[m].window.size();
    scene.maps[m].first_edge = std::uint32_t(scene.edges.size());
    scene.maps[m].edge_count = std::uint32_t(edges[m].size());
    scene.edges.insert(scene.edges.end(), edges[m].begin(), edges[m].end());
  }
  check(pixels <= 0xffffffffu, "draw_candidates: too many views at once");
  scene.nearest.resize(pixels);
  scene.surface_m.assign(pixels, DEPTH_EMPTY);
  for (std::size_t object = 0; object < models.size(); ++object)
    draw_surfaces(scene, models[object], slots[object], camera, backend);
  backend.candidate_map(scene.edges, scene.maps, scene.width, scene.height, scene.nearest);
  return scene;
}

}  // namespace edgescout
