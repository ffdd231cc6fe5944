// Files that are refused: no image, one cut short, of a size that cannot be read.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <fstream>
#include <new>
#include <opencv2/imgcodecs.hpp>

#include "host/io/image.h"
#include "tests/io/expect_input_error.h"
#include "tests/io/gradient_image.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

TEST(LoadImage, RefusesHugeImagesBeforeItDecodesThem) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& name, const std::string& bytes, const char* size) {
    expect_input_error([&] { load_image(folder.write(name, bytes)); },
                       {name, "image size", size, "268435456 pixels"});
  };
  refused("a.png", std::string("\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\0\0\xff\xff\0\0\xff\xffIEND", 28),
          "65535x65535");
  refused("a.jpg", std::string("\xff\xd8\xff\xc0\0\x11\x08\xff\xff\x7f\xff\x03\xff\xd9", 14),
          "32767x65535");
  refused("a.pgm", "P5\n# a comment\n100000 3000\n255\n", "100000x3000");
  refused("a.bmp", std::string("BM\0\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\0\0\x01\0\0\0\xff\xff", 26),
          "65536x65536");
  refused("a.tif",
          std::string("II*\0\x08\0\0\0\x02\0\0\x01\x04\0\x01\0\0\0\0\0\x10\0"
                      "\x01\x01\x03\0\x01\0\0\0\0\x10\0\0\0\0\0\0",
                      38),
          "1048576x4096");
  refused("side.pgm", "P5 2000000 16 255\n", "2000000x16");
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
  for (const char* name : {"x.png", "x.jpg", "x.pgm", "x.bmp"}) {
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

}  // namespace
}  // namespace edgescout::test
