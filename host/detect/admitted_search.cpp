#include "host/detect/admitted_search.h"

#include "host/register/thresholds.h"

namespace edgescout {

AdmittedSearch::AdmittedSearch(const SearchedScale& scale, const ObjectView& view,
                               const ScanOptions& options)
    : scale_(scale),
      anchor_step_(options.anchor_step),
      space_(options.world, scale.set.model, view.camera_from_world),
      depth_(scale, view, options.anchor_step) {}

std::vector<std::optional<ScanRegion>> AdmittedSearch::parts_of(const ScanRegion& region) const {
  std::vector<std::optional<ScanRegion>> parts;
  for (std::size_t i = 0; i < scale_.numbering.distances_m.size(); ++i)
    parts.push_back(part_at(i, region));
  return parts;
}

bool AdmittedSearch::admits(const ScoredTemplate& scored) const {
  const std::size_t distance = scored.number % scale_.numbering.distances_m.size();
  if (!depth_.fits(distance, int(scored.anchor_px.x()), int(scored.anchor_px.y()))) return false;
  return space_.is_everywhere() ||
         space_.admits(scale_.hit_of(scored).pose.world_from_object,
                       slack_at(scale_.numbering.distance_m(scored.number)));
}

std::optional<ScanRegion> AdmittedSearch::part_at(std::size_t distance,
                                                  const ScanRegion& region) const {
  const double distance_m = scale_.numbering.distances_m[distance];
  Eigen::AlignedBox2i part;  // column, row
  for (int row = 0; row < region.rows; ++row)
    for (int column = 0; column < region.columns; ++column) {
      const Eigen::Vector2d anchor(region.x0 + anchor_step_ * column,
                                   region.y0 + anchor_step_ * row);
      if (depth_.fits(distance, int(anchor.x()), int(anchor.y())) &&
          space_.meets(ray_through(scale_.level.camera, anchor).normalized(), distance_m,
                       slack_at(distance_m)))
        part.extend(Eigen::Vector2i(column, row));
    }
  if (part.isEmpty()) return std::nullopt;
  return ScanRegion{region.x0 + anchor_step_ * part.min().x(),
                    region.y0 + anchor_step_ * part.min().y(), part.sizes().x() + 1,
                    part.sizes().y() + 1, region.middle};
}

SearchSlack AdmittedSearch::slack_at(double distance_m) const {
  return {anchor_step_ * distance_m / scale_.level.camera.fx +
              thresholds::SAME_POSE * scale_.set.model.mesh.diameter_m,
          scale_.set.options.distance_ratio};
}

}  // namespace edgescout
