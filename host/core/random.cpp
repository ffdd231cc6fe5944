#include "host/core/random.h"

#include <bit>
#include <cmath>
#include <numbers>

#include "kernels/error.h"

namespace edgescout {
namespace {

// SplitMix64 (Steele et al. 2014): one step of its counter and its mixing function.
std::uint64_t split_mix(std::uint64_t& counter) {
  std::uint64_t z = (counter += 0x9e3779b97f4a7c15u);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

std::uint64_t combine(std::uint64_t seed, std::uint64_t key) {
  std::uint64_t counter = seed;
  counter = split_mix(counter) ^ key;
  return split_mix(counter);
}

}  // namespace

Random::Random(std::uint64_t seed) : seed_(seed) {
  std::uint64_t counter = seed;
  for (std::uint64_t& word : state_) word = split_mix(counter);
}

Random Random::split(std::string_view name) const {
  std::uint64_t hash = 0xcbf29ce484222325u;  // FNV-1a
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return Random(combine(seed_, hash));
}

Random Random::split(std::uint64_t index) const { return Random(combine(seed_, index + 1)); }

std::uint64_t Random::bits() {
  const std::uint64_t result = std::rotl(state_[1] * 5, 7) * 9;
  const std::uint64_t shifted = state_[1] << 17;
  state_[2] ^= state_[0];
  state_[3] ^= state_[1];
  state_[1] ^= state_[2];
  state_[0] ^= state_[3];
  state_[2] ^= shifted;
  state_[3] = std::rotl(state_[3], 45);
  return result;
}

double Random::uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

double Random::uniform(double low, double high) { return low + (high - low) * uniform(); }

int Random::below(int count) {
  check(count >= 1, "Random::below: count must be positive");
  return static_cast<int>(uniform() * count);
}

double Random::normal() {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));  // 1 - u is never zero
  return radius * std::cos(2.0 * std::numbers::pi * uniform());
}

Eigen::Vector3d Random::direction() {
  const double z = uniform(-1.0, 1.0);
  const double angle = uniform(0.0, 2.0 * std::numbers::pi);
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

Eigen::Quaterniond Random::rotation() {
  Eigen::Vector4d q;
  do q = {normal(), normal(), normal(), normal()};
  while (q.squaredNorm() < 1e-12);
  q.normalize();
  return {q[0], q[1], q[2], q[3]};
}

}  // namespace edgescout
