#include "host/io/depth_options.h"

namespace edgescout {

void describe(DepthOptions& o, OptionVisitor& visit) {
  constexpr double farthest_m = 100, coarsest_m = 1, most_noise_m = 0.1;
  visit.group("Depth");
  visit.number(
      {"depth-unit",
       "Length of one stored unit of depth, m. 0: that of the dataset, else 0.001 of whole "
       "numbers and 1 of real numbers"},
      o.unit_m, 0.0, coarsest_m);
  visit.range({"depth-range", "Smallest and largest depth that counts as measured, m"}, o.range_m,
              0, farthest_m);
  visit.number({"depth-noise",
                "Standard deviation of the depth sensor at 1 m, m. It grows with the distance "
                "squared"},
               o.noise.at_one_metre_m, 0.0, most_noise_m);
  visit.number({"depth-noise-floor", "Least standard deviation of the depth sensor, m"},
               o.noise.floor_m, 1e-6, most_noise_m);
}

void DepthOptions::validate() const { check_bounds(*this, "depth"); }

}  // namespace edgescout
