// edgescout track on the example image, moved by whole pixels from frame to frame.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>
#include <sstream>

#include "host/io/image.h"
#include "tests/cli/example_scene.h"
#include "tests/cli/program.h"

namespace edgescout::test {
namespace {

constexpr int step_px = 4;

Image moved(const Image& image, int by_px) {
  Image result = image;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      result.pixels[std::size_t(y) * std::size_t(image.width) + std::size_t(x)] =
          image.at((x - by_px + image.width) % image.width, y);
  return result;
}

struct Sequence {
  TemporaryFolder folder;
  BopScene scene = load_bop_scene(one_view());
  BopResult truth;  // of one bearing block in the first frame

  explicit Sequence(int frames) {
    const Image first = load_image(one_view() / "gray/000000.png");
    fs::create_directory(images());
    for (int f = 0; f < frames; ++f)
      save_png(moved(first, f * step_px), images() / ("frame" + std::to_string(f) + ".png"));
    for (const BopResult& result : true_results(scene, 0, 0.9))
      if (result.object_id == 2) truth = result;
    const Eigen::Matrix3d r = truth.camera_from_object.rotation.toRotationMatrix();
    nlohmann::json start{{"image", "frame0.png"}, {"object", 2}};
    for (int i = 0; i < 9; ++i) start["R"].push_back(r(i / 3, i % 3));
    for (const double t : truth.camera_from_object.translation_m) start["t"].push_back(t);
    std::ofstream(folder.path() / "starts.json") << nlohmann::json{start};
    const Camera camera = scene.images[0].camera;
    std::ofstream(folder.path() / "camera.json") << nlohmann::json{
        {"cx", camera.cx},       {"cy", camera.cy},         {"fx", camera.fx},   {"fy", camera.fy},
        {"width", camera.width}, {"height", camera.height}, {"depth_scale", 1.0}};
  }
  fs::path images() const { return folder.path() / "frames"; }
  fs::path out() const { return folder.path() / "out"; }
  Outcome track(const std::vector<std::string>& more = {}) const {
    return run_program(joined({{"track", images().string(), "--model", part_file(2), "--unit", "mm",
                                "--camera", (folder.path() / "camera.json").string(), "--poses",
                                (folder.path() / "starts.json").string(), "--no-search", "--device",
                                "cpu", "--out", out().string()},
                               more}));
  }
  // Rows of tracks.csv without the header, split at commas.
  std::vector<std::vector<std::string>> rows() const {
    std::ifstream file(out() / "tracks.csv");
    std::vector<std::vector<std::string>> rows;
    std::string line, word;
    std::getline(file, line);
    while (std::getline(file, line)) {
      std::istringstream words(line);
      rows.emplace_back();
      while (std::getline(words, word, ',')) rows.back().push_back(word);
    }
    return rows;
  }
  double u_px(const std::vector<std::string>& row) const {
    const Camera& camera = scene.images[0].camera;
    return camera.fx * std::stod(row[17]) / std::stod(row[19]) + camera.cx;
  }
};

TEST(Track, FollowsAnObjectFromAGivenPose) {
  const Sequence sequence(5);
  const Outcome outcome = sequence.track();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("5 frames, 1 instances: 5 poses tracked"), std::string::npos)
      << outcome.out;
  const auto rows = sequence.rows();
  ASSERT_EQ(rows.size(), 5u);
  for (std::size_t f = 0; f < rows.size(); ++f) {
    ASSERT_EQ(rows[f].size(), 27u);
    EXPECT_EQ(rows[f][6], "tracked") << f;
    EXPECT_NEAR(sequence.u_px(rows[f]) - sequence.u_px(rows[0]), step_px * double(f), 0.7) << f;
  }
  EXPECT_EQ(load_bop_results(sequence.out() / "results.csv").size(), 5u);
  EXPECT_EQ(load_image(sequence.out() / "frame4_overlay.png").width, 640);
  const auto summary = nlohmann::json::parse(std::ifstream(sequence.out() / "summary.json"));
  EXPECT_EQ(summary["tracked"], 5);
  EXPECT_GT(summary["update_ms"]["median"], 0);
}

TEST(Track, GoesOnAfterAnImageThatCannotBeRead) {
  const Sequence sequence(4);
  std::ofstream(sequence.images() / "frame2.png") << "no image";
  const Outcome outcome = sequence.track({"--no-overlays"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_NE(outcome.err.find("frame2.png"), std::string::npos) << outcome.err;
  const auto rows = sequence.rows();
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[2][6], "tracked");
  EXPECT_NEAR(sequence.u_px(rows[2]) - sequence.u_px(rows[0]), 3 * step_px, 0.7);
  EXPECT_FALSE(fs::exists(sequence.out() / "frame0_overlay.png"));
}

// Where nothing was measured all stays; a wall before the part hides its edges.
TEST(Track, TakesDepthImagesBesideTheGreyOnes) {
  const Sequence sequence(2);
  ASSERT_EQ(sequence.track({"--no-overlays"}).exit_code, 0);
  const auto plain = sequence.rows();
  const fs::path depth = sequence.folder.path() / "depth";
  fs::create_directory(depth);
  const auto track_with = [&](double z_m) {
    for (int f = 0; f < 2; ++f)
      cv::imwrite((depth / ("frame" + std::to_string(f) + ".png")).string(),
                  cv::Mat(480, 640, CV_16U, cv::Scalar(1000 * z_m)));
    EXPECT_EQ(sequence.track({"--no-overlays", "--depth", depth.string()}).exit_code, 0);
    return sequence.rows();
  };
  const auto nothing = track_with(0);
  ASSERT_EQ(nothing.size(), plain.size());
  for (std::size_t f = 0; f < plain.size(); ++f) EXPECT_EQ(nothing[f], plain[f]);
  const auto behind_a_wall = track_with(0.2);
  ASSERT_EQ(behind_a_wall.size(), plain.size());
  EXPECT_EQ(behind_a_wall[1][6], "doubtful");
}

TEST(Track, RefusesDepthThatDoesNotFit) {
  const Sequence sequence(1);
  const Outcome no_files = sequence.track({"--depth", sequence.folder.path().string()});
  EXPECT_EQ(no_files.exit_code, 2);
  EXPECT_NE(no_files.err.find("--depth"), std::string::npos) << no_files.err;
  const fs::path small = sequence.folder.path() / "small.png";
  cv::imwrite(small.string(), cv::Mat(24, 32, CV_16U, cv::Scalar(400)));
  const Outcome other_size = sequence.track({"--depth", small.string()});
  EXPECT_EQ(other_size.exit_code, 2);
  EXPECT_NE(other_size.err.find("depth-camera"), std::string::npos) << other_size.err;
}

// Poses name a frame by the video's name and its number; every second frame keeps its time.
TEST(Track, FollowsAnObjectThroughAVideo) {
  const Sequence sequence(5);
  const fs::path video = sequence.folder.path() / "parts.avi";
  cv::VideoWriter writer(video.string(), cv::CAP_OPENCV_MJPEG,
                         cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 25, {640, 480});
  for (int f = 0; f < 5; ++f)
    writer << cv::imread((sequence.images() / ("frame" + std::to_string(f) + ".png")).string());
  writer.release();
  const auto track = [&](const std::string& image, const std::vector<std::string>& more = {}) {
    nlohmann::json start =
        nlohmann::json::parse(std::ifstream(sequence.folder.path() / "starts.json"))[0];
    start["image"] = image;
    const std::string poses = sequence.folder.write("video.json", nlohmann::json{start}.dump());
    return run_program(joined(
        {{"track", video.string(), "--model", part_file(2), "--unit", "mm", "--camera",
          (sequence.folder.path() / "camera.json").string(), "--poses", poses, "--no-search",
          "--no-overlays", "--device", "cpu", "--every", "2", "--out", sequence.out().string()},
         more}));
  };
  const Outcome outcome = track("parts.avi#000000");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  auto rows = sequence.rows();
  ASSERT_EQ(rows.size(), 3u);
  for (std::size_t f = 0; f < rows.size(); ++f) {
    EXPECT_NEAR(std::stod(rows[f][3]), 2 * double(f) / 25, 1e-6) << f;
    EXPECT_NE(rows[f][6], "lost") << f;
  }
  ASSERT_EQ(track("parts.avi#000000", {"--frame-rate", "100"}).exit_code, 0);
  rows = sequence.rows();
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_NEAR(std::stod(rows[2][3]), 0.04, 1e-6);
  const Outcome refused = track("parts.avi");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("found parts.avi, expected one of the images given, such as "
                             "parts.avi#000000"),
            std::string::npos)
      << refused.err;
}

TEST(Track, RefusesRequestsThatCannotBeMet) {
  const Sequence sequence(1);
  expect_refused({"track", sequence.images().string(), "--model", part_file(2), "--unit", "mm",
                  "--camera", (sequence.folder.path() / "camera.json").string(), "--no-search",
                  "--out", sequence.out().string()},
                 {"--no-search"});
  std::ofstream(sequence.folder.path() / "starts.json")
      << R"([{"image": "other.png", "object": 2, "R": [1,0,0,0,1,0,0,0,1], "t": [0,0,1]}])";
  const Outcome outcome = sequence.track();
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("other.png"), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(sequence.out())) << "nothing is written";
}

}  // namespace
}  // namespace edgescout::test
