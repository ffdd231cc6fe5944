// Which images and objects the arguments of a verb stand for.
#include "host/cli/inputs.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "tests/cli/small_scene.h"
#include "tests/io/expect_input_error.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

cv::Mat grey_frame(int level) { return cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(level)); }

void write_grey_video(const std::filesystem::path& file, int frames) {
  cv::VideoWriter writer(file.string(), cv::CAP_OPENCV_MJPEG,
                         cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 25, {64, 48});
  for (int i = 0; i < frames; ++i) writer << grey_frame(20 + 10 * i);
}

TEST(ListImages, TakesChosenFramesOfVideosUnderTheSameNames) {
  const TemporaryFolder folder;
  write_grey_video(folder.path() / "a.avi", 10);
  write_grey_video(folder.path() / "b.avi", 4);
  InputOptions options;
  options.every = 3;
  options.first_frame = 1;
  options.last_frame = 8;
  const std::vector<InputImage> images = list_images(
      {(folder.path() / "a.avi").string(), (folder.path() / "b.avi").string()}, {}, {}, options);
  ASSERT_EQ(images.size(), 4u);
  const int expected_frames[] = {1, 4, 7, 1};
  for (std::size_t i = 0; i < images.size(); ++i) {
    EXPECT_EQ(images[i].image_id, expected_frames[i]);
    EXPECT_EQ(images[i].scene_id, i < 3 ? 1 : 2);
    EXPECT_NEAR(read_image(images[i]).at(9, 9), 20 + 10 * expected_frames[i], 3);
  }
  EXPECT_EQ(images[1].name, "a_000004");
  EXPECT_EQ(images[1].frame_rate, 25);
  EXPECT_EQ(images[1].file, folder.path() / "a.avi#000004");
  EXPECT_EQ(images[3].name, "b_000001");
  options.first_frame = 4;
  expect_input_error([&] { list_images({(folder.path() / "b.avi").string()}, {}, {}, options); },
                     {"b.avi", "frames", "found 4", "--first-frame"});
  options.first_frame = 9;
  expect_input_error([&] { list_images({(folder.path() / "b.avi").string()}, {}, {}, options); },
                     {"--last-frame", "found 8", "9"});
}

TEST(ListImages, FindsImagesOfAnyEndingInAFolder) {
  const TemporaryFolder folder;
  for (const char* name : {"d.PNG", "a b.webp", "c%d#1.jp2"})
    cv::imwrite((folder.path() / name).string(), grey_frame(90));
  cv::imwrite((folder.path() / "x.png").string(), grey_frame(90));
  std::filesystem::rename(folder.path() / "x.png", folder.path() / "e");
  write_grey_video(folder.path() / "f.avi", 2);
  folder.write("notes.txt", "P7 are not read");
  folder.write("run/g.png", "in a folder below");
  folder.write("._d.PNG", "hidden, of another system");
  const std::vector<InputImage> images = list_images({folder.path().string()});
  std::vector<std::string> names;
  for (const InputImage& image : images) {
    names.push_back(image.name);
    EXPECT_NEAR(read_image(image).at(9, 9), image.video.empty() ? 90 : 20 + 10 * image.frame, 3);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"a b", "c%d#1", "d", "e", "f_000000", "f_000001"}));
}

// BOP keeps grey and coloured images apart, also of one scene.
TEST(ListImages, KnowsWhichImagesAreOfOneScene) {
  const TemporaryFolder folder;
  for (const char* scene : {"all/000001", "all/000002"})
    folder.write(std::string(scene) + "/scene_camera.json",
                 R"({"0": {"cam_K": [5,0,3,0,6,4,0,0,1]}, "1": {"cam_K": [5,0,3,0,6,4,0,0,1]}})");
  for (const char* file : {"all/000001/gray/000000.png", "all/000001/rgb/000001.png"})
    folder.write(file, "");
  const std::vector<InputImage> images = list_images({folder.path() / "all"});
  ASSERT_EQ(images.size(), 4u);
  EXPECT_NE(images[0].file.parent_path(), images[1].file.parent_path());
  EXPECT_EQ(images[0].scene_folder, images[1].scene_folder);
  EXPECT_NE(images[1].scene_folder, images[2].scene_folder);
  expect_input_error(
      [&] { list_images({folder.write("000003/scene_camera.json", "{}").parent_path()}); },
      {"000003", "scene_camera.json", "images"});
}

TEST(ListImages, NamesWhatItCannotExamine) {
  const TemporaryFolder folder;
  fs::create_symlink("loop.png", folder.path() / "loop.png");
  EXPECT_EQ(list_images({folder.path()}).size(), 1u) << "listed: reading it gives the error";
  expect_input_error([&] { list_images({folder.path() / std::string(300, 'a')}); },
                     {"aaa", "input"});
}

TEST(LoadObjects, TakesTheNumberThatANameEndsIn) {
  const TemporaryFolder folder;
  ModelArguments arguments;
  arguments.unit = "mm";
  for (const char* name : {"000005.ply", "part_7.ply", "bracket.ply"}) {
    fs::copy(part_file(1), folder.path() / name);
    arguments.models.push_back(folder.path() / name);
  }
  const std::vector<Object> objects = load_objects(arguments);
  EXPECT_EQ(objects[0].id, 5);
  EXPECT_EQ(objects[1].id, 7);
  EXPECT_EQ(objects[2].id, 3) << "its place";
}

TEST(ListImages, GivesEveryImageANameOfItsOwn) {
  const TemporaryFolder folder;
  for (const char* file : {"one/a.png", "two/a.png", "one/a_2.png", "one/summary.png"})
    folder.write(file, "");
  const std::string root = folder.path();
  const std::vector<InputImage> images =
      list_images({root + "/one/a.png", root + "/two/a.png", root + "/one"});
  std::set<std::string> names{"summary"};  // the batch's own file
  for (const InputImage& image : images) EXPECT_TRUE(names.insert(image.name).second) << image.name;
  EXPECT_EQ(images.size(), 5u);
  EXPECT_EQ(images[0].name, "a");
}

}  // namespace
}  // namespace edgescout::test
