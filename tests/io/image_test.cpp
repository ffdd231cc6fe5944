#include "host/io/image.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <new>
#include <opencv2/imgcodecs.hpp>

#include "tests/io/collected_log.h"
#include "tests/io/expect_input_error.h"
#include "tests/io/gradient_image.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

TEST(HasImageExtension, IsOfTheNameInAnyCase) {
  for (const char* name : {"a.png", "a.JPG", "b/a.jpeg", "a.x.Tiff", "a.tif", "a.pgm", "a.ppm",
                           "a.bmp", "a.webp", "a.JP2", "a.exr", "a.pfm", "a.hdr", "a b#%d.png"})
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

// Every grey level, with a dead and a hot pixel, as a sensor of `white` gives them.
cv::Mat ramp(int type, double scale, double offset = 0) {
  cv::Mat grey(50, 256, CV_8U), deep;
  for (int y = 0; y < grey.rows; ++y)
    for (int x = 0; x < grey.cols; ++x) grey.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(x);
  grey.convertTo(deep, type, scale, offset);
  return deep;
}

void expect_ramp(const Image& image, double tolerance, const std::string& what) {
  for (int x = 0; x < image.width; ++x) EXPECT_NEAR(image.at(x, 10), x, tolerance) << what;
}

// The thresholds of edges are grey levels, so the levels must be those of the 8-bit image.
TEST(LoadImage, GivesDeepImagesTheLevelsOfTheirEightBitVersions) {
  const TemporaryFolder folder;
  for (const int white : {255, 1023, 4095, 16383, 65535, 4095 * 16})
    for (const char* name : {"deep.png", "deep.tif", "deep.pgm"}) {
      cv::Mat deep = ramp(CV_16U, white / 255.0);
      deep.at<std::uint16_t>(3, 3) = 0;
      deep.at<std::uint16_t>(4, 4) = 65535;  // a hot pixel
      cv::imwrite((folder.path() / name).string(), deep);
      expect_ramp(load_image(folder.path() / name), 0, name + std::to_string(white));
    }
  for (const double white : {1.0, 255.0, 65535.0}) {
    cv::imwrite((folder.path() / "real.tif").string(), ramp(CV_32F, white / 255));
    expect_ramp(load_image(folder.path() / "real.tif"), 0, "real " + std::to_string(white));
  }
}

TEST(LoadImage, LeavesHotPixelsOut) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "hot.png";
  const auto with_hot_pixels = [&](int count) {
    cv::Mat deep = ramp(CV_16U, 4095 / 255.0);
    for (int i = 0; i < count; ++i) deep.at<std::uint16_t>(20 + i / 200, i % 200) = 65535;
    cv::imwrite(file.string(), deep);
    return load_image(file);
  };
  expect_ramp(with_hot_pixels(40), 0, "0.3 %");
  expect_ramp(with_hot_pixels(120), 0, "0.9 %");
  EXPECT_EQ(with_hot_pixels(1000).at(255, 10), 16);  // 8 %: a bright surface
}

TEST(LoadImage, KnowsWhereASignedTypeEnds) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "signed.tif";
  cv::imwrite(file.string(), ramp(CV_16S, 100));
  if (cv::imread(file.string(), cv::IMREAD_UNCHANGED).depth() != CV_16S)
    GTEST_SKIP() << "this OpenCV writes no signed TIFF";
  EXPECT_NEAR(load_image(file).at(255, 10), 255 * 25500.0 / 32767, 1);
}

TEST(LoadImage, SpreadsTheValuesOfAnImageWithLittleContrast) {
  const TemporaryFolder folder;
  for (const auto& [scale, offset] : {std::pair{20.0, 30000.0}, {2.0, 1000.0}, {0.05, -6.0}}) {
    const bool real = offset < 0;
    const auto file = folder.path() / (real ? "low.tif" : "low.png");
    cv::imwrite(file.string(), ramp(real ? CV_32F : CV_16U, scale, offset));
    const Image image = load_image(file);
    EXPECT_NEAR(image.at(0, 10), 10, 1) << scale;
    EXPECT_NEAR(image.at(127, 10), 10 + 235 * 127 / 255.0, 1) << scale;
    EXPECT_NEAR(image.at(255, 10), 245, 1) << scale;
  }
  cv::Mat flat(20, 20, CV_16U, cv::Scalar(1000));  // noise is not enlarged
  flat.at<std::uint16_t>(5, 5) = 1010;
  cv::imwrite((folder.path() / "flat.png").string(), flat);
  const Image image = load_image(folder.path() / "flat.png");
  EXPECT_EQ(image.at(5, 5) - image.at(6, 6), 10);
}

TEST(LoadImage, TakesAStatedRange) {
  const TemporaryFolder folder;
  cv::imwrite((folder.path() / "deep.png").string(), ramp(CV_16U, 10, 2000));
  cv::imwrite((folder.path() / "grey.png").string(), ramp(CV_8U, 1));
  ImageOptions options;
  options.scaling = GreyScaling::Quantiles;
  expect_ramp(load_image(folder.path() / "deep.png", options), 1, "quantiles");
  options.scaling = GreyScaling::Full;
  EXPECT_EQ(load_image(folder.path() / "deep.png", options).at(255, 10),
            std::lround(4550 * 255.0 / 65535));
  options.black_white = {2000, 4550};
  expect_ramp(load_image(folder.path() / "deep.png", options), 0, "stated");
  options.black_white = {100, 151};
  const Image grey = load_image(folder.path() / "grey.png", options);
  EXPECT_EQ(grey.at(90, 10), 0);
  EXPECT_EQ(grey.at(110, 10), 50);
  EXPECT_EQ(grey.at(160, 10), 255);
  options.black_white = {5, 5};
  expect_input_error([&] { options.validate(); }, {"image_range", "black below white"});
}

TEST(LoadImage, LeavesWhatIsNoNumberBlack) {
  const TemporaryFolder folder;
  cv::Mat real = ramp(CV_32F, 1 / 255.0);
  real.at<float>(3, 200) = NAN;
  real.at<float>(4, 200) = INFINITY;
  real.at<float>(5, 200) = -INFINITY;
  cv::imwrite((folder.path() / "real.tif").string(), real);
  CollectedLog log;
  const Image image = load_image(folder.path() / "real.tif");
  expect_ramp(image, 0, "around");
  EXPECT_EQ(image.at(200, 3), 0);
  EXPECT_EQ(image.at(200, 4), 255);
  EXPECT_EQ(image.at(200, 5), 0);
  cv::imwrite((folder.path() / "none.tif").string(), cv::Mat(20, 20, CV_32F, cv::Scalar(NAN)));
  expect_input_error([&] { load_image(folder.path() / "none.tif"); },
                     {"none.tif", "pixels", "none that is finite"});
}

// A colour that each pattern must find in its own places; the wrong pattern finds another grey.
TEST(LoadImage, InterpolatesMosaics) {
  const TemporaryFolder folder;
  const double grey = 0.299 * 200 + 0.587 * 100 + 0.114 * 50;
  const auto value = [](char colour) { return colour == 'r' ? 200 : colour == 'g' ? 100 : 50; };
  const std::vector<std::pair<BayerPattern, std::string>> patterns{{BayerPattern::RGGB, "rggb"},
                                                                   {BayerPattern::BGGR, "bggr"},
                                                                   {BayerPattern::GRBG, "grbg"},
                                                                   {BayerPattern::GBRG, "gbrg"}};
  for (const auto& [pattern, letters] : patterns)
    for (const int type : {CV_8U, CV_16U}) {
      cv::Mat mosaic(40, 60, CV_8U);
      for (int y = 0; y < mosaic.rows; ++y)
        for (int x = 0; x < mosaic.cols; ++x)
          mosaic.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(
              value(letters[static_cast<std::size_t>(2 * (y % 2) + x % 2)]));
      mosaic.convertTo(mosaic, type, type == CV_8U ? 1 : 257);
      cv::imwrite((folder.path() / "mosaic.png").string(), mosaic);
      ImageOptions options;
      options.black_white = {0, type == CV_8U ? 255.0 : 65535.0};
      for (const auto& [tried, name] : patterns) {
        options.bayer = tried;
        const double found = load_image(folder.path() / "mosaic.png", options).at(30, 20);
        if (tried == pattern)
          EXPECT_NEAR(found, grey, 2) << name;
        else
          EXPECT_GT(std::abs(found - grey), 5) << letters << " as " << name;
      }
    }
  cv::imwrite((folder.path() / "colour.png").string(), cv::Mat(20, 20, CV_8UC3, cv::Scalar(9)));
  ImageOptions options;
  options.bayer = BayerPattern::RGGB;
  expect_input_error([&] { load_image(folder.path() / "colour.png", options); },
                     {"colour.png", "channels", "found 3", "1 with bayer"});
}

TEST(LoadImage, ReadsFilesWithoutAHeaderOfAStatedSize) {
  const TemporaryFolder folder;
  std::string bytes, words;
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 30; ++x) {
      bytes += static_cast<char>(5 * x + y);
      words += {'\0', static_cast<char>(x == 29 ? 255 : 5 * x + y)};  // the low byte first
    }
  const auto grey = folder.write("a.raw", bytes), deep = folder.write("b", words);
  ImageOptions options;
  options.raw_size_px = {30, 20};
  EXPECT_EQ(load_image(grey, options).at(12, 3), 63);
  EXPECT_NEAR(load_image(deep, options).at(12, 3), 63, 1);
  options.raw_size_px = {30, 21};
  expect_input_error([&] { load_image(grey, options); },
                     {"a.raw", "600 bytes", "630 or 1260", "30x21", "raw_size"});
  expect_input_error([&] { load_image(grey); }, {"a.raw", "no image decoder"});
}

// The content says what a file is.
TEST(LoadImage, ReadsEveryFormatUnderEveryName) {
  const TemporaryFolder folder;
  const cv::Mat grey = ramp(CV_8U, 1);
  for (const char* ending : {".png", ".bmp", ".tif", ".pgm", ".jp2", ".webp", ".ras", ".pfm"}) {
    cv::Mat pixels = grey;
    if (ending == std::string(".pfm")) pixels = ramp(CV_32F, 1 / 255.0);
    std::vector<std::uint8_t> bytes;
    cv::imencode(ending, pixels, bytes, {cv::IMWRITE_WEBP_QUALITY, 101});
    const std::string content(bytes.begin(), bytes.end());
    for (const char* name : {"x.PNG", "no_ending", "a b.1", "f\xc3\xa4rbung%03d#7.jpg"}) {
      const auto file = folder.write(name, content);
      expect_ramp(load_image(file), 1, std::string(ending) + " as " + name);
      EXPECT_TRUE(is_image_file(file)) << ending << " as " << name;
    }
  }
  EXPECT_FALSE(is_image_file(folder.write("note", "BMW and Porsche")));
  EXPECT_FALSE(is_image_file(folder.write("results.csv", "scene_id,im_id")));
  EXPECT_FALSE(is_image_file(folder.path()));
}

TEST(LoadImage, ReadsOneBitAndPalettes) {
  const TemporaryFolder folder;
  std::string bits = "P4\n32 16\n";
  for (int y = 0; y < 16; ++y) bits += "\xff\xff" + std::string(2, '\0');  // 1 is black
  const Image image = load_image(folder.write("bits.pbm", bits));
  EXPECT_EQ(image.at(3, 3), 0);
  EXPECT_EQ(image.at(20, 3), 255);
  cv::imwrite((folder.path() / "bits.png").string(), cv::Mat(20, 20, CV_8U, cv::Scalar(255)),
              {cv::IMWRITE_PNG_BILEVEL, 1});
  EXPECT_EQ(load_image(folder.path() / "bits.png").at(3, 3), 255);
}

// Grey by Rec. 601, from the colours that the indices mean.
TEST(LoadImage, LooksUpColoursOfPalettes) {
  const TemporaryFolder folder;
  // 16x16, one bit: the left half has the colour (200, 30, 60), the right one (10, 240, 90).
  constexpr char png[] =
      "\x89\x50\x4e\x47\x0d\x0a\x1a\x0a\x00\x00\x00\x0d\x49\x48\x44\x52\x00\x00\x00\x10\x00\x00"
      "\x00\x10\x01\x03\x00\x00\x00\x25\x3d\x6d\x22\x00\x00\x00\x06\x50\x4c\x54\x45\xc8\x1e\x3c"
      "\x0a\xf0\x5a\xaf\x64\x97\x6d\x00\x00\x00\x0e\x49\x44\x41\x54\x78\xda\x63\x60\xf8\xcf\x40"
      "\x0a\x02\x00\x76\xc7\x0f\xf1\xf9\xef\x6f\xae\x00\x00\x00\x00\x49\x45\x4e\x44\xae\x42\x60"
      "\x82";
  std::string bmp("BM\0\0\0\0\0\0\0\0\x3e\0\0\0\x28\0\0\0\x10\0\0\0\x10\0\0\0\x01\0\x01\0", 30);
  bmp += std::string(16, '\0') + std::string("\x02\0\0\0\0\0\0\0", 8) +
         std::string("\x3c\x1e\xc8\0\x5a\xf0\x0a\0", 8);
  for (int y = 0; y < 16; ++y) bmp += std::string("\0\xff\0\0", 4);
  for (const auto& file :
       {folder.write("a.png", std::string(png, sizeof png - 1)), folder.write("a.bmp", bmp)}) {
    const Image image = load_image(file);
    EXPECT_NEAR(image.at(3, 9), 0.299 * 200 + 0.587 * 30 + 0.114 * 60, 1) << file;
    EXPECT_NEAR(image.at(12, 9), 0.299 * 10 + 0.587 * 240 + 0.114 * 90, 1) << file;
  }
}

// A TIFF of 16x16 pixels of one colour.
TEST(LoadImage, ReadsInksAsTheColourTheyPrint) {
  std::string tiff("II*\0\x08\0\0\0", 8);
  const auto put = [&](std::uint32_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) tiff += char(value >> 8 * i);
  };
  constexpr std::uint32_t width = 256, height = 257, depth = 258, compression = 259, inks = 262,
                          offset = 273, samples = 277, bytes_of_strip = 279, bits_at = 110;
  const std::uint32_t fields[][4] = {{width, 3, 1, 16},      {height, 3, 1, 16},
                                     {depth, 3, 4, bits_at}, {compression, 3, 1, 1},
                                     {inks, 3, 1, 5},        {offset, 4, 1, bits_at + 8},
                                     {samples, 3, 1, 4},     {bytes_of_strip, 4, 1, 1024}};
  put(std::size(fields), 2);
  for (const auto& [tag, type, count, value] : fields)
    put(tag, 2), put(type, 2), put(count, 4), put(value, 4);
  put(0, 4);
  for (int i = 0; i < 4; ++i) put(8, 2);
  for (int i = 0; i < 256; ++i) tiff += "\x0a\xc8\x64\x32";  // C, M, Y, K
  const TemporaryFolder folder;
  const double light = (255 - 50) / 255.0;
  EXPECT_NEAR(load_image(folder.write("inks.tif", tiff)).at(5, 5),
              light * (0.299 * (255 - 10) + 0.587 * (255 - 200) + 0.114 * (255 - 100)), 2);
}

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

TEST(LoadImage, ReadsTheFirstOfSeveralPagesAndSaysSo) {
  const TemporaryFolder folder;
  cv::imwritemulti((folder.path() / "pages.tif").string(),
                   std::vector<cv::Mat>{ramp(CV_8U, 1), cv::Mat(20, 20, CV_8U, cv::Scalar(3))});
  CollectedLog log;
  expect_ramp(load_image(folder.path() / "pages.tif"), 0, "first page");
  ASSERT_EQ(log.messages.size(), 1u);
  EXPECT_NE(log.messages[0].second.find("pages: found several"), std::string::npos);
}

// Netpbm: the header says which value is white. 255 and 65535 say nothing of what a camera fills.
TEST(LoadImage, TakesTheWhiteThatPortableFilesState) {
  const auto middle = [](const std::string& header, const std::string& pixel) {
    std::string bytes = header;
    for (int i = 0; i < 16 * 16; ++i) bytes += pixel;
    return int(decode_image(bytes, "x").pixels[100]);
  };
  const std::string two("\x01\xf4", 2);
  EXPECT_EQ(middle("P5 16 16 100\n", "\x32"), 128);
  EXPECT_EQ(middle("P6\n16 16\n100\n", "\x32\x32\x32"), 128);
  EXPECT_EQ(middle("P5 16 16 1000\n", two), 128);
  EXPECT_EQ(middle("P5 16 16 255\n", "\x32"), 50);
  EXPECT_EQ(middle("P2 16 16 100\n", "50 "), 127);  // OpenCV scales text itself
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
