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

TEST(ExifOrientation, IsReadFromOtherFiles) {
  const std::string tag("II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x03\0\0\0\0\0\0\0", 26);
  const std::string png = std::string("\x89PNG\r\n\x1a\n\0\0\0\x01zzzz.CRC.", 21) +
                          std::string(
                              "\0\0\0\x1a"
                              "eXIf",
                              8) +
                          tag;
  const std::string webp =
      std::string("RIFF\0\0\0\0WEBPVP8X\x03\0\0\0abc.EXIF\x1a\0\0\0", 32) + tag;
  for (const std::string& bytes : {tag, png, webp}) {
    EXPECT_EQ(exif_orientation(bytes), 3);
    for (std::size_t i = 0; i < bytes.size(); ++i)
      EXPECT_GE(exif_orientation(bytes.substr(0, i)), 1);
  }
}

// A TIFF file of one grey strip. Each tag is a number of two bytes.
std::string tiff_of(const std::string& pixels, std::vector<std::pair<int, int>> tags) {
  const auto number = [](int value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> 8 * i);
    return text;
  };
  constexpr int strip_at = 273, strip_bytes = 279, of_two_bytes = 3, of_four_bytes = 4;
  tags.insert(tags.end(), {{strip_at, 8}, {strip_bytes, int(pixels.size())}});
  std::sort(tags.begin(), tags.end());
  std::string file = "II*" + std::string(1, '\0') + number(8 + int(pixels.size()), 4) + pixels +
                     number(int(tags.size()), 2);
  for (const auto& [tag, value] : tags)
    file += number(tag, 2) + number(value < 65536 ? of_two_bytes : of_four_bytes, 2) +
            number(1, 4) + number(value, 4);
  return file + number(0, 4);
}

std::vector<std::pair<int, int>> grey_tags(int width, int height, int bits) {
  return {{256, width}, {257, height}, {258, bits}, {259, 1}, {262, 1}, {277, 1}, {278, height}};
}

TEST(LoadImage, KeepsThePixelsOfATurnedTiffAsTheyAreStored) {
  const Image grey = gradient_image(24, 16);
  const std::string pixels(grey.pixels.begin(), grey.pixels.end());
  for (int orientation = 1; orientation <= 8; ++orientation) {
    auto tags = grey_tags(24, 16, 8);
    tags.emplace_back(274, orientation);
    const Image image = decode_image(tiff_of(pixels, tags), "x.tiff");
    EXPECT_EQ(image.width, 24) << orientation;
    EXPECT_EQ(image.pixels, grey.pixels) << orientation;
  }
}

TEST(LoadImage, TakesZeroForWhiteWhereATiffSaysSo) {
  const Image grey = gradient_image(24, 16);
  for (const int bits : {8, 16}) {
    std::string inverted;
    for (const std::uint8_t pixel : grey.pixels)
      inverted.append(bits / 8, static_cast<char>(255 - pixel));  // 257 * (255 - pixel)
    auto tags = grey_tags(24, 16, bits);
    tags[4].second = 0;  // the photometric interpretation
    const Image image = decode_image(tiff_of(inverted, tags), "x.tiff");
    EXPECT_EQ(image.pixels, grey.pixels) << bits;
  }
}

TEST(LoadImage, RefusesTiffPixelsItDoesNotRead) {
  const std::string pixels(4 * 24 * 16, 'x');
  const auto refused = [&](int bits, std::pair<int, int> tag, std::string_view word) {
    auto tags = grey_tags(24, 16, bits);
    std::erase_if(tags, [&](const auto& other) { return other.first == tag.first; });
    tags.push_back(tag);
    const std::string file = tiff_of(pixels, tags);
    expect_input_error([&] { decode_image(file, "x.tiff"); }, {"x.tiff", std::string(word)});
  };
  refused(16, {339, 3}, "real numbers of 16 bit");
  refused(32, {339, 1}, "whole numbers of 32 bit");
  refused(8, {262, 32803}, "raw values of a sensor");
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

// The decoder would write a line of its own to standard error.
TEST(LoadImage, SaysInOneLineThatAPngIsDamaged) {
  cv::Mat noise(20, 20, CV_8U);
  cv::randu(noise, 0, 255);
  std::vector<unsigned char> encoded;
  cv::imencode(".png", noise, encoded);
  const std::string whole(encoded.begin(), encoded.end());
  testing::internal::CaptureStderr();
  for (std::size_t i = 4; i < whole.size(); ++i)
    for (const char changed : {char(whole[i] ^ 0x20), char(whole[i] ^ 1), '\xff'}) {
      std::string damaged = whole;
      damaged[i] = changed;
      if (changed != whole[i])
        expect_input_error([&] { decode_image(damaged, "x.png"); }, {"x.png", "found", "expected"});
    }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(LoadImage, ReadsPngWithUnknownNotesAndNoOtherUnknownChunk) {
  cv::Mat grey(20, 20, CV_8U, cv::Scalar(77));
  std::vector<unsigned char> encoded;
  cv::imencode(".png", grey, encoded);
  constexpr std::size_t header_end = 33;
  const auto with_chunk = [&](const std::string& chunk) {
    std::string png(encoded.begin(), encoded.end());
    return png.insert(header_end, chunk);
  };
  const std::string note(
      "\0\0\0\0anNo"
      "\x53\x60\xb7\x12",
      12),
      needed(
          "\0\0\0\0CgBI"
          "\x28\x32\x21\xd9",
          12);
  EXPECT_EQ(decode_image(with_chunk(note), "x.png").pixels[0], 77);
  expect_input_error([&] { decode_image(with_chunk(needed), "x.png"); }, {"x.png", "CgBI"});
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
