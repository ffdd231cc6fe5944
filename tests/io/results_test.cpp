#include "host/io/results.h"

#include <gtest/gtest.h>

#include <cmath>

#include "host/io/bop.h"
#include "host/io/poses.h"
#include "tests/io/expect_input_error.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

using Eigen::Vector3d;

Detection sample_detection(int object, double seed) {
  Detection d;
  d.object = object;
  d.world_from_object = {so3_exp(Vector3d(seed, -2 * seed, 0.5)), Vector3d(0.1, seed, 0.7)};
  for (int i = 0; i < 36; ++i)
    d.covariance(i / 6, i % 6) = seed + i;  // not symmetric, to see the order
  d.probability = 0.9;
  d.psi = 0.8;
  d.cost_px = 1.25;
  d.matched_fraction = 0.6;
  d.psi_z_score = 7.5;
  d.unexplained_grey = 0.25;
  d.convergence = "small step";
  d.alternatives = {{{so3_exp(Vector3d(0, 0, seed)), Vector3d(seed, 0, 1)}, 0.4}, {Se3{}, 0.3}};
  return d;
}

ImageResult sample_result() {
  ImageResult r;
  r.image = "images/000012.png";
  r.scene_id = 48;
  r.image_id = 12;
  r.camera = {640, 480, 600, 601, 320, 240, {0.1, 0, 0, 0, 0, 0, 0, 0}};
  r.device = "cpu";
  r.settings = {{"lambda", "100"}, {"verb", "detect"}};
  r.stages = {{"edges", 0.012}, {"tensor", 0.1}, {"edges", 0.003}};
  r.camera_from_world = Se3{so3_exp(Vector3d(0, 0.3, 0)), Vector3d(0, 0, 0.2)};
  r.objects = {{3, "bracket"}, {7, "cat"}};
  r.detections = {sample_detection(1, 0.1), sample_detection(0, 0.2)};
  return r;
}

TEST(ImageResult, ReadsBackWhatWasWritten) {
  const TemporaryFolder folder;
  const ImageResult r = sample_result();
  save_image_result(r, folder.path() / "r.json");
  EXPECT_EQ(folder.entries(), 1u);
  EXPECT_TRUE(is_image_result(folder.path() / "r.json"));
  const ImageResult back = load_image_result(folder.path() / "r.json");
  EXPECT_EQ(back.image, r.image);
  EXPECT_EQ(back.scene_id, 48);
  EXPECT_EQ(back.image_id, 12);
  EXPECT_EQ(back.camera.fy, 601);
  EXPECT_EQ(back.camera.distortion, r.camera.distortion);
  EXPECT_EQ(back.device, "cpu");
  EXPECT_EQ(back.settings, r.settings);
  ASSERT_EQ(back.stages.size(), 3u);
  EXPECT_EQ(back.stages[2].name, "edges");
  EXPECT_DOUBLE_EQ(back.stages[2].seconds, 0.003);
  ASSERT_TRUE(back.camera_from_world);
  EXPECT_LT(angle_between_rad(*back.camera_from_world, *r.camera_from_world), 1e-7);
  ASSERT_EQ(back.objects.size(), 2u);
  EXPECT_EQ(back.objects[1].name, "cat");
  ASSERT_EQ(back.detections.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const Detection &a = r.detections[i], &b = back.detections[i];
    EXPECT_EQ(b.object, a.object);
    EXPECT_LT(angle_between_rad(a.world_from_object, b.world_from_object), 1e-7);
    EXPECT_EQ(b.world_from_object.translation_m, a.world_from_object.translation_m);
    EXPECT_EQ(b.covariance, a.covariance);
    EXPECT_EQ(b.probability, a.probability);
    EXPECT_EQ(b.psi, a.psi);
    EXPECT_EQ(b.cost_px, a.cost_px);
    EXPECT_EQ(b.matched_fraction, a.matched_fraction);
    EXPECT_EQ(b.psi_z_score, a.psi_z_score);
    EXPECT_EQ(b.unexplained_grey, a.unexplained_grey);
    EXPECT_EQ(b.convergence, a.convergence);
    ASSERT_EQ(b.alternatives.size(), 2u);
    for (std::size_t n = 0; n < 2; ++n) {
      const AlternativePose &c = a.alternatives[n], &d = b.alternatives[n];
      EXPECT_LT(angle_between_rad(c.world_from_object, d.world_from_object), 1e-7);
      EXPECT_EQ(d.world_from_object.translation_m, c.world_from_object.translation_m);
      EXPECT_EQ(d.probability, c.probability);
    }
  }
}

TEST(ImageResult, StatesPosesByRowInMetresAndCovariancesByRow) {
  const TemporaryFolder folder;
  ImageResult r = sample_result();
  r.camera_from_world.reset();
  r.detections.resize(1);
  // A quarter turn about z: x -> y.
  r.detections[0].world_from_object = {Eigen::Quaterniond(std::sqrt(0.5), 0, 0, std::sqrt(0.5)),
                                       Vector3d(1, 2, 3)};
  save_image_result(r, folder.path() / "r.json");
  std::string text = content_of(folder.path() / "r.json");
  std::erase_if(text, [](char c) { return c == ' ' || c == '\n'; });
  EXPECT_NE(text.find("\"object_id\":7,\"object\":\"cat\""), std::string::npos) << text;
  EXPECT_NE(text.find("\"t\":[1.0,2.0,3.0]"), std::string::npos) << text;
  EXPECT_NE(text.find("\"quaternion_wxyz\":[0.7071067811865476,0.0,0.0,0.7071067811865476]"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("\"covariance\":[0.1,1.1,2.1,3.1,"), std::string::npos) << text;
  EXPECT_EQ(text.find("camera_from_world"), std::string::npos);
  EXPECT_NE(text.find("\"world\":\"camera\""), std::string::npos) << text;
  const std::vector<StartPose> poses = load_start_poses(folder.path() / "r.json");
  const Eigen::Matrix3d rotation = poses.at(0).camera_from_object.rotation.toRotationMatrix();
  EXPECT_LT((rotation * Vector3d::UnitX() - Vector3d::UnitY()).norm(), 1e-12);
}

TEST(ImageResult, SurvivesNumbersThatAreNotFiniteAndNamesThatAreNoUtf8) {
  const TemporaryFolder folder;
  ImageResult r = sample_result();
  r.detections[0].covariance(2, 3) = HUGE_VAL;
  r.detections[0].psi = std::nan("");
  r.image = "\xff\xfe.png";
  save_image_result(r, folder.path() / "r.json");
  const ImageResult back = load_image_result(folder.path() / "r.json");
  EXPECT_TRUE(std::isnan(back.detections[0].covariance(2, 3)));
  EXPECT_TRUE(std::isnan(back.detections[0].psi));
  EXPECT_EQ(back.detections[0].covariance(3, 2), r.detections[0].covariance(3, 2));
}

TEST(ImageResult, RejectsOtherVersionsAndFilesCutShort) {
  const TemporaryFolder folder;
  save_image_result(sample_result(), folder.path() / "r.json");
  const std::string whole = content_of(folder.path() / "r.json");
  for (std::size_t i = 0; i < 50; ++i) {
    const auto cut =
        folder.write("cut.json", std::string_view(whole).substr(0, whole.size() * i / 50));
    expect_input_error([&] { load_image_result(cut); }, {"cut.json"});
  }
  std::string newer = whole;
  newer.replace(newer.find("\"edgescout_result\": 3"), 21, "\"edgescout_result\": 4");
  expect_input_error([&] { load_image_result(folder.write("new.json", newer)); },
                     {"new.json", "/edgescout_result", "found 4", "expected version 2 or 3"});
  std::string older = whole;
  older.replace(older.find("\"edgescout_result\": 3"), 21, "\"edgescout_result\": 1");
  expect_input_error([&] { load_image_result(folder.write("old.json", older)); },
                     {"old.json", "/edgescout_result", "found 1", "expected version 2 or 3"});
  expect_input_error([&] { load_image_result(folder.write("other.json", "{}")); },
                     {"other.json", "/edgescout_result"});
  std::string alien = whole;
  alien.replace(alien.find("\"object_id\": 7"), 14, "\"object_id\": 8");
  expect_input_error([&] { load_image_result(folder.write("a.json", alien)); },
                     {"a.json", "/detections/0/object_id", "8"});
}

// The same file with every occurrence of `from` replaced.
std::string all_replaced(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

TEST(ImageResult, ReadsThePsiZScoreOfVersions2And3) {
  const TemporaryFolder folder;
  save_image_result(sample_result(), folder.path() / "r.json");
  const std::string version_3 = content_of(folder.path() / "r.json");
  EXPECT_NE(version_3.find("\"edgescout_result\": 3"), std::string::npos);
  EXPECT_NE(version_3.find("\"psi_z_score\": 7.5"), std::string::npos);
  EXPECT_EQ(version_3.find("evidence"), std::string::npos);
  const std::string version_2 =
      all_replaced(all_replaced(version_3, "\"edgescout_result\": 3", "\"edgescout_result\": 2"),
                   "psi_z_score", "evidence");
  const ImageResult back = load_image_result(folder.write("old.json", version_2));
  ASSERT_EQ(back.detections.size(), 2u);
  EXPECT_EQ(back.detections[0].psi_z_score, 7.5);
  EXPECT_EQ(back.detections[1].psi_z_score, 7.5);
  EXPECT_EQ(back.detections[0].psi, 0.8);
}

TEST(ImageResult, ReadsDetectionsWithoutAlternatives) {
  const TemporaryFolder folder;
  save_image_result(sample_result(), folder.path() / "r.json");
  const std::string older =
      all_replaced(content_of(folder.path() / "r.json"), "\"alternatives\"", "\"unknown\"");
  EXPECT_TRUE(
      load_image_result(folder.write("old.json", older)).detections[0].alternatives.empty());
}

TEST(ImageResult, RefusesAFieldOfTheOtherVersion) {
  const TemporaryFolder folder;
  save_image_result(sample_result(), folder.path() / "r.json");
  const std::string version_3 = content_of(folder.path() / "r.json");
  const std::string named_as_in_2 = all_replaced(version_3, "psi_z_score", "evidence"),
                    numbered_as_2 = all_replaced(version_3, "\"edgescout_result\": 3",
                                                 "\"edgescout_result\": 2");
  expect_input_error([&] { load_image_result(folder.write("a.json", named_as_in_2)); },
                     {"a.json", "/detections/0/psi_z_score"});
  expect_input_error([&] { load_image_result(folder.write("b.json", numbered_as_2)); },
                     {"b.json", "/detections/0/evidence"});
}

TEST(StartPoses, ComeFromOurOwnResultsInTheCameraFrame) {
  const TemporaryFolder folder;
  const ImageResult r = sample_result();
  save_image_result(r, folder.path() / "r.json");
  const std::vector<StartPose> poses = load_start_poses(folder.path() / "r.json");
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_EQ(poses[0].object_id, 7);
  EXPECT_EQ(poses[0].score, 0.9);
  const Se3 expected = *r.camera_from_world * r.detections[0].world_from_object;
  EXPECT_LT(angle_between_rad(poses[0].camera_from_object, expected), 1e-7);
  EXPECT_LT(distance_between_m(poses[0].camera_from_object, expected), 1e-12);
  EXPECT_TRUE(belongs_to(poses[0], {"elsewhere/000012.png", 48, 12, ""}));
  EXPECT_FALSE(belongs_to(poses[0], {"elsewhere/000013.png", 48, 12, ""}));
  EXPECT_FALSE(belongs_to(poses[0], {"elsewhere/000012.png", 47, 12, ""}));
}

TEST(StartPoses, ComeFromABopResultsFile) {
  const TemporaryFolder folder;
  const auto file = folder.write(
      "r.csv",
      "scene_id,im_id,obj_id,score,R,t,time\n48,12,3,0.7,1 0 0 0 1 0 0 0 1,10 20 300,-1\n");
  const std::vector<StartPose> poses = load_start_poses(file);
  ASSERT_EQ(poses.size(), 1u);
  EXPECT_EQ(poses[0].object_id, 3);
  EXPECT_EQ(poses[0].score, 0.7);
  EXPECT_LT((poses[0].camera_from_object.translation_m - Vector3d(0.01, 0.02, 0.3)).norm(), 1e-15);
  EXPECT_TRUE(belongs_to(poses[0], {"any.png", 48, 12, ""}));
  EXPECT_FALSE(belongs_to(poses[0], {"any.png", 48, 13, ""}));
  EXPECT_FALSE(belongs_to(poses[0], {"any.png", 0, 12, ""}));  // 0 is a scene like any other
  EXPECT_TRUE(belongs_to(poses[0], {"any.png", std::nullopt, 12, ""}));
}

TEST(StartPoses, ComeFromAPlainList) {
  const TemporaryFolder folder;
  const auto file = folder.write("p.json", R"([
    {"image": 12, "object": 3, "R": [1,0,0,0,1,0,0,0,1], "t": [0.1, 0.2, 0.3]},
    {"image": "a/b.png", "object": 4, "R": [0,-1,0,1,0,0,0,0,1], "t": [0, 0, 1], "scene": 5, "score": 0.5}])");
  const std::vector<StartPose> poses = load_start_poses(file);
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_TRUE(belongs_to(poses[0], {"x.png", 99, 12, ""}));
  EXPECT_TRUE(belongs_to(poses[1], {"b.png", 5, 0, ""}));
  EXPECT_EQ(same_ending(poses[1], "/images/a/b.png"), 2);
  EXPECT_EQ(same_ending(poses[1], "/images/x/b.png"), 1);
  EXPECT_EQ(same_ending(poses[1], "/b.png"), 1);
  EXPECT_EQ(same_ending(poses[1], "/a/x.png"), 0);
  StartPose of_latin_1;  // as in a result of the image
  of_latin_1.image = "a\xef\xbf\xbd/caf\xef\xbf\xbd.png";
  EXPECT_TRUE(belongs_to(of_latin_1, {"caf\xe9.png", std::nullopt, 0, ""}));
  EXPECT_EQ(same_ending(of_latin_1, "/a\xe9/caf\xe9.png"), 2);
  EXPECT_FALSE(belongs_to(poses[1], {"b.png", 6, 0, ""}));
  EXPECT_LT((poses[1].camera_from_object * Vector3d::UnitX() - Vector3d(0, 1, 1)).norm(), 1e-12);
  const auto bad = [&](const std::string& text) {
    load_start_poses(folder.write("bad.json", text));
  };
  expect_input_error([&] { bad(R"([{"object": 3, "R": [1,0,0,0,1,0,0,0,1], "t": [0,0,1]}])"); },
                     {"bad.json", "/0/image"});
  expect_input_error(
      [&] { bad(R"([{"image": 1, "object": 3, "R": [1,0,0,0,1,0,0,0], "t": [0,0,1]}])"); },
      {"/0/R", "8 numbers"});
  expect_input_error(
      [&] { bad(R"([{"image": 1, "object": 3, "R": [1,0,0,0,1,0,0,0,1], "t": [0,null,1]}])"); },
      {"/0/t/1", "null"});
  expect_input_error([&] { bad(R"({"poses": []})"); }, {"bad.json", "poses", "a whole number"});
}

TEST(StartPoses, ComeFromTheTruthOfABopScene) {
  const TemporaryFolder folder;
  const auto file = folder.write("scene_gt.json", R"({"12": [
    {"cam_R_m2c": [0,-1,0,1,0,0,0,0,1], "cam_t_m2c": [10, 20, 300], "obj_id": 3},
    {"cam_R_m2c": [1,0,0,0,1,0,0,0,1], "cam_t_m2c": [0, 0, 500], "obj_id": 4}], "13": []})");
  const std::vector<StartPose> poses = load_start_poses(file);
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_EQ(poses[0].object_id, 3);
  EXPECT_TRUE(belongs_to(poses[1], {"any.png", 48, 12, ""}));
  EXPECT_FALSE(belongs_to(poses[1], {"any.png", 48, 13, ""}));
  EXPECT_LT((poses[0].camera_from_object * Vector3d::UnitX() - Vector3d(0.01, 1.02, 0.3)).norm(),
            1e-12);
}

TEST(StartPoses, AreOneOrHaveMatricesOfRows) {
  const TemporaryFolder folder;
  const std::string pose =
      R"({"image": 1, "object": 3, "R": [[0,-1,0],[1,0,0],[0,0,1]], "t": [0, 0, 1]})";
  for (const std::string& text : {pose, "[" + pose + "]"}) {
    const std::vector<StartPose> poses = load_start_poses(folder.write("p.json", text));
    ASSERT_EQ(poses.size(), 1u);
    EXPECT_LT((poses[0].camera_from_object * Vector3d::UnitX() - Vector3d(0, 1, 1)).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace edgescout::test
