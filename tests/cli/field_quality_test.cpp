// Images in which detection is hard, where EDGESCOUT_FIELD names the folder they lie in.
#include "host/io/bop.h"
#include "tests/cli/example_scene.h"

namespace edgescout::test {
namespace {

// Of one of two parts 22 % of the edges lie outside the image.
TEST(FieldQuality, PartsThatTheBorderCutsAreFound) {
  const char* data = std::getenv("EDGESCOUT_FIELD");
  if (!data) GTEST_SKIP() << "no EDGESCOUT_FIELD";
  const fs::path images = fs::path(data) / "10-quality", base = fs::path(data) / "base";
  if (!fs::exists(images / "cut120.png")) GTEST_SKIP() << "EDGESCOUT_FIELD holds no cut120.png";
  const TemporaryFolder folder;
  const Outcome outcome =
      run_program({"detect", images / "cut120.png", "--camera", images / "cut120.json", "--model",
                   base / "models/obj_000001.ply", "--unit", "mm", "--object-id", "1",
                   "--distance-min", "0.18", "--distance-max", "0.32", "--device", "cpu",
                   "--no-overlays", "--out", folder.path() / "out"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::vector<BopResult> found = load_bop_results(folder.path() / "out/results.csv");
  for (const BopResult& part : true_results(load_bop_scene(base / "000000"), 0))
    EXPECT_TRUE(std::ranges::any_of(found, [&](const BopResult& pose) {
      return distance_between_m(pose.camera_from_object, part.camera_from_object) < 0.005;
    }));
}

}  // namespace
}  // namespace edgescout::test
