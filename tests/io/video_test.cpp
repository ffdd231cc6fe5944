#include "host/io/video.h"

#include <gtest/gtest.h>

#include <algorithm>
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
  EXPECT_EQ(stated_frame_rate(video), 25);
  EXPECT_EQ(name_of_frame("x/a.avi", 12), "x/a.avi#000012");
}

// Phones write upright videos as lying ones with a turn in the track's header.
TEST(Video, SaysThatItIsTurnedAndTakesThePixelsAsStored) {
  const TemporaryFolder folder;
  const auto lying = (folder.path() / "lying.mp4").string();
  cv::VideoWriter writer(lying, cv::CAP_FFMPEG, cv::VideoWriter::fourcc('m', 'p', '4', 'v'), 25,
                         {64, 48});
  cv::Mat left_dark(48, 64, CV_8UC3, cv::Scalar::all(200));
  left_dark.colRange(0, 32) = cv::Scalar::all(20);
  writer << left_dark << left_dark;
  writer.release();
  std::string bytes = content_of(lying);
  const std::size_t matrix = bytes.find("tkhd") + 44;  // nine numbers of four bytes
  ASSERT_EQ(bytes.substr(matrix, 4), std::string("\0\1\0\0", 4));
  bytes.replace(matrix, 20, std::string("\0\0\0\0\0\1\0\0\0\0\0\0\xff\xff\0\0\0\0\0\0", 20));
  const auto turned = folder.write("turned.mp4", bytes);
  CollectedLog log;
  const Image image = VideoReader().frame(turned, 1, {});
  EXPECT_EQ(image.width, 64);
  EXPECT_NEAR(image.at(10, 24), 20, 6);
  EXPECT_NEAR(image.at(54, 24), 200, 6);
  EXPECT_EQ(count_frames(turned), 2);
  const auto is_of_turn = [](const auto& message) {
    return message.second.find("turned.mp4: orientation: found 270 degrees") != std::string::npos;
  };
  EXPECT_EQ(std::ranges::count_if(log.messages, is_of_turn), 1);
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
