#include <gtest/gtest.h>

#include <numbers>
#include <sstream>

#include "host/io/bop.h"
#include "tests/io/expect_input_error.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

using Eigen::Vector3d;

std::vector<Se3> symmetries_with(const std::string& fields, int steps = 64,
                                 const std::string& diameter_mm = "10") {
  const TemporaryFolder folder;
  const auto file =
      folder.write("models_info.json", "{\"5\": {\"diameter\": " + diameter_mm + fields + "}}");
  return load_symmetries(file, steps).at(5).discrete;
}

bool contains(const std::vector<Se3>& group, const Se3& member) {
  for (const Se3& s : group)
    if (angle_between_rad(s, member) < 1e-6 && distance_between_m(s, member) < 1e-9) return true;
  return false;
}

// Every product of two members is a member again.
void expect_closed(const std::vector<Se3>& group) {
  for (const Se3& a : group)
    for (const Se3& b : group) EXPECT_TRUE(contains(group, a * b));
}

Se3 turn(double angle, const Vector3d& axis, const Vector3d& through_m = Vector3d::Zero()) {
  const Eigen::Quaterniond q = so3_exp(angle * axis);
  return {q, through_m - q * through_m};
}

const std::string half_turn_x = "[1,0,0,0, 0,-1,0,0, 0,0,-1,0, 0,0,0,1]";
const std::string quarter_turn_z = "[0,-1,0,0, 1,0,0,0, 0,0,1,0, 0,0,0,1]";
const std::string spin_z =
    R"(, "symmetries_continuous": [{"axis": [0, 0, 2], "offset": [0, 0, 0]}])";

std::string discrete(const std::string& list) {
  return ", \"symmetries_discrete\": [" + list + "]";
}

TEST(LoadSymmetries, WithoutAnyHoldsTheIdentityOnly) {
  const std::vector<Se3> group = symmetries_with("");
  ASSERT_EQ(group.size(), 1u);
  EXPECT_LT(angle_between_rad(group[0], Se3{}), 1e-12);
}

TEST(LoadSymmetries, KeepsAHalfTurnWithItsOffsetInMetres) {
  // Half a turn about the line x = 10 mm, y = 0 along z: x -> 20 - x, y -> -y.
  const std::vector<Se3> group =
      symmetries_with(discrete("[-1,0,0,20, 0,-1,0,0, 0,0,1,0, 0,0,0,1]"));
  ASSERT_EQ(group.size(), 2u);
  EXPECT_LT((group[1] * Vector3d(0.01, 0, 0.3) - Vector3d(0.01, 0, 0.3)).norm(), 1e-12);
  EXPECT_LT((group[1] * Vector3d(0, 0.002, 0) - Vector3d(0.02, -0.002, 0)).norm(), 1e-12);
}

TEST(LoadSymmetries, ClosesTheGroupOfItsGenerators) {
  const std::vector<Se3> four = symmetries_with(discrete(quarter_turn_z));
  EXPECT_EQ(four.size(), 4u);
  expect_closed(four);
  // A square plate: quarter turns about z and a half turn about x make the dihedral group of 8.
  const std::vector<Se3> plate = symmetries_with(discrete(quarter_turn_z + "," + half_turn_x));
  EXPECT_EQ(plate.size(), 8u);
  expect_closed(plate);
  for (int i = 0; i < 4; ++i) {
    EXPECT_TRUE(contains(plate, turn(i * std::numbers::pi / 2, Vector3d::UnitZ())));
    const double axis = i * std::numbers::pi / 4;
    EXPECT_TRUE(
        contains(plate, turn(std::numbers::pi, Vector3d(std::cos(axis), std::sin(axis), 0))));
  }
  // Quarter turns about two axes generate the 24 rotations of a cube.
  const std::vector<Se3> cube =
      symmetries_with(discrete(quarter_turn_z + ",[1,0,0,0, 0,0,-1,0, 0,1,0,0, 0,0,0,1]"));
  EXPECT_EQ(cube.size(), 24u);
  expect_closed(cube);
}

// As published, to six digits and in mm: the square of each is no identity.
const std::string eggbox_half_turn =  // of LINEMOD's object 10: 0.0067 rad and 0.15 mm off
    "[-0.999964,-0.00333777,-0.0077452,0.232611, 0.00321462,-0.999869,0.0158593,0.694388, "
    "-0.00779712,0.0158338,0.999844,-0.0792063, 0,0,0,1]";
const std::string glue_half_turn =  // of its object 11: 0.053 rad and 0.06 mm off
    "[-0.999633,0.026679,0.00479336,-0.262139, -0.0266744,-0.999644,0.00100504,-0.197966, "
    "0.00481847,0.000876807,0.999988,0.0321652, 0,0,0,1]";

// A matrix by row with so many digits.
std::string matrix_text(const Se3& pose, int digits) {
  const Eigen::Matrix3d r = pose.rotation.toRotationMatrix();
  std::ostringstream text;
  text.precision(digits);
  for (int i = 0; i < 3; ++i)
    text << (i == 0 ? "[" : "") << r(i, 0) << "," << r(i, 1) << "," << r(i, 2) << ","
         << 1e3 * pose.translation_m[i] << ", ";
  return text.str() + "0,0,0,1]";
}

TEST(LoadSymmetries, TakesAMeasuredHalfTurnForOne) {
  const Vector3d tilted = Vector3d(1, 2, 3).normalized();
  const Se3 half_turn = turn(std::numbers::pi - 0.025, tilted, Vector3d(0.002, 0, 0.001));
  ASSERT_NEAR(angle_between_rad(half_turn * half_turn, Se3{}), 0.05, 1e-9);
  for (const std::string& matrix : {eggbox_half_turn, glue_half_turn, matrix_text(half_turn, 6)}) {
    const std::vector<Se3> group = symmetries_with(discrete(matrix), 64, "170");
    ASSERT_EQ(group.size(), 2u) << matrix;
    EXPECT_LT(angle_between_rad(group[0], Se3{}), 1e-12);
    EXPECT_NEAR(angle_between_rad(group[1], Se3{}), std::numbers::pi, 0.03) << "as it was measured";
  }
}

TEST(LoadSymmetries, ClosesTheGroupOfAMeasuredGenerator) {
  const Se3 fifth = turn(2 * std::numbers::pi / 5 + 0.01, Vector3d(1, 2, 3).normalized());
  EXPECT_EQ(symmetries_with(discrete(matrix_text(fifth, 6))).size(), 5u);
}

// Also such as measuring would confuse.
TEST(LoadSymmetries, KeepsTurnsOfHighOrderApart) {
  for (const int order : {31, 36, 72, 120}) {
    const Se3 step = turn(2 * std::numbers::pi / order, Vector3d::UnitZ());
    const Se3 seven_steps =
        turn(7 * 2 * std::numbers::pi / order, Vector3d::UnitZ());  // prime to all
    for (const Se3& generator : {step, seven_steps})
      EXPECT_EQ(symmetries_with(discrete(matrix_text(generator, 17))).size(),
                static_cast<std::size_t>(order));
  }
}

// BOP's lists are complete.
TEST(LoadSymmetries, TakesAListThatGeneratesNoGroupAsItIs) {
  for (const Se3& endless :
       {turn(1, Vector3d::UnitZ()), Se3{Eigen::Quaterniond::Identity(), {0.005, 0, 0}}}) {
    const std::vector<Se3> group = symmetries_with(discrete(matrix_text(endless, 17)));
    ASSERT_EQ(group.size(), 2u);
    EXPECT_TRUE(contains(group, Se3{}) && contains(group, endless));
  }
}

TEST(LoadSymmetries, SamplesARotationAboutAnAxis) {
  const std::vector<Se3> group = symmetries_with(
      R"(, "symmetries_continuous": [{"axis": [0, 0, 2], "offset": [10, 20, 0]}])", 8);
  ASSERT_EQ(group.size(), 8u);
  EXPECT_LT(angle_between_rad(group[0], Se3{}), 1e-12);
  for (int i = 0; i < 8; ++i)
    EXPECT_TRUE(contains(
        group, turn(i * std::numbers::pi / 4, Vector3d::UnitZ(), Vector3d(0.01, 0.02, 0))));
  expect_closed(group);
}

// A tin: spins about z and turns over about x.
TEST(LoadSymmetries, CombinesContinuousAndDiscrete) {
  const std::vector<Se3> tin = symmetries_with(discrete(half_turn_x) + spin_z, 6);
  EXPECT_EQ(tin.size(), 12u);
  expect_closed(tin);
  EXPECT_TRUE(contains(tin, turn(std::numbers::pi / 3, Vector3d::UnitZ()) *
                                turn(std::numbers::pi, Vector3d::UnitX())));
  // A half turn about the axis itself is among its samples already.
  EXPECT_EQ(symmetries_with(discrete("[-1,0,0,0, 0,-1,0,0, 0,0,1,0, 0,0,0,1]") + spin_z, 6).size(),
            6u);
}

TEST(LoadSymmetries, NamesFileAndFieldOfWhatIsWrong) {
  expect_input_error([] { symmetries_with(discrete("[1,2,3]")); },
                     {"models_info.json", "/5/symmetries_discrete/0", "3 numbers"});
  expect_input_error([] { symmetries_with(discrete("[2,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]")); },
                     {"/5/symmetries_discrete/0", "no rotation"});
  // A mirror is no motion of a rigid body.
  expect_input_error([] { symmetries_with(discrete("[-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]")); },
                     {"/5/symmetries_discrete/0", "no rotation"});
  expect_input_error(
      [] {
        symmetries_with(R"(, "symmetries_continuous": [{"axis": [0, 0, 0], "offset": [0, 0, 0]}])");
      },
      {"/5/symmetries_continuous/0/axis"});
  expect_input_error([] { symmetries_with(R"(, "symmetries_continuous": [{"axis": [0, 0, 1]}])"); },
                     {"/5/symmetries_continuous/0/offset"});
  expect_input_error([] { symmetries_with(discrete("[-1,0,0,0, 0,-1,0,0, 0,0,1,0, 5,0,0,1]")); },
                     {"/5/symmetries_discrete/0", "last row", "transposed"});
  expect_input_error([] { symmetries_with(R"(, "symmetries": ["z2"])"); },
                     {"/5/symmetries", "not known", "symmetries_discrete"});
  for (const char* other : {"Symmetries_Discrete", "sym"})
    expect_input_error([&] { symmetries_with(std::string(", \"") + other + "\": [2]"); },
                       {other, "not known"});
  expect_input_error(
      [] {
        symmetries_with(
            R"(, "symmetries_continuous": [{"axis": [0,0,1], "offset": [0,0,0], "step": 90}])");
      },
      {"/5/symmetries_continuous/0/step", "90"});
  const TemporaryFolder folder;
  const auto list = folder.write("models_info.json", R"({"5": [10]})");
  expect_input_error([&] { load_symmetries(list); }, {"models_info.json", "/5", "an object"});
  expect_input_error([] { load_symmetries("no-such-models_info.json"); },
                     {"no-such-models_info.json", "No such file"});
}

TEST(LoadSymmetries, NamesAnObjectThatStandsTwice) {
  const TemporaryFolder folder;
  for (const char* other : {"5", "000005"}) {
    const auto file =
        folder.write("models_info.json", "{\"5\": {\"diameter\": 1}, \"" + std::string(other) +
                                             "\": {\"diameter\": 2}}");
    expect_input_error([&] { load_symmetries(file); }, {"models_info.json", "5"});
  }
}

}  // namespace
}  // namespace edgescout::test
