#include "host/render/materials.h"

namespace edgescout {
namespace {

double draw_named(const Range& range, const Random& random, std::string_view name) {
  Random stream = random.split(name);
  return draw(range, stream);
}

// A reflection takes the place of the simple highlight.
void reflect(Material& material, double reflectance, const SurfaceRanges& ranges,
             const Random& random) {
  material.specular = 0;
  material.reflectance = reflectance;
  material.roughness = draw_named(ranges.roughness, random, "roughness");
}

}  // namespace

Material random_material(Random& random) {
  switch (random.below(3)) {
    case 0:
      return {random.uniform(0.18, 0.45), random.uniform(0.1, 0.35), random.uniform(15, 60)};
    case 1:
      return {random.uniform(0.02, 0.10), random.uniform(0.02, 0.08), random.uniform(10, 40)};
    default:
      return {random.uniform(0.35, 0.75), random.uniform(0.0, 0.06), random.uniform(10, 40)};
  }
}

Material with_ranges(Material material, const SurfaceRanges& ranges, const Random& random) {
  if (draw_named({0, 1}, random, "metal") < ranges.metal) {
    reflect(material, draw_named(ranges.reflectance, random, "reflectance"), ranges, random);
    material.anisotropy = draw_named(ranges.anisotropy, random, "anisotropy");
    material.albedo = 0;
    return material;
  }
  if (ranges.albedo.high > 0) material.albedo = draw_named(ranges.albedo, random, "albedo");
  if (ranges.gloss.high > 0)
    reflect(material, draw_named(ranges.gloss, random, "gloss"), ranges, random);
  return material;
}

Material board_material(Material paper, const SurfaceRanges& ranges, const Random& random) {
  if (ranges.board_gloss.high > 0)
    reflect(paper, draw_named(ranges.board_gloss, random, "board gloss"), ranges, random);
  return paper;
}

}  // namespace edgescout
