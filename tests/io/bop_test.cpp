#include "host/io/bop.h"

#include <gtest/gtest.h>

#include "tests/io/collected_log.h"
#include "tests/io/expect_input_error.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

using Eigen::Vector3d;

Se3 sample_pose(double seed) {
  return {so3_exp(Vector3d(0.3 * seed, -0.7, 1.1)), Vector3d(0.1 * seed, -0.02, 0.6 + seed)};
}

void expect_same(const Se3& a, const Se3& b) {
  EXPECT_LT(angle_between_rad(a, b), 1e-7);
  EXPECT_LT(distance_between_m(a, b), 1e-12);
}

BopScene sample_scene() {
  BopScene scene;
  BopImage first, second;
  first.image_id = 3;
  first.camera = {640, 480, 600, 610, 320, 240, {0.1, -0.2, 0.001, 0.002, 0.3, 0, 0, 0}};
  first.camera_from_world = sample_pose(2);
  second.image_id = 12;
  second.camera = {640, 480, 500, 510, 321, 241, {}};
  scene.images = {first, second};
  scene.truth[3] = {{1, sample_pose(0.1), 0.75}, {4, sample_pose(0.2), 1.0}};
  scene.truth[12] = {};
  return scene;
}

TEST(BopScene, ReadsBackWhatWasWritten) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "000048");
  EXPECT_FALSE(is_bop_scene(folder.path() / "000048"));
  const BopScene scene = sample_scene();
  save_bop_scene(scene, folder.path() / "000048");
  folder.write("000048/gray/000003.png", "");
  folder.write("000048/rgb/000012.jpg", "");
  EXPECT_TRUE(is_bop_scene(folder.path() / "000048"));
  const BopScene back = load_bop_scene(folder.path() / "000048" / "");
  EXPECT_EQ(back.scene_id, 48);
  ASSERT_EQ(back.images.size(), 2u);
  EXPECT_EQ(back.images[0].image_id, 3);
  EXPECT_EQ(back.images[0].file.filename(), "000003.png");
  EXPECT_EQ(back.images[1].file, back.folder / "rgb" / "000012.jpg");
  EXPECT_EQ(back.images[0].camera.distortion, scene.images[0].camera.distortion);
  EXPECT_EQ(back.images[0].camera.fy, 610);
  EXPECT_EQ(back.images[0].camera.width, 0);
  ASSERT_TRUE(back.images[0].camera_from_world);
  expect_same(*back.images[0].camera_from_world, *scene.images[0].camera_from_world);
  EXPECT_FALSE(back.images[1].camera_from_world);
  ASSERT_EQ(back.truth.at(3).size(), 2u);
  EXPECT_EQ(back.truth.at(3)[1].object_id, 4);
  EXPECT_EQ(back.truth.at(3)[0].visible_fraction, 0.75);
  expect_same(back.truth.at(3)[1].camera_from_object, scene.truth.at(3)[1].camera_from_object);
}

TEST(BopScene, ReadsMillimetresAndLivesWithoutTruthInfoOrImages) {
  const TemporaryFolder folder;
  folder.write("s/scene_camera.json",
               R"({"10": {"cam_K": [5,0,3,0,6,4,0,0,1]}, "9": {"cam_K": [5,0,3,0,6,4,0,0,1]}})");
  const BopScene bare = load_bop_scene(folder.path() / "s");
  EXPECT_EQ(bare.scene_id, 0);
  EXPECT_TRUE(bare.truth.empty());
  ASSERT_EQ(bare.images.size(), 2u);
  EXPECT_EQ(bare.images[0].image_id, 9);  // by number, not by text
  EXPECT_EQ(bare.images[0].file.filename(), "000009.png");
  folder.write(
      "s/scene_gt.json",
      R"({"9": [{"obj_id": 2, "cam_R_m2c": [1,0,0,0,1,0,0,0,1], "cam_t_m2c": [10, -20, 500]}]})");
  const BopTruth truth = load_bop_scene(folder.path() / "s").truth.at(9).at(0);
  EXPECT_LT((truth.camera_from_object.translation_m - Vector3d(0.01, -0.02, 0.5)).norm(), 1e-15);
  EXPECT_EQ(truth.visible_fraction, 1);
}

// An image without any counts false positives. Keys may be padded, as file names are.
TEST(BopScene, KnowsImagesWithoutObjects) {
  const TemporaryFolder folder;
  folder.write(
      "s/scene_gt.json",
      R"({"000009": [{"obj_id": 2, "cam_R_m2c": [1,0,0,0,1,0,0,0,1], "cam_t_m2c": [0, 0, 500]}], "10": []})");
  folder.write("s/scene_gt_info.json", R"({"000009": [{"visib_fract": 0.25}]})");
  folder.write("s/scene_camera.json",
               R"({"10": {"cam_K": [5,0,3,0,6,4,0,0,1]}, "9": {"cam_K": [5,0,3,0,6,4,0,0,1]}})");
  const BopScene scene = load_bop_scene(folder.path() / "s");
  EXPECT_EQ(scene.truth.at(9).at(0).visible_fraction, 0.25);
  EXPECT_TRUE(scene.truth.at(10).empty());
}

TEST(BopScene, HasItsNumberFromInsideTheFolderToo) {
  const TemporaryFolder folder;
  folder.write("000048/scene_camera.json", "{}");
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path() / "000048");
  EXPECT_EQ(load_bop_scene(".").scene_id, 48);
  EXPECT_EQ(load_bop_scene("../000048/").scene_id, 48);
  std::filesystem::current_path(before);
}

TEST(BopScene, NamesFileAndFieldOfWhatIsWrong) {
  const TemporaryFolder folder;
  const auto load = [&](const std::string& camera, const std::string& truth = "{}") {
    folder.write("scene_camera.json", camera);
    folder.write("scene_gt.json", truth);
    load_bop_scene(folder.path());
  };
  const std::string good = R"({"1": {"cam_K": [5,0,3,0,6,4,0,0,1]}})";
  expect_input_error([&] { load_bop_scene(folder.path() / "none"); },
                     {"scene_camera.json", "No such file"});
  expect_input_error([&] { load("[1"); }, {"scene_camera.json", "JSON"});
  expect_input_error([&] { load(R"({"x": {"cam_K": [5,0,3,0,6,4,0,0,1]}})"); },
                     {"scene_camera.json", "\"x\""});
  expect_input_error([&] { load(R"({"1": {"cam_K": [5,0,3,0,6,4,0,0]}})"); },
                     {"1/cam_K", "8 numbers"});
  expect_input_error([&] { load(R"({"1": {"cam_K": [-5,0,3,0,6,4,0,0,1]}})"); },
                     {"/1", "fx", "positive"});
  expect_input_error(
      [&] { load(R"({"1": {"cam_K": [5,0,3,0,6,4,0,0,1], "cam_R_w2c": [1,0,0,0,1,0,0,0,1]}})"); },
      {"/1/cam_t_w2c"});
  expect_input_error(
      [&] {
        load(good,
             R"({"1": [{"obj_id": 1, "cam_R_m2c": [2,0,0,0,1,0,0,0,1], "cam_t_m2c": [0,0,1]}]})");
      },
      {"scene_gt.json", "/1/0/cam_R_m2c", "no rotation"});
  expect_input_error(
      [&] { load(good, R"({"1": [{"cam_R_m2c": [1,0,0,0,1,0,0,0,1], "cam_t_m2c": [0,0,1]}]})"); },
      {"/1/0/obj_id"});
}

// The last of two equal fields would count without a word.
TEST(BopScene, NamesFieldsThatStandTwice) {
  const TemporaryFolder folder;
  const std::string image = R"({"cam_K": [5,0,3,0,6,4,0,0,1]})";
  const std::string object =
      R"({"obj_id": 1, "cam_R_m2c": [1,0,0,0,1,0,0,0,1], "cam_t_m2c": [0,0,1]})";
  const auto refused = [&](const std::string& file, const std::string& content,
                           std::initializer_list<std::string> words) {
    folder.write("scene_camera.json", "{\"1\": " + image + "}");
    folder.write("scene_gt.json", "{\"1\": [" + object + "]}");
    folder.write("scene_gt_info.json", "{}");
    folder.write(file, content);
    expect_input_error([&] { load_bop_scene(folder.path()); }, words);
  };
  const auto twice = [](const std::string& key, const std::string& other,
                        const std::string& value) {
    return "{\"" + key + "\": " + value + ", \"" + other + "\": " + value + "}";
  };
  for (const char* file : {"scene_camera.json", "scene_gt.json", "scene_gt_info.json"}) {
    const std::string value = file == std::string("scene_camera.json") ? image : "[" + object + "]";
    refused(file, twice("7", "7", value), {file, "7", "twice"});
    refused(file, twice("000007", "7", value), {file, "/7", "same number"});
  }
  refused("scene_gt.json", R"({"1": [{"obj_id": 1, "obj_id": 2}]})",
          {"scene_gt.json", "obj_id", "twice"});
}

// A matrix of one scene with `error` added to one number.
std::string scene_gt_with_error(double error) {
  return R"({"1": [{"obj_id": 1, "cam_R_m2c": [)" + std::to_string(1 + error) +
         R"(,0,0,0,1,0,0,0,1], "cam_t_m2c": [0,0,1]}]})";
}

TEST(BopScene, ProjectsRotationsThatAreNearlyOneAndSaysSoOnceAFile) {
  const TemporaryFolder folder;
  folder.write("scene_camera.json",
               R"({"1": {"cam_K": [5,0,3,0,6,4,0,0,1], "cam_R_w2c": [1.004,0,0,0,1,0,0,0,1],
                         "cam_t_w2c": [0,0,1]},
                   "2": {"cam_K": [5,0,3,0,6,4,0,0,1], "cam_R_w2c": [1,0.008,0,0,1,0,0,0,1],
                         "cam_t_w2c": [0,0,1]}})");
  folder.write("scene_gt.json", scene_gt_with_error(0.009));
  CollectedLog log;
  const BopScene scene = load_bop_scene(folder.path());
  EXPECT_LT(angle_between_rad(scene.truth.at(1)[0].camera_from_object, Se3{}), 1e-12);
  ASSERT_EQ(log.messages.size(), 2u);
  EXPECT_NE(log.messages[0].second.find("scene_camera.json: found 2 matrices"), std::string::npos)
      << log.messages[0].second;
  EXPECT_NE(log.messages[1].second.find("scene_gt.json: found 1 matrix"), std::string::npos)
      << log.messages[1].second;
  folder.write("scene_gt.json", scene_gt_with_error(0.02));
  expect_input_error([&] { load_bop_scene(folder.path()); },
                     {"scene_gt.json", "/1/0/cam_R_m2c", "no rotation", "0.01"});
}

TEST(BopScene, IsReadWithoutItsTruth) {
  const TemporaryFolder folder;
  folder.write("scene_camera.json", R"({"1": {"cam_K": [5,0,3,0,6,4,0,0,1]}})");
  folder.write("scene_gt.json", scene_gt_with_error(0));
  for (const char* info : {R"({"1": [{"visib_fract": null}]})", "[1", R"({"1": []})", "{}"}) {
    folder.write("scene_gt_info.json", info);
    EXPECT_EQ(load_bop_images(folder.path()).images.size(), 1u);
    expect_input_error([&] { load_bop_scene(folder.path()); }, {"scene_gt_info.json"});
  }
  folder.write("scene_gt_info.json", R"({"1": [{"visib_fract": null}]})");
  expect_input_error([&] { load_bop_scene(folder.path()); }, {"/1/0/visib_fract", "null"});
  folder.write("scene_gt.json", "broken");
  EXPECT_EQ(load_bop_images(folder.path()).images.size(), 1u);
}

TEST(BopResults, ReadBackExactly) {
  const TemporaryFolder folder;
  const std::vector<BopResult> results{{48, 3, 1, 0.123456789012345678, sample_pose(0.1), 0.25, ""},
                                       {48, 4, 2, 1, sample_pose(0.2), -1, ""}};
  save_bop_results(results, folder.path() / "r.csv");
  const std::string text = content_of(folder.path() / "r.csv");
  EXPECT_TRUE(text.starts_with("scene_id,im_id,obj_id,score,R,t,time\n48,3,1,0.12345678901234568,"))
      << text;
  const std::vector<BopResult> back = load_bop_results(folder.path() / "r.csv");
  ASSERT_EQ(back.size(), 2u);
  EXPECT_EQ(back[0].scene_id, 48);
  EXPECT_EQ(back[1].image_id, 4);
  EXPECT_EQ(back[1].object_id, 2);
  EXPECT_EQ(back[0].score, results[0].score);
  EXPECT_EQ(back[0].time_s, 0.25);
  for (int i = 0; i < 2; ++i)
    expect_same(back[i].camera_from_object, results[i].camera_from_object);
}

TEST(BopResults, ReadsWhatOtherToolsWrite) {
  const TemporaryFolder folder;
  const auto file = folder.write("r.csv",
                                 "1,2,3,-0.5,1 0 0 0 1 0 0 0 1, 10.0 20 3e2 "
                                 ",-1\r\n\r\n1,2,3,5e-1,1 0 0 0 1 0 0 0 1,1 2 3,0.1");
  const std::vector<BopResult> results = load_bop_results(file);
  ASSERT_EQ(results.size(), 2u);
  EXPECT_LT((results[0].camera_from_object.translation_m - Vector3d(0.01, 0.02, 0.3)).norm(),
            1e-15);
  EXPECT_EQ(results[1].score, 0.5);
}

// Two rows of one pose, under names and in forms that other programs give them.
TEST(BopResults, ReadsColumnsByTheirNames) {
  const TemporaryFolder folder;
  const std::string pose = "0 -1 0 1 0 0 0 0 1", header = "scene_id,im_id,obj_id,score,R,t,time\n";
  const std::string files[] = {
      header + "1,2,3,0.5," + pose + ",10 20 30,0.1\n",
      "obj_id,score,t,im_id,R,scene_id\n3,0.5,10 20 30,2," + pose + ",1\n",
      "scene_id,image_id,obj_id,score,R,t,time,iou\n1,2,3,0.5," + pose + ",10 20 30,-1,0.7\n",
      "," + header + "0,1,2,3,0.5," + pose + ",10 20 30,0.1\n",
      "# by x\nScene_ID;Im_ID;Obj_ID;Score;R;T;Time\n1;2;3;0.5;" + pose + ";10 20 30;\n",
      "1\t2\t3\t0.5\t" + pose + "\t10 20 30\t0.1\n",
      R"("scene_id","im_id","obj_id","score","R","t","time"
"1","2","3","0.5","[0, -1, 0, 1, 0, 0, 0, 0, 1]","[10, 20, 30]","1"
)",
      header + "1,2,3,0.5,[" + pose + "],[10. 20. 30.],0.1,\n",
      "scene_id,im_id,obj_id,score,R,t,time\r1,2,3,0.5," + pose + ",10 20 30,0.1\r"};
  for (const std::string& text : files) {
    const std::vector<BopResult> results = load_bop_results(folder.write("r.csv", text));
    ASSERT_EQ(results.size(), 1u) << text;
    EXPECT_EQ(results[0].scene_id, 1) << text;
    EXPECT_EQ(results[0].image_id, 2) << text;
    EXPECT_EQ(results[0].object_id, 3) << text;
    EXPECT_EQ(results[0].score, 0.5) << text;
    const Se3& found = results[0].camera_from_object;
    EXPECT_LT((found.translation_m - Vector3d(0.01, 0.02, 0.03)).norm(), 1e-15) << text;
    EXPECT_LT((found.rotation * Vector3d::UnitX() - Vector3d::UnitY()).norm(), 1e-12) << text;
  }
  const auto refused = [&](const std::string& text, std::initializer_list<std::string> words) {
    expect_input_error([&] { load_bop_results(folder.write("r.csv", text)); }, words);
  };
  refused("scene_id,im_id,obj_id,score,R\n1,2,3,0.5," + pose + "\n", {"line 1", "columns"});
  refused("scene_id,im_id,obj_id,score,R,t,R\n", {"line 1", "R", "twice"});
  refused("scene_id;im_id;obj_id;score;R;t\n1;2;3;0,5;" + pose + ";1 2 3\n",
          {"line 2", "0,5", "decimal point"});
}

// A failed estimate is no reason to refuse the others.
TEST(BopResults, LeaveOutRowsWithoutPose) {
  const TemporaryFolder folder;
  const std::string good = "1,2,3,0.5,1 0 0 0 1 0 0 0 1,1 2 3,0.1\n";
  const auto twice_among_good = [&](const std::string& row) {
    return good + row + "\n" + row + "\n" + good;
  };
  for (const std::string row :
       {"1,2,3,0.1,nan nan nan nan nan nan nan nan nan,nan nan nan,-1",
        "1,2,3,0.1,0 0 0 0 0 0 0 0 0,0 0 0,-1", "1,2,3,0.1,1 0 0 0 1 0 0 0,1 2 3,0.1",
        "1,2,3,0.1,1 0 0 0 1 0 0 0 1,1 2,0.1", "1,2,3,0.1,1 0 0 0 1 0 0 0 1,1 inf 3,0.1",
        "1,2,3,0.1,1 0 0 0 1 0 0 0 -1,1 2 3,0.1", "1,2,3,nan,1 0 0 0 1 0 0 0 1,1 2 3,0.1",
        "1,2,3,0.1,,,0.1", "1,2,3,0.1,1 0 0"}) {
    CollectedLog log;
    const auto file = folder.write("r.csv", twice_among_good(row));
    const BopResultRows rows = load_bop_result_rows(file);
    EXPECT_EQ(rows.results.size(), 2u) << row;
    EXPECT_EQ(rows.rows_without_pose, 2) << row;
    ASSERT_EQ(log.messages.size(), 1u) << row;
    for (const char* words : {"r.csv: 2 of 4 rows hold no pose", "line 2"})
      EXPECT_NE(log.messages[0].second.find(words), std::string::npos) << log.messages[0].second;
  }
}

TEST(BopResults, AreNoEmptyFile) {
  const TemporaryFolder folder;
  for (const char* empty : {"", "\n", "# no rows\n"})
    expect_input_error([&] { load_bop_results(folder.write("r.csv", empty)); },
                       {"r.csv", "nothing", "scene_id,im_id"});
  EXPECT_TRUE(
      load_bop_results(folder.write("r.csv", "scene_id,im_id,obj_id,score,R,t,time\n")).empty());
}

TEST(BopResults, ReadMarksOfOtherSystems) {
  const TemporaryFolder folder;
  CollectedLog log;
  const auto file = folder.write("r.csv",
                                 "\xef\xbb\xbfscene_id,im_id,obj_id,score,R,t,time\r\n"
                                 "1,2,3,0.5,1 0 0 0 1 0 0 0 1,1 2 3,nan\r\n\r\n");
  const std::vector<BopResult> results = load_bop_results(file);
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0].time_s, -1);
  EXPECT_TRUE(log.messages.empty());
  expect_input_error([&] { load_bop_results(folder.write("r.csv", "\xff\xfes\0c\0")); },
                     {"r.csv", "UTF-16"});
}

TEST(BopResults, TellTheCamera) {
  const TemporaryFolder folder;
  std::vector<BopResult> results{{48, 3, 1, 0.5, sample_pose(0.1), 0.25, "cam1"},
                                 {48, 3, 1, 0.5, sample_pose(0.1), 0.25, "photoneo"}};
  save_bop_results(results, folder.path() / "r.csv");
  const std::vector<BopResult> back = load_bop_results(folder.path() / "r.csv");
  ASSERT_EQ(back.size(), 2u);
  EXPECT_EQ(back[0].camera_name, "cam1");
  EXPECT_EQ(back[1].camera_name, "photoneo");
}

// As BOP's own files are: 0.002 off.
TEST(BopResults, ProjectRotationsThatAreNearlyOne) {
  const TemporaryFolder folder;
  CollectedLog log;
  const std::string row = "1,2,3,0.5,1.002 0.001 0 0 0.998 0 0 0 1.001,1 2 3,0.1\n";
  const std::vector<BopResult> results = load_bop_results(folder.write("r.csv", row + row));
  ASSERT_EQ(results.size(), 2u);
  EXPECT_LT(angle_between_rad(results[0].camera_from_object, Se3{}), 0.001);
  ASSERT_EQ(log.messages.size(), 1u);
  EXPECT_NE(log.messages[0].second.find("r.csv: found 2 matrices"), std::string::npos)
      << log.messages[0].second;
}

TEST(BopResults, NamesTheLineOfWhatIsWrong) {
  const TemporaryFolder folder;
  const auto load = [&](const std::string& line) {
    load_bop_results(folder.write("r.csv", "scene_id,im_id,obj_id,score,R,t,time\n" + line + "\n"));
  };
  expect_input_error([&] { load("1,2,3"); }, {"r.csv", "line 2", "fields", "3"});
  expect_input_error([&] { load("1,2,3,x,1 0 0 0 1 0 0 0 1,1 2 3,0.1"); }, {"line 2", "score"});
  expect_input_error([&] { load("1,2,3,nan,1 0 0 0 1 0 0 0 1,1 2 3,0.1"); },
                     {"line 2", "score", "not finite"});
  expect_input_error([&] { load("1,2,3,1,1 0 0 0 1 0 0 0,1 2 3,0.1"); },
                     {"line 2", "R", "8 numbers"});
  expect_input_error([&] { load("1,2,3,1,1 0 0 0 1 0 0 0 2,1 2 3,0.1"); },
                     {"line 2", "R", "no rotation"});
  expect_input_error([&] { load("1,2.5,3,1,1 0 0 0 1 0 0 0 1,1 2 3,0.1"); },
                     {"line 2", "im_id", "2.5"});
}

}  // namespace
}  // namespace edgescout::test
