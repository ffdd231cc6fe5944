#include "host/model/axis_symmetry.h"

#include <charconv>
#include <numbers>

#include "host/core/option_names.h"
#include "host/core/symmetry_group.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

constexpr int MOST_TURNS = 360;
constexpr std::size_t MOST_MEMBERS = 2 * MOST_TURNS;  // and a half turn about another axis

Eigen::Vector3d surface_centroid_m(const Mesh& mesh) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double area = 0;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d &a = mesh.vertices_m[t[0]], &b = mesh.vertices_m[t[1]],
                          &c = mesh.vertices_m[t[2]];
    const double weight = (b - a).cross(c - a).norm();
    sum += weight * (a + b + c) / 3;
    area += weight;
  }
  return sum / area;
}

struct Turns {
  Eigen::Vector3d axis;
  int order;       // of a surface of revolution: its samples
  bool is_finite;  // false: a surface of revolution
};

InputError unknown_turns(const std::string& word) {
  return InputError("options", option_name("symmetry"), "\"" + word + "\"",
                    "x, y or z for any turn, or followed by 2 to 360 for an order, as in z2");
}

Turns turns_of(const std::string& word, int continuous_steps) {
  if (word.empty() || word[0] < 'x' || word[0] > 'z') throw unknown_turns(word);
  Turns turns{Eigen::Vector3d::Unit(word[0] - 'x'), continuous_steps, word.size() > 1};
  if (!turns.is_finite) return turns;
  const char* end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data() + 1, end, turns.order);
  if (error != std::errc{} || rest != end || turns.order < 2 || turns.order > MOST_TURNS)
    throw unknown_turns(word);
  return turns;
}

}  // namespace

Symmetries axis_symmetries(const Mesh& mesh, std::span<const std::string> words,
                           int continuous_steps) {
  const Eigen::Vector3d center = surface_centroid_m(mesh);
  const auto about_center = [&](const Turns& turns, int count) {
    const Eigen::Quaterniond turn(
        Eigen::AngleAxisd(2 * std::numbers::pi * count / turns.order, turns.axis));
    return Se3{turn, center - turn * center};
  };
  std::vector<Turns> continuous;
  std::vector<Se3> generators;
  for (const std::string& word : words) {
    const Turns turns = turns_of(word, continuous_steps);
    if (turns.is_finite)
      generators.push_back(about_center(turns, 1));
    else
      continuous.push_back(turns);
  }
  Symmetries all;
  all.discrete = generated_group(generators, MOST_MEMBERS);
  if (all.discrete.empty())
    throw InputError("options", option_name("symmetry"), "turns that generate no finite group",
                     "those of a solid");
  for (const Turns& turns : continuous) {
    std::vector<Se3> products;
    for (int i = 0; i < turns.order; ++i)
      for (const Se3& known : all.discrete) products.push_back(about_center(turns, i) * known);
    all.discrete = std::move(products);
  }
  return all;
}

Symmetries symmetries_of_transforms(std::vector<Se3> transforms) {
  constexpr double same = 1e-6;  // m, rad
  const Se3 identity;
  if (transforms.empty() || angle_between_rad(transforms.front(), identity) > same ||
      distance_between_m(transforms.front(), identity) > same)
    transforms.insert(transforms.begin(), identity);
  return {std::move(transforms)};
}

}  // namespace edgescout
