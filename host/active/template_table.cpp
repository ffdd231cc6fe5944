#include "host/active/template_table.h"

#include <algorithm>
#include <unordered_map>

#include "host/model/viewpoints.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

// Numbers the cubic cells that hold points, in the order in which they appear.
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

// Fills the table with one point per cell and viewpoint. False where a viewpoint has more than
// `most`.
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

// Visible points from each direction.
std::vector<std::vector<ModelPoint>> visible_from(std::span<const Eigen::Vector3d> towards_camera,
                                                  const EdgeModel& model, double distance_m,
                                                  Backend& backend) {
  std::vector<Se3> poses;
  for (const Eigen::Vector3d& direction : towards_camera) {
    const Eigen::Quaterniond rotation = looking_from(direction);
    poses.push_back({rotation, Eigen::Vector3d(0, 0, std::max(distance_m, 1.2 * model.radius_m)) -
                                   rotation * model.center_m});
  }
  return visible_edges(model, poses, backend);
}

}  // namespace

TemplateTable make_template_table(const EdgeModel& model, double distance_m, Backend& backend,
                                  const TemplateTableOptions& options) {
  check(options.most_points >= 1, "make_template_table: at least one point");
  const std::vector<Eigen::Vector3d> towards_camera = icosphere(options.frequency);
  const std::vector<std::vector<ModelPoint>> visible =
      visible_from(towards_camera, model, distance_m, backend);
  TemplateTable table{ViewpointIndex(towards_camera, model.center_m), {}, 0};
  double cell_m = model.raster_step_m;
  while (!fill(table, visible, Cells(model.mesh, cell_m), options.most_points)) cell_m *= 1.25;
  if (table.total == 0)
    throw InputError(model.mesh.name, "templates", "no viewpoint that shows an edge",
                     "a mesh with edges");
  return table;
}

}  // namespace edgescout
