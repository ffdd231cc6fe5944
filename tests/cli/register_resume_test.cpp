// edgescout register where results of an earlier run lie already: taken up again, or written anew.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "host/io/results.h"
#include "tests/cli/register_call.h"

namespace edgescout::test {
namespace {

TEST(Register, DoesOnlyWhatIsMissingWhenResumed) {
  const TemporaryFolder folder;
  const BopScene scene = load_bop_scene(two_views());
  std::vector<BopResult> starts{true_results(scene, 0)[0], true_results(scene, 1)[0]};
  save_bop_results(starts, folder.path() / "starts.csv");
  const fs::path out = folder.path() / "out";
  const std::vector<std::string> call = register_in(two_views(), folder.path() / "starts.csv", out,
                                                    {"--search-rotation", "0", "--no-overlays"});
  ASSERT_EQ(run_program(call).exit_code, 0);
  const auto summary = [&] { return nlohmann::json::parse(content_of(out / "summary.json")); };
  EXPECT_EQ(summary().at("done"), 2);
  EXPECT_GT(summary().at("mean_ms_per_image").at("registration"), 0);
  const std::vector<BopResult> rows = load_bop_results(out / "results.csv");
  ASSERT_EQ(rows.size(), 2u);
  const fs::path kept = out / "000001_000000.json", cut = out / "000001_000001.json";
  const auto before = fs::last_write_time(kept);
  folder.write("out/000001_000001.json", content_of(cut).substr(0, 100));
  ASSERT_EQ(run_program(joined({call, {"--resume"}})).exit_code, 0);
  EXPECT_EQ(summary().at("done"), 1);
  EXPECT_EQ(summary().at("skipped"), 1);
  EXPECT_EQ(fs::last_write_time(kept), before);
  const std::vector<BopResult> again = load_bop_results(out / "results.csv");
  ASSERT_EQ(again.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_LT(distance_between_m(again[i].camera_from_object, rows[i].camera_from_object), 1e-9);
}

// Start poses of two images of the same name, in folders of their own.
struct SameNames {
  TemporaryFolder folder;
  fs::path out = folder.path() / "out";

  SameNames() {
    for (const char* place : {"a", "b"}) {
      fs::create_directories(folder.path() / place);
      fs::copy_file(two_views() / "gray/000000.png", folder.path() / place / "000000.png");
    }
    fs::copy_file(two_views() / "gray/000001.png", folder.path() / "b/000000.png",
                  fs::copy_options::overwrite_existing);
  }
  std::vector<std::string> call(const std::string& place, const BopResult& start,
                                const std::vector<std::string>& more = {}) const {
    BopResult of_image_0 = start;
    of_image_0.image_id = 0;
    save_bop_results({of_image_0}, folder.path() / "starts.csv");
    return register_in(folder.path() / place / "000000.png", folder.path() / "starts.csv", out,
                       joined({{"--camera", two_views() / "scene_camera.json", "--search-rotation",
                                "0", "--no-overlays"},
                               more}));
  }
};

TEST(Register, TakesNoOtherImagesResultWhenResumed) {
  const SameNames t;
  const BopScene scene = load_bop_scene(two_views());
  const BopResult in_a = true_results(scene, 0)[0], in_b = true_results(scene, 1)[0];
  ASSERT_EQ(run_program(t.call("a", in_a)).exit_code, 0);
  const Outcome outcome = run_program(t.call("b", in_b, {"--resume"}));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::vector<BopResult> rows = load_bop_results(t.out / "results.csv");
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_LT(distance_between_m(rows[0].camera_from_object, in_b.camera_from_object), 0.005);
}

TEST(Register, RefusesAFolderWithResultsOfOtherImages) {
  const TemporaryFolder folder;
  const BopScene scene = load_bop_scene(two_views());
  const BopResult in_0 = true_results(scene, 0)[0], in_1 = true_results(scene, 1)[0];
  const fs::path starts = folder.path() / "starts.csv", out = folder.path() / "out";
  const std::vector<std::string> call =
      register_in(two_views(), starts, out, {"--search-rotation", "0", "--no-overlays"});
  save_bop_results({in_0, in_1}, starts);
  ASSERT_EQ(run_program(call).exit_code, 0);
  save_bop_results({in_0}, starts);
  expect_refused(call, {out, "000001_000001.json of another run", "another --out"});
  EXPECT_EQ(load_bop_results(out / "results.csv").size(), 2u);
}

// What a run removes must not be what it starts from, and what another program left there is not
// its own.
TEST(Register, RemovesNothingThatIsNotItsOwn) {
  const TemporaryFolder folder;
  const BopScene scene = load_bop_scene(two_views());
  const fs::path starts = folder.path() / "starts.csv", out = folder.path() / "out";
  const auto call = [&](const fs::path& poses) {
    return register_in(two_views(), poses, out, {"--search-rotation", "0", "--no-overlays"});
  };
  save_bop_results({true_results(scene, 0)[0]}, starts);
  ASSERT_EQ(run_program(call(starts)).exit_code, 0);
  expect_refused(call(out / "results.csv"), {"--poses", "another --out"});
  EXPECT_EQ(load_bop_results(out / "results.csv").size(), 1u);
  std::ofstream(out / "000001_000000.json") << "[\"a label\"]";
  expect_refused(call(starts), {"000001_000000.json", "no result of this program"});
  EXPECT_EQ(content_of(out / "000001_000000.json"), "[\"a label\"]");
}

TEST(Register, RefusesResultsMadeWithOtherSettingsWhenResumed) {
  const SameNames t;
  const BopScene scene = load_bop_scene(two_views());
  const BopResult start = true_results(scene, 0)[0], other = true_results(scene, 0)[1];
  ASSERT_EQ(run_program(t.call("a", start)).exit_code, 0);
  expect_refused(t.call("a", start, {"--resume", "--lambda", "50"}),
                 {"000000.json: lambda: found 30, expected 50"});
  expect_refused(t.call("a", start, {"--resume", "--no-edge-icp"}),
                 {"edge-icp: found true, expected false"});
  expect_refused(t.call("a", other, {"--resume"}), {"starts: found 1, checksum"});
  std::vector<std::string> fewer_models = t.call("a", start, {"--resume"});
  fewer_models.erase(std::ranges::find(fewer_models, part_file(start.object_id == 6 ? 5 : 6)));
  expect_refused(fewer_models, {"model of object", "expected nothing"});
  EXPECT_EQ(run_program(t.call("a", start, {"--resume"})).exit_code, 0);
}

}  // namespace
}  // namespace edgescout::test
