// edgescout camera: what it prints, warns of and draws.
#include "host/io/image.h"
#include "tests/cli/example_scene.h"

namespace edgescout::test {
namespace {

const std::string text =
    "image_width: 64\nimage_height: 48\ncamera_name: head\nK: [70, 0, 31.5, 0, "
    "70, 23.5, 0, 0, 1]\nD: [-0.25, 0.12, 0.001, -0.0005, 0]\n";

struct CameraVerb {
  TemporaryFolder folder;
  fs::path file = folder.write("camera.yaml", text);
  fs::path image = folder.path() / "image.png";
  fs::path out = folder.path() / "new/flat.png";

  CameraVerb() {
    Image grey{64, 48, {}};
    for (int i = 0; i < 64 * 48; ++i) grey.pixels.push_back(static_cast<std::uint8_t>(i % 251));
    save_png(grey, image);
  }
};

TEST(CameraVerb, PrintsWhatItUnderstands) {
  const CameraVerb t;
  const Outcome outcome = run_program({"camera", t.file});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  for (const char* part : {"64 x 48 px", "70 and 70 px", "31.5, 23.5 px", "Brown-Conrady: k1 -0.25",
                           "p2 -0.0005", "not used         camera_name", "49.1 x 37.8 degrees"})
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part << "\n" << outcome.out;
}

TEST(CameraVerb, DrawsTheUndistortedImage) {
  const CameraVerb t;
  const Outcome outcome = run_program({"camera", t.file, t.image, "--out", t.out});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const Image flat = load_image(t.out);
  EXPECT_EQ(flat.width, 64);
  EXPECT_NE(flat.pixels, load_image(t.image).pixels);
  const Outcome wide =
      run_program({"camera", t.file, t.image, "--out", t.out, "--field-of-view", "90"});
  EXPECT_NE(wide.out.find("90.0 x 73.7 degrees, focal lengths 32 and 32 px"), std::string::npos)
      << wide.out;
  EXPECT_NE(load_image(t.out).pixels, flat.pixels);
}

TEST(CameraVerb, WarnsOfWhatIsHardlyRight) {
  const CameraVerb t;
  const fs::path folded =
      t.folder.write("folded.yaml",
                     "width: 64\nheight: 48\nfx: 70\nfy: 70\ncx: 31.5\ncy: 23.5\nk1: "
                     "-3.0\n");
  const Outcome outcome = run_program({"camera", folded});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("warning: "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("fold the image"), std::string::npos) << outcome.err;
}

TEST(CameraVerb, ErrorsAreOneLine) {
  const CameraVerb t;
  for (const auto& [content, word] : std::vector<std::pair<std::string, std::string>>{
           {"K: [70, 0, 0, 0, 70, 0, 31.5, 23.5, 1]\n", "transposed"},
           {"K: [0, 0, 0, 0, 0, 0, 0, 0, 0]\n", "only zeros"},
           {"fx: 70\nfy: 70\ncx: 31\ncy: 23\nlens_curve: [1, 2]\n", "lens_curve"}}) {
    const Outcome outcome = run_program({"camera", t.folder.write("bad.yaml", content)});
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_TRUE(is_one_line_error(outcome.err)) << outcome.err;
    EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err;
  }
  for (const std::vector<std::string>& more :
       std::vector<std::vector<std::string>>{{"--out", t.out},
                                             {t.image, "--out", t.image},
                                             {t.image, "--field-of-view", "180"},
                                             {"--camera-name", "cam9"},
                                             {t.folder.path() / "none.png"}}) {
    const Outcome outcome = run_program(joined({{"camera", t.file}, more}));
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_TRUE(is_one_line_error(outcome.err)) << outcome.err;
  }
}

TEST(CameraVerb, ChoosesOneOfSeveral) {
  const CameraVerb t;
  const fs::path two =
      t.folder.write("two.yaml",
                     "cam0: {intrinsics: [70, 70, 31.5, 23.5], resolution: [64, 48]}\n"
                     "cam1: {intrinsics: [80, 80, 31.5, 23.5], resolution: [64, 48]}\n");
  const Outcome all = run_program({"camera", two});
  EXPECT_NE(all.out.find("cam0"), std::string::npos);
  EXPECT_NE(all.out.find("cam1"), std::string::npos);
  const Outcome one =
      run_program({"camera", two, t.image, "--camera-name", "cam1", "--out", t.out});
  EXPECT_EQ(one.exit_code, 0) << one.err;
  EXPECT_EQ(one.out.find("cam0"), std::string::npos);
  const Outcome open = run_program({"camera", two, t.image, "--out", t.out});
  EXPECT_TRUE(is_one_line_error(open.err)) << open.err;
  EXPECT_NE(open.err.find("--camera-name"), std::string::npos) << open.err;
}

}  // namespace
}  // namespace edgescout::test
