#include "host/model/axis_symmetry.h"

#include <charconv>
#include <numbers>

#include "kernels/error.h"

namespace edgescout {

namespace {

Eigen::Vector3d surface_centroid_m(const Mesh& mesh) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double area = 0;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d &a = mesh.vertices_m[t[0]], &b = mesh.vertices_m[t[1]], &c = mesh.vertices_m[t[2]];
    const double weight = (b - a).cross(c - a).norm();
    sum += weight * (a + b + c) / 3;
    area += weight;
  }
  return sum / area;
}

struct Turns {
  Eigen::Vector3d axis;
  int order;
};

Turns turns_of(const std::string& word, int continuous_steps) {
  constexpr int most = 360;
  const InputError unknown("command line", "--symmetry", "\"" + word + "\"",
                           "x, y or z for any turn, or followed by 2 to 360 for an order, as in z2");
  if (word.empty() || word[0] < 'x' || word[0] > 'z') throw unknown;
  Turns turns{Eigen::Vector3d::Unit(word[0] - 'x'), continuous_steps};
  if (word.size() == 1) return turns;
  const char* end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data() + 1, end, turns.order);
  if (error != std::errc{} || rest != end || turns.order < 2 || turns.order > most) throw unknown;
  return turns;
}

}  // namespace

Symmetries axis_symmetries(const Mesh& mesh, std::span<const std::string> words, int continuous_steps) {
  const Eigen::Vector3d center = surface_centroid_m(mesh);
  Symmetries all;
  for (const std::string& word : words) {
    const Turns turns = turns_of(word, continuous_steps);
    std::vector<Se3> products;
    for (int i = 0; i < turns.order; ++i) {
      const Eigen::Quaterniond turn(Eigen::AngleAxisd(2 * std::numbers::pi * i / turns.order, turns.axis));
      const Se3 about_center{turn, center - turn * center};
      for (const Se3& known : all.discrete) products.push_back(about_center * known);
    }
    all.discrete = std::move(products);
  }
  return all;
}

}  // namespace edgescout
