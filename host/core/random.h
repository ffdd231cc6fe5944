// Seeded random streams with reproducible numbers.
//
// The numbers depend on seed and name alone, not on the standard library's distributions or on the
// order in which threads draw.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace edgescout {

// xoshiro256**. Not thread-safe: give each thread its own split.
class Random {
 public:
  explicit Random(std::uint64_t seed);

  // An independent stream for a named or numbered purpose. Depends on this stream's seed only, not
  // on how much was drawn from it.
  Random split(std::string_view name) const;
  Random split(std::uint64_t index) const;

  std::uint64_t bits();                     // 64 random bits
  double uniform();                         // [0, 1)
  double uniform(double low, double high);  // [low, high)
  int below(int count);                     // 0 .. count - 1, count >= 1
  double normal();                          // mean 0, variance 1
  Eigen::Vector3d direction();              // uniform on the unit sphere
  Eigen::Quaterniond rotation();            // uniform over all rotations

 private:
  std::uint64_t seed_;
  std::array<std::uint64_t, 4> state_;
};

}  // namespace edgescout
