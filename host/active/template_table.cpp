#include "host/active/template_table.h"

#include <cmath>
#include <unordered_map>

#include "host/model/viewpoints.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

// Numbers the cells of space that hold points, in the order they turn up.
class Cells {
 public:
  Cells(const Mesh& mesh, double size_m) : low_m_(mesh.box_min_m), size_m_(size_m) {}
  std::uint32_t number(const ModelPoint& point) {
    const Eigen::Vector3d cell =
        ((Eigen::Vector3d(point.x_m, point.y_m, point.z_m) - low_m_) / size_m_).array().floor();
    const std::int64_t key =
        (std::int64_t(cell.x()) << 42) ^ (std::int64_t(cell.y()) << 21) ^ std::int64_t(cell.z());
    return numbers_.try_emplace(key, std::uint32_t(numbers_.size())).first->second;
  }
  std::uint32_t count() const { return std::uint32_t(numbers_.size()); }

 private:
  Eigen::Vector3d low_m_;
  double size_m_;
  std::unordered_map<std::int64_t, std::uint32_t> numbers_;
};

// One point a cell and viewpoint; false where a viewpoint has more than `most`.
bool fill(TemplateTable& table, std::span<const std::vector<ModelPoint>> visible, Cells cells,
          int most) {
  table.points.assign(visible.size(), {});
  std::vector<std::size_t> last_viewpoint;  // by cell, plus one
  for (std::size_t v = 0; v < visible.size(); ++v) {
    for (const ModelPoint& point : visible[v]) {
      const std::uint32_t id = cells.number(point);
      last_viewpoint.resize(cells.count(), 0);
      if (last_viewpoint[id] == v + 1) continue;
      last_viewpoint[id] = v + 1;
      table.points[v].push_back({point, id});
    }
    if (int(table.points[v].size()) > most) return false;
  }
  table.total = cells.count();
  return true;
}

}  // namespace

const std::vector<TemplateTablePoint>& TemplateTable::seen_from(
    const Se3& camera_from_object) const {
  const Eigen::Vector3d to_eye = inverse(camera_from_object).translation_m - center_m;
  std::size_t nearest = 0;
  for (std::size_t v = 1; v < directions.size(); ++v)
    if (directions[v].dot(to_eye) > directions[nearest].dot(to_eye)) nearest = v;
  return points[nearest];
}

TemplateTable make_template_table(const EdgeModel& model, double distance_m, Backend& backend,
                                  const TemplateTableOptions& options) {
  check(options.most_points >= 1, "make_template_table: at least one point");
  TemplateTable table;
  table.center_m = model.center_m;
  table.directions = icosphere(options.frequency);
  std::vector<Se3> poses;
  for (const Eigen::Vector3d& direction : table.directions) {
    const Eigen::Quaterniond rotation = looking_from(direction);
    poses.push_back({rotation, Eigen::Vector3d(0, 0, std::max(distance_m, 1.2 * model.radius_m)) -
                                   rotation * model.center_m});
  }
  const std::vector<std::vector<ModelPoint>> visible = visible_edges(model, poses, backend);
  double cell_m = model.raster_step_m;
  while (!fill(table, visible, Cells(model.mesh, cell_m), options.most_points)) cell_m *= 1.25;
  if (table.total == 0)
    throw InputError(model.mesh.name, "templates", "no viewpoint that shows an edge",
                     "a mesh with edges");
  return table;
}

}  // namespace edgescout
