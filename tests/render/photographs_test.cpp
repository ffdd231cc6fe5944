#include "host/render/photographs.h"

#include <gtest/gtest.h>

#include <set>

#include "host/io/image.h"
#include "tests/io/expect_input_error.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

// Grey rises with x in one, with y in the other.
Image ramp(bool along_x) {
  Image image{100, 80, {}};
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 100; ++x)
      image.pixels.push_back(static_cast<std::uint8_t>(along_x ? 2 * x : 2 * y));
  return image;
}

TEST(Photographs, AreFoundInFoldersBelow) {
  const TemporaryFolder folder;
  folder.write("notes.txt", "no image");
  folder.write("b/c/.keep", "");
  save_png(ramp(true), folder.path() / "b/c/x.PNG");
  save_png(ramp(false), folder.path() / "b/y.png");
  save_png(ramp(false), folder.path() / "b/z.png");
  const PhotographFolders expected{{folder.path() / "b/y.png", folder.path() / "b/z.png"},
                                   {folder.path() / "b/c/x.PNG"}};
  EXPECT_EQ(list_photographs(folder.path()), expected);
}

TEST(Photographs, AFolderWithoutAnyIsRefused) {
  const TemporaryFolder folder;
  folder.write("notes.txt", "no image");
  expect_input_error([&] { list_photographs(folder.path()); },
                     {folder.path().string(), "no image"});
  expect_input_error([&] { list_photographs(folder.path() / "missing"); }, {"missing"});
}

TEST(Photographs, ACropIsAPartOfOneOfThem) {
  const TemporaryFolder folder;
  save_png(ramp(true), folder.path() / "x.png");
  const PhotographFolders files = list_photographs(folder.path());
  std::set<int> widths, left;
  bool mirrored = false;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Image crop = random_crop(files, 40, 30, Random(seed));
    ASSERT_EQ(crop.pixels.size(), 1200u);
    const int first = crop.at(0, 15), last = crop.at(39, 15);
    EXPECT_NEAR(crop.at(20, 2), crop.at(20, 28), 1) << "the ramp has no slope along y";
    mirrored |= last < first;
    widths.insert(std::abs(last - first) / 10);
    left.insert(std::min(first, last) / 10);
    EXPECT_EQ(crop.pixels, random_crop(files, 40, 30, Random(seed)).pixels);
  }
  EXPECT_TRUE(mirrored);
  EXPECT_GT(widths.size(), 3u) << "of several scales";
  EXPECT_GT(left.size(), 3u) << "at several places";
}

TEST(Photographs, ASequenceCountsNoMoreThanASingleImage) {
  const TemporaryFolder folder;
  for (const char* name : {"a/0.png", "a/1.png", "a/2.png", "a/3.png", "b/0.png"}) {
    folder.write(name, "");
    save_png(ramp(name[0] == 'a'), folder.path() / name);
  }
  const PhotographFolders files = list_photographs(folder.path());
  int single = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Image crop = random_crop(files, 40, 30, Random(seed));
    single += crop.at(20, 28) > crop.at(20, 2) + 4;  // it rises with y
  }
  EXPECT_GT(single, 15);
  EXPECT_LT(single, 45);
}

TEST(Photographs, AFileThatIsNoImageIsNamed) {
  const TemporaryFolder folder;
  folder.write("broken.png", "not a png");
  const PhotographFolders files = list_photographs(folder.path());
  expect_input_error([&] { random_crop(files, 40, 30, Random(1)); }, {"broken.png"});
}

TEST(Photographs, TilesAreMirroredAtTheirBorders) {
  const Image tiles = mirrored_tiles(ramp(true), 256);
  EXPECT_EQ(tiles.at(99, 3), tiles.at(100, 3));
  EXPECT_EQ(tiles.at(0, 3), tiles.at(199, 3));
  EXPECT_EQ(tiles.at(10, 3), tiles.at(210, 3));
}

}  // namespace
}  // namespace edgescout::test
