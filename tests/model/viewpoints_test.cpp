// Directions on the sphere, and their reduction by symmetry without gaps.
#include "host/model/viewpoints.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "host/model/axis_symmetry.h"
#include "tests/io/expect_input_error.h"
#include "tests/model/box.h"
#include "tests/test_random.h"

namespace edgescout::test {
namespace {

constexpr double spacing_rad = 1.1071;  // between neighbouring corners of the icosahedron

double angle_rad(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::acos(std::clamp(a.dot(b), -1.0, 1.0));
}

TEST(Viewpoints, IcosphereCountsAndSpacing) {
  Random random = test_random();
  for (int frequency = 1; frequency <= 8; ++frequency) {
    const std::vector<Eigen::Vector3d> directions = edgescout::icosphere(frequency);
    ASSERT_EQ(directions.size(), std::size_t(10 * frequency * frequency + 2));
    for (std::size_t i = 0; i < directions.size(); ++i) {
      EXPECT_NEAR(directions[i].norm(), 1, 1e-12);
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_GT(angle_rad(directions[i], directions[j]), 0.7 * spacing_rad / frequency);
    }
    for (int i = 0; i < 300; ++i) {
      const Eigen::Vector3d any = random.direction();
      double nearest = 10;
      for (const Eigen::Vector3d& d : directions) nearest = std::min(nearest, angle_rad(any, d));
      EXPECT_LT(nearest, ICOSPHERE_GAP_RAD / frequency);
    }
  }
}

TEST(Viewpoints, RangesOfLatitudeAndLongitude) {
  const auto at = [](double latitude_deg, double longitude_deg) {
    const double a = latitude_deg * std::numbers::pi / 180,
                 o = longitude_deg * std::numbers::pi / 180;
    return Eigen::Vector3d(std::cos(a) * std::cos(o), std::cos(a) * std::sin(o), std::sin(a));
  };
  const SphereRange wrapped{10, 80, 300, 60};
  EXPECT_TRUE(wrapped.contains(at(45, 0)));
  EXPECT_TRUE(wrapped.contains(at(45, 310)));
  EXPECT_TRUE(wrapped.contains(at(45, 59)));
  EXPECT_FALSE(wrapped.contains(at(45, 180)));
  EXPECT_FALSE(wrapped.contains(at(45, 70)));
  EXPECT_FALSE(wrapped.contains(at(5, 0)));
  EXPECT_FALSE(wrapped.contains(at(85, 0)));
  for (const Eigen::Vector3d& d : edgescout::icosphere(3)) EXPECT_TRUE(SphereRange{}.contains(d));
}

TEST(Viewpoints, TheCameraLooksBackAtTheObject) {
  Random random = test_random();
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d direction = i == 0   ? Eigen::Vector3d(0, 0, 1)
                                      : i == 1 ? Eigen::Vector3d(0, 0, -1)
                                               : random.direction();
    EXPECT_LT((looking_from(direction) * -direction - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  }
}

void expect_no_gap(const Symmetries& symmetries, int frequency, double least_kept,
                   double most_kept) {
  const std::vector<Eigen::Vector3d> all = edgescout::icosphere(frequency);
  const std::vector<Eigen::Vector3d> kept =
      modulo_symmetry(all, symmetries, ICOSPHERE_GAP_RAD / frequency);
  EXPECT_GE(double(kept.size()), least_kept * double(all.size()));
  EXPECT_LE(double(kept.size()), most_kept * double(all.size()));
  Random random = test_random();
  double widest = 0;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d any = random.direction();
    double nearest = 10;
    for (const Se3& symmetry : symmetries.discrete)
      for (const Eigen::Vector3d& d : kept)
        nearest = std::min(nearest, angle_rad(symmetry.rotation * any, d));
    widest = std::max(widest, nearest);
  }
  EXPECT_LT(widest, ICOSPHERE_GAP_RAD / frequency)
      << kept.size() << " of " << all.size() << " kept";
}

Symmetries symmetric(const std::vector<std::string>& words) {
  return axis_symmetries(box_mesh(0.06, 0.04, 0.02), words);
}

TEST(Viewpoints, WithoutSymmetryAllAreKept) { expect_no_gap({}, 5, 1, 1); }
TEST(Viewpoints, AHalfTurnKeepsAboutHalf) { expect_no_gap(symmetric({"z2"}), 5, 0.5, 0.65); }
TEST(Viewpoints, ABoxKeepsAboutAQuarter) { expect_no_gap(symmetric({"x2", "z2"}), 5, 0.25, 0.45); }
TEST(Viewpoints, AHexagonKeepsAboutATwelfth) {
  expect_no_gap(symmetric({"x2", "z6"}), 5, 1 / 12.0, 0.25);
}
TEST(Viewpoints, ASolidOfRevolutionKeepsOneMeridian) {
  expect_no_gap(symmetric({"z"}), 5, 0, 0.15);
}

// The wanted directions are there, also where the fundamental domain lies outside the range.
TEST(Viewpoints, OfARangeHaveNoGapModuloSymmetry) {
  Random random = test_random();
  constexpr int frequency = 5;
  for (const SphereRange range :
       {SphereRange{-90, 0, 0, 360}, SphereRange{-90, -30, 0, 360}, SphereRange{-90, 90, 180, 360}})
    for (const std::vector<std::string>& words :
         std::vector<std::vector<std::string>>{{}, {"y2"}, {"z2"}, {"z"}}) {
      const Symmetries symmetries = symmetric(words);
      const std::vector<Eigen::Vector3d> kept = viewpoints_in(range, symmetries, frequency);
      double widest = 0;
      for (int i = 0; i < 2000; ++i) {
        const Eigen::Vector3d any = random.direction();
        double nearest = range.contains(any) ? 10 : 0;
        for (const Se3& symmetry : symmetries.discrete)
          for (const Eigen::Vector3d& d : kept)
            nearest = std::min(nearest, angle_rad(symmetry.rotation * any, d));
        widest = std::max(widest, nearest);
      }
      // at the range's border one of three neighbours may stand alone
      EXPECT_LT(widest, 2 * ICOSPHERE_GAP_RAD / frequency)
          << range.latitude_max_deg << " " << kept.size();
    }
}

TEST(AxisSymmetry, TurnsAboutTheCentroidAndClosesTheGroup) {
  Mesh box = box_mesh(0.06, 0.04, 0.02);
  for (Eigen::Vector3d& v : box.vertices_m) v += Eigen::Vector3d(0.1, 0.2, 0.3);
  const std::vector<std::string> words{"z2", "x2"};
  const Symmetries symmetries = axis_symmetries(box, words);
  ASSERT_EQ(symmetries.discrete.size(), 4u);
  EXPECT_LT(symmetries.discrete[0].rotation.angularDistance(Eigen::Quaterniond::Identity()), 1e-12);
  for (const Se3& a : symmetries.discrete) {
    for (const Eigen::Vector3d& v : box.vertices_m) {
      double nearest = 1;
      for (const Eigen::Vector3d& w : box.vertices_m)
        nearest = std::min(nearest, (a * v - w).norm());
      EXPECT_LT(nearest, 1e-12);
    }
    for (const Se3& b : symmetries.discrete) {
      double nearest = 1;
      for (const Se3& c : symmetries.discrete)
        nearest = std::min(nearest, angle_between_rad(a * b, c));
      EXPECT_LT(nearest, 1e-7);
    }
  }
}

TEST(AxisSymmetry, GeneratesTheGroupOfItsWords) {
  EXPECT_EQ(symmetric({"x4", "z4"}).discrete.size(), 24u) << "a cube";
  EXPECT_EQ(symmetric({"x2", "z6"}).discrete.size(), 12u) << "a hexagon";
  EXPECT_EQ(symmetric({"z360", "x2"}).discrete.size(), 720u);
  EXPECT_EQ(symmetric({"x2", "z"}).discrete.size(), 128u) << "a bar";
  EXPECT_THROW(symmetric({"x4", "z3"}), InputError) << "of no solid";
}

TEST(AxisSymmetry, RefusesOtherWords) {
  for (const std::string word : {"", "q", "w2", "z1", "z0", "z-2", "z361", "z2x", "Z2"})
    expect_input_error([&] { axis_symmetries(box_mesh(0.06, 0.04, 0.02), std::vector{word}); },
                       {"symmetry", "\"" + word + "\""});
}

}  // namespace
}  // namespace edgescout::test
