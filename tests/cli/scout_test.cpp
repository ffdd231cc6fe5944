// edgescout scout: its results, and the page that needs no other file.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "host/active/views.h"
#include "host/io/json_fields.h"
#include "host/io/results.h"
#include "kernels/backend.h"
#include "tests/cli/small_scout.h"

namespace edgescout::test {
namespace {

TEST(Scout, FindsThePartAndShowsHow) {
  SmallScout t;
  t.max_views = "3";
  const Outcome outcome = run_program(t.arguments());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("1 objects in 3 images, 0 views failed"), std::string::npos)
      << outcome.out;
  const nlohmann::json log = t.log();
  EXPECT_EQ(log.at("end"), "view budget");
  EXPECT_EQ(log.at("camera").at("width"), 320);
  EXPECT_EQ(log["camera"].at("fx"), 400);
  EXPECT_EQ(log.at("planning").at("max-views"), "3");
  EXPECT_EQ(log["planning"].at("combinations"), "200");
  EXPECT_EQ(log["planning"].at("first-view"), "0");
  ASSERT_EQ(log.at("steps").size(), 3u);
  ASSERT_EQ(log.at("views").size(), 8u);
  EXPECT_TRUE(log["steps"][0].at("information").empty());
  for (int i : {1, 2}) {
    const nlohmann::json& step = log["steps"][i];
    ASSERT_EQ(step.at("information").size(), 8u);
    ASSERT_EQ(step.at("information_share").size(), 8u);
    ASSERT_EQ(step.at("discovery").size(), 8u);
    const auto expected = [&](std::size_t view) {
      return step["information"][view].get<double>() + step["discovery"][view].get<double>();
    };
    const double chosen = expected(step.at("view").get<std::size_t>());
    int taken = 0;
    for (std::size_t view = 0; view < 8; ++view) {
      taken += step["information"][view].is_null();
      EXPECT_TRUE(step["information"][view].is_null() || expected(view) <= chosen);
    }
    EXPECT_EQ(taken, i);
    EXPECT_FALSE(step.at("decision_ms").empty());
    EXPECT_EQ(step.at("extrinsics_checks").size(), static_cast<std::size_t>(i + 1));
    EXPECT_GE(step.at("gained_nats").get<double>(), 0);
  }
  EXPECT_GT(log["steps"][0].at("gained_nats").get<double>(), 0);
  ASSERT_EQ(log.at("detections").size(), 1u);
  EXPECT_TRUE(log["detections"][0].at("off_truth").at("right"));
  ASSERT_EQ(log.at("truth").size(), 1u);

  EXPECT_EQ(load_bop_results(t.out / "results.csv").size(), 3u);
  for (const nlohmann::json& step : log["steps"]) {
    const std::string number = std::to_string(step.at("view").get<int>());
    const ImageResult result = load_image_result(t.out / ("view_00" + number + ".json"));
    EXPECT_EQ(result.image, "") << "its id says which it is";
    EXPECT_TRUE(result.camera_from_world.has_value());
    EXPECT_EQ(result.detections.size(), 1u);
  }
  const std::string page = t.page();
  expect_self_contained(page);
  EXPECT_EQ(count_of(page, "<svg class=hemisphere"), 3u);
  EXPECT_EQ(count_of(page, "particles before"), 3u);
  EXPECT_EQ(count_of(page, "nats gained"), 3u);
  EXPECT_EQ(count_of(page, "objects after this image"), 3u);
  EXPECT_EQ(count_of(page, "Likeliest combination"), 2u);
  EXPECT_EQ(count_of(page, "Unlikeliest combination"), 2u);
  for (const char* word : {"green, orange", "none alone", "combination", "CAD frame",
                           "Images count", "particle", "nat", "rings"})
    EXPECT_NE(page.find(word, page.find("<h2>Legend")), std::string::npos) << word;
  EXPECT_EQ(page.find("</span><span class=stage"), std::string::npos) << "lines break between them";
  EXPECT_EQ(page.find("http-equiv=refresh"), std::string::npos) << "it is finished";
}

TEST(Scout, FindsThePartOnAVulkanDevice) {
  if (vulkan_devices().empty()) GTEST_SKIP() << "no Vulkan device";
  SmallScout t;
  t.device = "vulkan:0";
  const Outcome outcome = run_program(t.arguments());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const nlohmann::json log = t.log();
  ASSERT_EQ(log.at("steps").size(), 2u);
  EXPECT_NE(log.at("device"), "cpu");
  ASSERT_EQ(log.at("detections").size(), 1u);
  EXPECT_TRUE(log["detections"][0].at("off_truth").at("right"));
}

// Recorded views of a model whose origin lies outside it, as its CAD file has it: the castle stands
// where the recording says, at the world's origin.
TEST(Scout, FindsTheCastleOfVisp) {
  const fs::path folder = "/usr/share/visp-images-data/ViSP-images/mbt-depth/Castle-simu";
  if (!fs::exists(folder)) GTEST_SKIP() << "visp-images-data is not installed";
  const TemporaryFolder out;
  const Outcome outcome =
      run_program(joined({{"scout", folder, "--out", out.path(), "--device", "cpu"},
                          {"--camera", examples() / "visp/castle_simu_camera.yaml"},
                          {"--model", folder / "Models/chateau.cao", "--unit", "m"},
                          {"--max-views", "3"}}));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const nlohmann::json log = nlohmann::json::parse(content_of(out.path() / "scout.json"));
  EXPECT_EQ(log.at("steps").size(), 3u);
  ASSERT_FALSE(log.at("detections").empty());
  const nlohmann::json& best = log["detections"][0];
  EXPECT_GT(best.at("probability").get<double>(), 0.9);
  const JsonField pose{best.at("world_from_object"), "scout.json", ""};
  const Se3 castle = pose_from(pose.at("R"), pose.at("t"), 1);
  EXPECT_LT(castle.translation_m.norm(), 0.002);
  EXPECT_LT(angle_between_rad(castle, Se3{}), 0.01);
}

TEST(Scout, LooksFromTheViewsOfAFile) {
  const SmallScout t;
  HemisphereOptions hemisphere;
  hemisphere.radius_m = 0.3;
  hemisphere.elevations_deg = {40, 70};
  hemisphere.count = 6;
  std::vector<Se3> views = hemisphere_views(hemisphere);
  std::ranges::reverse(views);
  const fs::path file = t.folder.path() / "views.json";
  save_views(views, file);
  std::vector<std::string> arguments = t.arguments({"--views", file});
  for (const auto& [option, values] :
       {std::pair{"--view-count", 1}, std::pair{"--elevations", 2}}) {
    const auto at = std::ranges::find(arguments, option);
    arguments.erase(at, at + 1 + values);
  }
  const Outcome outcome = run_program(arguments);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const nlohmann::json log = t.log();
  ASSERT_EQ(log.at("views").size(), 6u);
  ASSERT_EQ(log.at("steps").size(), 2u);
  for (const nlohmann::json& step : log["steps"]) {
    const JsonField pose{step.at("camera_from_world"), "scout.json", ""};
    const Se3 taken = pose_from(pose.at("R"), pose.at("t"), 1.0);
    EXPECT_LT(distance_between_m(taken, views[step.at("view").get<std::size_t>()]), 1e-9);
  }
  ASSERT_EQ(log.at("detections").size(), 1u);
  EXPECT_TRUE(log["detections"][0].at("off_truth").at("right"));
}

// Without --radius the parts fill the image: ten times larger ones are seen from ten times as far.
TEST(Scout, LooksFromAsFarAsThePartsAreLarge) {
  const auto radius_m = [](const std::string& unit) {
    SmallScout t;
    t.max_views = "1";
    std::vector<std::string> arguments = t.arguments();
    const auto radius = std::ranges::find(arguments, "--radius");
    arguments.erase(radius, radius + 2);
    *(std::ranges::find(arguments, "--unit") + 1) = unit;
    const Outcome outcome = run_program(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const nlohmann::json log = t.log();
    const JsonField pose{log.at("views").at(0), "scout.json", ""};
    return inverse(pose_from(pose.at("R"), pose.at("t"), 1)).translation_m.norm();
  };
  const double small_m = radius_m("mm");
  EXPECT_GT(small_m, 0.1);
  EXPECT_LT(small_m, 0.4);
  EXPECT_NEAR(radius_m("cm") / small_m, 10, 1e-3);
}

// The distances come from the box.
TEST(Scout, KeepsToABoxInTheWorld) {
  const SmallScout t;
  const auto objects_in = [&](const std::string& x0, const std::string& x1) {
    const Outcome outcome =
        run_program(t.arguments({"--world-box", x0, "-0.1", "-0.01", x1, "0.1", "0.05"}));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return t.log().at("detections").size();
  };
  EXPECT_EQ(objects_in("-0.1", "0.1"), 1u);
  EXPECT_TRUE(t.log()["detections"][0].at("off_truth").at("right"));
  EXPECT_EQ(objects_in("0.15", "0.25"), 0u);
}

// A fixed sequence begins with its first view.
TEST(Scout, FollowsTheSequence) {
  SmallScout t;
  t.max_views = "3";
  const Outcome outcome =
      run_program(t.arguments({"--strategy", "fixed", "--sequence", "5", "3", "7"}));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const nlohmann::json log = t.log();
  ASSERT_EQ(log.at("steps").size(), 3u);
  EXPECT_EQ(log["steps"][0].at("view"), 5);
  EXPECT_EQ(log["steps"][1].at("view"), 3);
}

TEST(Scout, DrawsRandomViewsFromItsSeed) {
  const auto views_of = [](const char* seed) {
    SmallScout t;
    t.max_views = "3";
    EXPECT_EQ(run_program(t.arguments({"--strategy", "random", "--draws-seed", seed})).exit_code,
              0);
    std::vector<int> views;
    const nlohmann::json log = t.log();
    for (const nlohmann::json& step : log.at("steps")) {
      views.push_back(step.at("view"));
      EXPECT_EQ(step.at("strategy"), "random");
    }
    return views;
  };
  const std::vector<int> views = views_of("1");
  EXPECT_EQ(views_of("1"), views);
  EXPECT_NE(views_of("4"), views);
}

TEST(Scout, TakesRecordedViewsAndGoesOnPastAMissingImage) {
  const SmallScene scene(4);
  fs::remove(scene.image(0));
  const Outcome outcome =
      run_program(joined({{"scout", scene.scene, "--out", scene.out, "--device", "cpu",
                           "--coarse-poses", "200", "--candidates", "8", "--max-views", "2",
                           "--min-probability", "0.1", "--strategy", "dis", "--min-entropy", "0"},
                          bracket()}));
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  const auto log = nlohmann::json::parse(content_of(scene.out / "scout.json"));
  EXPECT_EQ(log.at("steps").size(), 2u);
  ASSERT_EQ(log.at("failed").size(), 1u);
  EXPECT_EQ(log["failed"][0].at("view"), 0);
  EXPECT_TRUE(log["failed"][0].at("decision_ms").empty())
      << "nothing is known before the first image";
  EXPECT_EQ(log["steps"][1].at("strategy"), "dis");
  EXPECT_EQ(log["steps"][1].at("information_unit"), "points");
  expect_self_contained(content_of(scene.out / "scout.html"));
  for (const nlohmann::json& step : log["steps"]) {
    const int view = step.at("view");
    const ImageResult result =
        load_image_result(scene.out / ("view_00" + std::to_string(view) + ".json"));
    EXPECT_EQ(result.image, scene.image(view));
  }
  for (const BopResult& row : load_bop_results(scene.out / "results.csv"))
    EXPECT_EQ(row.scene_id, 3);
}

TEST(Scout, LeavesResultsThatRegistrationGoesOnFrom) {
  const SmallScene scene(3);
  ASSERT_EQ(
      run_program(joined({{"scout", scene.scene, "--out", scene.out, "--device", "cpu",
                           "--coarse-poses", "200", "--max-views", "1", "--min-probability", "0.1"},
                          bracket()}))
          .exit_code,
      0);
  const fs::path out = scene.folder.path() / "registered";
  const Outcome outcome =
      run_program({"register", scene.scene, "--poses", scene.out / "view_000.json", "--model",
                   part_file(1), "--unit", "mm", "--out", out, "--device", "cpu", "--no-overlays"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::vector<BopResult> rows = load_bop_results(out / "results.csv");
  ASSERT_FALSE(rows.empty());
  for (const BopResult& row : rows) EXPECT_EQ(row.image_id, 0);
}

// All edges may be explained again, or none; of what may stand in one place.
TEST(Scout, LetsModesCompeteAsMaxClaimedAllows) {
  const auto found = [](const char* max_claimed) {
    SmallScout t;
    t.min_probability = "0.001";
    const Outcome outcome =
        run_program(t.arguments({"--max-claimed", max_claimed, "--penetration", "1"}));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return t.log().at("detections").size();
  };
  EXPECT_LT(found("0"), found("1"));
}

TEST(Scout, RefusesWhatItCannotUse) {
  const SmallScout t;
  const auto refused = [&](const std::vector<std::string>& arguments,
                           std::initializer_list<std::string> words) {
    expect_refused(arguments, words);
    EXPECT_FALSE(fs::exists(t.out)) << "something was written";
  };
  refused({"scout", "nowhere", "--out", t.out, "--device", "cpu", "--model", part_file(1), "--unit",
           "mm"},
          {"nowhere", "cell"});
  for (const fs::path& dataset : {examples(), examples() / "scenes"})
    refused({"scout", dataset, "--out", t.out, "--device", "cpu", "--model", part_file(1), "--unit",
             "mm"},
            {dataset, "a folder of BOP scenes",
             "one of them, such as " + (examples() / "scenes").string()});
  refused({"scout", "cell", "--out", t.out, "--device", "cpu"}, {"--model"});
  refused(t.arguments({"--camera", "x.yaml"}), {"--camera", "cell"});
  refused(t.arguments({"--bayer", "rggb"}), {"--bayer", "cell", "recorded views"});
  refused(t.arguments({"--strategy", "best"}), {"strategy", "best", "mi-max"});
  refused(t.arguments({"--first-view", "8"}), {"--first-view", "8 views"});
  refused(t.arguments({"--strategy", "fixed", "--sequence", "1", "99"}),
          {"--sequence", "99", "8 views"});
  refused(t.arguments({"--strategy", "fixed", "--sequence", "1", "-1"}),
          {"--sequence", "-1", "8 views"});
  refused(t.arguments({"--views", t.folder.write("views.json", "[]")}),
          {"--view-count", "together with --views"});
  const std::vector<std::string> model{"--out",   t.out,        "--device", "cpu",
                                       "--model", part_file(1), "--unit",   "mm"};
  refused(joined({{"scout", "cell", "--views", t.folder.path() / "views.json"}, model}),
          {"views.json"});
  refused(joined({{"scout", one_view(), "--arm-shift", "0.01"}, model}),
          {"--arm-shift", "recorded views"});
  refused(joined({{"scout", one_view(), "--view-count", "9"}, model}),
          {"--view-count", "recorded views"});
  refused(t.arguments({"--sequence", "1", "2"}), {"--sequence", "--strategy mi-max"});
  refused(t.arguments({"--strategy", "dis", "--min-information", "0.1"}),
          {"--min-information", "--strategy dis"});
  refused(t.arguments({"--strategy", "random", "--metre-cost", "0.1"}),
          {"--metre-cost", "--strategy random"});
  refused(t.arguments({"--elevations", "120"}), {"elevation"});
  refused(t.arguments({"--arm-shift", "nan"}), {"--arm-shift", "nan"});
  refused(t.arguments({"--metre-cost", "-1"}), {"--metre-cost", "-1", "0 to 1e+06"});
  refused({"scout", "cell", "--out", t.out, "--view-count", "10001"},
          {"--view-count", "10001", "1 to 10000"});
  refused(t.arguments({"--max-detections", "1"}), {"--max-detections"});
  refused(t.arguments({"--restart-rotation", "0"}), {"--restart-rotation"});
}

}  // namespace
}  // namespace edgescout::test
