#include "host/io/image.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "tests/io/collected_log.h"
#include "tests/io/expect_input_error.h"
#include "tests/io/gradient_image.h"
#include "tests/io/grey_ramp.h"
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
