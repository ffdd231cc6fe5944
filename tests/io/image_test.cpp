#include "host/io/image.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <new>
#include <opencv2/imgcodecs.hpp>

#include "host/core/lens.h"
#include "host/io/exif.h"
#include "tests/io/collected_log.h"
#include "tests/io/expect_input_error.h"
#include "tests/io/temporary_folder.h"
#include "tests/lens.h"

namespace edgescout::test {
namespace {

Image gradient_image(int width, int height) {
  Image image{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image.pixels.push_back(static_cast<std::uint8_t>((7 * x + 13 * y) % 256));
  return image;
}

TEST(HasImageExtension, IsOfTheNameInAnyCase) {
  for (const char* name :
       {"a.png", "a.JPG", "b/a.jpeg", "a.x.Tiff", "a.tif", "a.pgm", "a.ppm", "a.bmp"})
    EXPECT_TRUE(has_image_extension(name)) << name;
  for (const char* name : {"png", "a.png.txt", "a", "a.json", ".png/a", "a.pn"})
    EXPECT_FALSE(has_image_extension(name)) << name;
}

TEST(LoadImage, ReadsWhatSavePngWrote) {
  const TemporaryFolder folder;
  for (auto [width, height] : {std::pair{16, 16}, {17, 33}, {640, 480}}) {
    const Image image = gradient_image(width, height);
    save_png(image, folder.path() / "x.png");
    const Image back = load_image(folder.path() / "x.png");
    EXPECT_EQ(back.width, width);
    EXPECT_EQ(back.height, height);
    EXPECT_EQ(back.pixels, image.pixels);
  }
  EXPECT_EQ(folder.entries(), 1u);
}

// The only test of this program that reads colour: the conversion is logged once per process.
TEST(LoadImage, ConvertsColourAndLogsIt) {
  const TemporaryFolder folder;
  RgbImage colour{20, 20, {}};
  for (int i = 0; i < 400; ++i)
    for (int value : {200, 100, 50}) colour.pixels.push_back(static_cast<std::uint8_t>(value));
  save_png(colour, folder.path() / "c.png");
  cv::imwrite((folder.path() / "alpha.png").string(),
              cv::Mat(20, 20, CV_8UC4, cv::Scalar(50, 100, 200, 7)));
  CollectedLog log;
  for (const char* name : {"c.png", "alpha.png"}) {
    const Image grey = load_image(folder.path() / name);
    // Rec. 601: 0.299 R + 0.587 G + 0.114 B
    EXPECT_NEAR(grey.at(3, 4), 0.299 * 200 + 0.587 * 100 + 0.114 * 50, 1) << name;
  }
  ASSERT_EQ(log.messages.size(), 1u);
  EXPECT_EQ(log.messages[0].first, LogLevel::Info);
  EXPECT_NE(log.messages[0].second.find("c.png: colour"), std::string::npos);
}

// Grey steps 0 .. 249 in any part of the range, with a dead and a hot pixel.
TEST(LoadImage, ScalesDeepImagesByTheirOwnValues) {
  const TemporaryFolder folder;
  for (const auto& [low, step] : {std::pair{0, 256}, {0, 16}, {3000, 20}})
    for (const char* name : {"deep.png", "deep.tif", "deep.pgm"}) {
      cv::Mat deep(50, 250, CV_16U);
      for (int y = 0; y < deep.rows; ++y)
        for (int x = 0; x < deep.cols; ++x)
          deep.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(low + step * x);
      deep.at<std::uint16_t>(3, 3) = 0;
      deep.at<std::uint16_t>(4, 4) = 65535;
      cv::imwrite((folder.path() / name).string(), deep);
      const Image image = load_image(folder.path() / name);
      for (const int x : {0, 100, 249})
        EXPECT_NEAR(image.at(x, 10), x * 255 / 249.0, 1) << name << " " << low << " " << step;
      EXPECT_EQ(image.at(3, 3), 0);
      EXPECT_EQ(image.at(4, 4), 255);
    }
  cv::Mat flat(20, 20, CV_16U, cv::Scalar(1000));  // noise is not enlarged
  flat.at<std::uint16_t>(5, 5) = 1010;
  cv::imwrite((folder.path() / "flat.png").string(), flat);
  EXPECT_EQ(load_image(folder.path() / "flat.png").at(5, 5), 10);
}

TEST(LoadImage, RejectsOtherDepths) {
  const TemporaryFolder folder;
  cv::imwrite((folder.path() / "real.tif").string(), cv::Mat(20, 20, CV_32F, cv::Scalar(0.5)));
  expect_input_error([&] { load_image(folder.path() / "real.tif"); },
                     {"real.tif", "bit depth", "32 bit", "8 or 16 bit"});
}

// A segment with the tag, in both orders of bytes.
TEST(ExifOrientation, IsReadFromJpegFiles) {
  const std::string big(
      "\xff\xd8\xff\xe1\0\x22"
      "Exif\0\0MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0"
      "\0\0\0\0\xff\xd9",
      40);
  EXPECT_EQ(exif_orientation(big), 6);
  const std::string little(
      "\xff\xd8\xff\xe1\0\x22"
      "Exif\0\0II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x03\0\0\0"
      "\0\0\0\0\xff\xd9",
      40);
  EXPECT_EQ(exif_orientation(little), 3);
  for (std::size_t i = 0; i < big.size(); ++i) EXPECT_GE(exif_orientation(big.substr(0, i)), 1);
  EXPECT_EQ(exif_orientation("\x89PNG"), 1);
}

TEST(LoadImage, RejectsTinyImages) {
  const TemporaryFolder folder;
  for (auto [width, height] : {std::pair{1, 1}, {15, 100}, {100, 15}}) {
    save_png(gradient_image(width, height), folder.path() / "tiny.png");
    expect_input_error(
        [&] { load_image(folder.path() / "tiny.png"); },
        {"tiny.png", "image size", std::to_string(width) + "x" + std::to_string(height), "16x16"});
  }
}

TEST(LoadImage, RejectsWhatIsNoImage) {
  const TemporaryFolder folder;
  expect_input_error([&] { load_image(folder.path() / "none.png"); }, {"none.png", "No such file"});
  expect_input_error([&] { load_image(folder.path()); }, {"a folder"});
  expect_input_error([&] { load_image(folder.write("empty.png", "")); }, {"empty.png", "empty"});
  expect_input_error([&] { load_image(folder.write("text.png", "this is no image\n")); },
                     {"text.png", "no image decoder"});
}

// Limits the memory that the process may allocate in addition to its present memory.
class MemoryLimit {
 public:
  explicit MemoryLimit(rlim_t more_bytes) {
    rlim_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    ::getrlimit(RLIMIT_AS, &old_);
    const rlimit now{pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + more_bytes,
                     old_.rlim_max};
    ::setrlimit(RLIMIT_AS, &now);
  }
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;
  ~MemoryLimit() { ::setrlimit(RLIMIT_AS, &old_); }

 private:
  rlimit old_{};
};

TEST(LoadImage, DistinguishesLackOfMemoryFromABadImage) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers need memory of their own";
#endif
  const TemporaryFolder folder;
  save_png(Image{8000, 8000, std::vector<std::uint8_t>(8000 * 8000, 128)},
           folder.path() / "large.png");
  EXPECT_EQ(load_image(folder.path() / "large.png").width, 8000);
  const MemoryLimit limit(32 << 20);  // half of the pixels
  expect_input_error([&] { load_image(folder.path() / "large.png"); }, {"large.png", "memory"});
}

TEST(LoadImage, RejectsImagesCutShort) {
  const TemporaryFolder folder;
  cv::Mat noise(64, 64, CV_8U);
  cv::randu(noise, 0, 255);
  for (const char* name : {"x.png", "x.jpg"}) {
    cv::imwrite((folder.path() / name).string(), noise);
    EXPECT_EQ(load_image(folder.path() / name).width, 64);
    const std::string whole = content_of(folder.path() / name);
    for (std::size_t i = 0; i < 20; ++i) {
      const auto cut = folder.write(std::string("cut-") + name,
                                    std::string_view(whole).substr(0, whole.size() * i / 20));
      expect_input_error([&] { load_image(cut); }, {name});
    }
  }
}

// A smooth scene seen through the lens: the grey value at a distorted pixel is f(undistorted
// pixel).
double scene(double x, double y) { return 128 + 60 * std::sin(0.05 * x) + 60 * std::cos(0.04 * y); }

// Renders the scene through the lens, takes the lens out and compares. `ideal_of` gives the place
// in the undistorted image of a pixel of the original, `seen_of` the other way. Returns the number
// of pixels compared: those that the original shows well inside.
template <typename Ideal, typename Seen>
int expect_taken_out(const Camera& camera, const Ideal& ideal_of, const Seen& seen_of) {
  Image seen{camera.width, camera.height, {}};
  for (int y = 0; y < seen.height; ++y)
    for (int x = 0; x < seen.width; ++x) {
      const Eigen::Vector2d ideal = ideal_of(x, y);
      seen.pixels.push_back(static_cast<std::uint8_t>(std::lround(scene(ideal.x(), ideal.y()))));
    }
  const Image flat = undistort(seen, camera);
  EXPECT_EQ(flat.width, camera.width);
  int compared = 0;
  for (int y = 0; y < flat.height; ++y)
    for (int x = 0; x < flat.width; ++x) {
      const Eigen::Vector2d from = seen_of(x, y);
      if (from.x() < 3 || from.y() < 3 || from.x() > 196 || from.y() > 156) continue;
      // Rounding to grey levels twice, and remap's fixed-point coordinates of 1/32 px.
      EXPECT_NEAR(flat.at(x, y), scene(x, y), 1.5) << x << " " << y;
      ++compared;
    }
  return compared;
}

TEST(Undistort, TakesTheLensOutOfASmoothScene) {
  Camera camera{
      200, 160, 220, 210, 98.5, 82, {-0.2, 0.05, 0.002, -0.001, 0.01, 0.01, 0.005, 0.002}};
  const int compared = expect_taken_out(
      camera,
      [&](int x, int y) {
        return undistort_point(camera, {x, y});
      },
      [&](int x, int y) { return distort(camera, x, y); });
  EXPECT_GT(compared, 25000);
}

// The place in the undistorted image of what a pixel of the original shows.
Eigen::Vector2d ideal_place(const Camera& camera, const Eigen::Vector2d& seen) {
  const Camera ideal = undistorted(camera);
  Eigen::Vector2d place(ideal.cx, ideal.cy);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector2d direction = ray_through(ideal, place).head<2>();
    place += ideal.fx / camera.fx * (seen - pixel_seeing(camera, direction));
  }
  return place;
}

// With a skew, and with the pinhole of a chosen field of view.
TEST(Undistort, TakesOtherLensesOutOfASmoothScene) {
  Camera fisheye{200, 160, 150, 152, 98.5, 82, {-0.03, 0.01, -0.005, 0.001}};
  fisheye.lens = LensModel::Fisheye;
  fisheye.skew = 0.8;
  Camera chosen = fisheye;
  chosen.field_of_view_rad = 1.2;
  Camera plain = chosen;  // by OpenCV
  plain.lens = LensModel::BrownConrady;
  plain.skew = 0;
  for (const Camera& camera : {fisheye, chosen, plain}) {
    const int compared = expect_taken_out(
        camera,
        [&](int x, int y) {
          return ideal_place(camera, {x, y});
        },
        [&](int x, int y) {
          return pixel_seeing(camera, ray_through(undistorted(camera), {x, y}).head<2>());
        });
    EXPECT_GT(compared, 20000);
  }
}

TEST(Undistort, ReturnsTheImageWithoutDistortionAndRefusesAnotherSize) {
  const Image image = gradient_image(40, 30);
  Camera camera{40, 30, 50, 50, 20, 15, {}};
  EXPECT_EQ(undistort(image, camera).pixels, image.pixels);
  camera.width = 41;
  EXPECT_THROW(undistort(image, camera), LogicError);
}

TEST(Undistort, RefusesSizesItCannotWorkOn) {
  const Image image = gradient_image(40, 30);
  for (std::size_t pixels : {0u, 1199u, 1201u}) {
    Image other = image;
    other.pixels.resize(pixels);
    for (double k1 : {0.0, 0.1})
      expect_input_error(
          [&] {
            undistort(other, {40, 30, 50, 50, 20, 15, {k1}});
          },
          {"pixels", "found " + std::to_string(pixels), "1200", "40x30"});
  }
  for (const auto& [width, height] : {std::pair{32767, 16}, {16, 40000}}) {
    Camera camera{width, height, 5000, 5000, width / 2.0, height / 2.0, {0.01}};
    const Image large = gradient_image(width, height);
    expect_input_error(
        [&] { undistort(large, camera); },
        {"image", "size", std::to_string(width) + "x" + std::to_string(height), "32766"});
    camera.distortion = {};
    EXPECT_EQ(undistort(large, camera).width, width);
  }
  const Camera largest{32766, 16, 5000, 5000, 16383, 8, {0.01}};
  EXPECT_EQ(undistort(gradient_image(32766, 16), largest).width, 32766);
}

TEST(SavePng, WritesRedGreenBlueInThisOrder) {
  const TemporaryFolder folder;
  save_png(RgbImage{1, 1, {200, 100, 50}}, folder.path() / "c.png");
  EXPECT_EQ(cv::imread((folder.path() / "c.png").string()).at<cv::Vec3b>(0, 0),
            cv::Vec3b(50, 100, 200));
  EXPECT_THROW(save_png(RgbImage{2, 1, {1, 2, 3}}, folder.path() / "d.png"), LogicError);
  expect_input_error(
      [&] {
        save_png(RgbImage{1, 1, {1, 2, 3}}, folder.path() / "no" / "d.png");
      },
      {"d.png"});
}

}  // namespace
}  // namespace edgescout::test
