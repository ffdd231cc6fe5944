#include "host/io/video.h"

#include <gtest/gtest.h>

#include <opencv2/videoio.hpp>

#include "tests/io/collected_log.h"
#include "tests/io/expect_input_error.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

constexpr int frame_count = 12;

int grey_of(int frame) { return 20 + 15 * frame; }

// Every frame has its own grey level.
std::filesystem::path write_video(const std::filesystem::path& file) {
  cv::VideoWriter writer(file.string(), cv::CAP_OPENCV_MJPEG,
                         cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 25, {64, 48});
  for (int i = 0; i < frame_count; ++i)
    writer << cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(grey_of(i)));
  return file;
}

TEST(Video, GivesTheFramesInAnyOrder) {
  const TemporaryFolder folder;
  const auto video = write_video(folder.path() / "a %03d#1.avi"),
             other = write_video(folder.path() / "b.AVI");
  EXPECT_EQ(count_frames(video), frame_count);
  VideoReader reader;
  for (const int frame : {0, 1, 5, 5, 11, 2}) {
    const Image image = reader.frame(video, frame, {});
    EXPECT_EQ(image.width, 64);
    EXPECT_EQ(image.height, 48);
    EXPECT_NEAR(image.at(30, 20), grey_of(frame), 3);
  }
  EXPECT_NEAR(reader.frame(other, 3, {}).at(30, 20), grey_of(3), 3);
  ImageOptions options;
  options.black_white = {0, 2.0 * grey_of(3)};
  EXPECT_NEAR(reader.frame(other, 3, options).at(30, 20), 127, 6);
  EXPECT_EQ(name_of_frame("x/a.avi", 12), "x/a.avi#000012");
}

TEST(Video, SaysWhatCouldBeReadOfABrokenOne) {
  const TemporaryFolder folder;
  const std::string whole = content_of(write_video(folder.path() / "a.avi"));
  const auto cut = folder.write("cut.avi", std::string_view(whole).substr(0, whole.size() / 2));
  CollectedLog log;
  const int count = count_frames(cut);
  EXPECT_GT(count, 2);
  EXPECT_LT(count, frame_count);
  ASSERT_EQ(log.messages.size(), 1u);
  EXPECT_EQ(log.messages[0].first, LogLevel::Warning);
  EXPECT_NE(log.messages[0].second.find("expected 12 as the header says"), std::string::npos);
  VideoReader reader;
  EXPECT_NEAR(reader.frame(cut, count - 1, {}).at(30, 20), grey_of(count - 1), 3);
  expect_input_error([&] { reader.frame(cut, count, {}); },
                     {"cut.avi#0000", "an end after " + std::to_string(count) + " frames"});
}

TEST(Video, RefusesWhatIsNone) {
  const TemporaryFolder folder;
  expect_input_error([&] { count_frames(folder.write("a.mp4", "no video")); },
                     {"a.mp4", "no video decoder"});
  expect_input_error([&] { count_frames(folder.path() / "b.avi"); }, {"b.avi", "No such file"});
  EXPECT_TRUE(has_video_extension("x/A.MpEg"));
  EXPECT_FALSE(has_video_extension("x.png"));
  EXPECT_FALSE(has_video_extension("mp4"));
}

}  // namespace
}  // namespace edgescout::test
