#include "host/io/bop_targets.h"

#include <gtest/gtest.h>

#include "tests/io/expect_input_error.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

std::vector<BopTarget> targets_of(const std::string& text) {
  const TemporaryFolder folder;
  return load_bop_targets(folder.write("targets.json", text));
}

TEST(BopTargets, Of2019NameObjectsAndTheirNumber) {
  const auto targets = targets_of(
      R"([{"im_id": 3, "inst_count": 2, "obj_id": 5, "scene_id": 48},
          {"im_id": 3, "obj_id": 6, "scene_id": 48, "visib_count": 1}])");
  ASSERT_EQ(targets.size(), 2u);
  EXPECT_EQ(targets[0].scene_id, 48);
  EXPECT_EQ(targets[0].views.at(0).image_id, 3);
  EXPECT_EQ(targets[0].object_id, 5);
  EXPECT_EQ(targets[0].instances, 2);
  EXPECT_FALSE(targets[0].is_group);
  EXPECT_EQ(targets[1].object_id, 6);
  EXPECT_FALSE(targets[1].instances);
}

TEST(BopTargets, Of2024NameImages) {
  const auto targets = targets_of(R"([{"scene_id": 1, "im_id": 0}, {"scene_id": 2, "im_id": 7}])");
  ASSERT_EQ(targets.size(), 2u);
  EXPECT_EQ(targets[1].scene_id, 2);
  EXPECT_EQ(targets[1].views.at(0).image_id, 7);
  EXPECT_FALSE(targets[1].object_id);
}

TEST(BopTargets, Of2025NameGroupsOfViews) {
  const auto targets = targets_of(
      R"([{"scene_id": 1, "im_id": [["cam1", 0], ["cam2", 4]]}, {"scene_id": 1, "im_id": [2, 3]}])");
  ASSERT_EQ(targets.size(), 2u);
  EXPECT_TRUE(targets[0].is_group);
  ASSERT_EQ(targets[0].views.size(), 2u);
  EXPECT_EQ(targets[0].views[1].camera_name, "cam2");
  EXPECT_EQ(targets[0].views[1].image_id, 4);
  EXPECT_EQ(targets[1].views.at(1).camera_name, "");
  EXPECT_EQ(targets[1].views.at(1).image_id, 3);
}

TEST(BopTargets, NameTheFieldOfWhatIsWrong) {
  expect_input_error([] { targets_of("[{"); }, {"targets.json", "JSON"});
  expect_input_error([] { targets_of(R"({"1": 2})"); }, {"targets.json", "an array"});
  expect_input_error([] { targets_of(R"([{"im_id": 1}])"); }, {"/0/scene_id", "nothing"});
  expect_input_error([] { targets_of(R"([{"scene_id": 1}])"); }, {"/0/im_id", "nothing"});
  expect_input_error([] { targets_of(R"([{"scene_id": 1, "im_id": []}])"); },
                     {"/0/im_id", "empty"});
  expect_input_error([] { targets_of(R"([{"scene_id": 1, "im_id": [["a", 1, 2]]}])"); },
                     {"/0/im_id/0", "3 values"});
  expect_input_error([] { targets_of(R"([{"scene_id": 1, "im_id": 1, "obj_id": "a"}])"); },
                     {"/0/obj_id"});
  expect_input_error(
      [] { targets_of(R"([{"scene_id": 1, "im_id": 1, "obj_id": 1, "inst_count": -1}])"); },
      {"/0/inst_count", "negative"});
}

}  // namespace
}  // namespace edgescout::test
