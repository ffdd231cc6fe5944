// Captions of points that lie close together can all be read.
#include "host/captions.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/test_random.h"

namespace edgescout::test {
namespace {

using Box = Eigen::AlignedBox2i;

const Eigen::Vector2i picture_px{640, 480}, word_px{120, 14};

std::vector<Box> boxes_of(const std::vector<Caption>& captions) {
  std::vector<Box> boxes;
  const std::vector<Eigen::Vector2i> corners = place_captions(captions, picture_px);
  for (std::size_t i = 0; i < corners.size(); ++i)
    boxes.emplace_back(corners[i], corners[i] + captions[i].size_px);
  return boxes;
}

void expect_apart(const std::vector<Box>& boxes) {
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    EXPECT_TRUE(Box(Eigen::Vector2i::Zero(), picture_px).contains(boxes[i])) << i;
    for (std::size_t j = 0; j < i; ++j) {
      const Box both = boxes[i].intersection(boxes[j]);
      EXPECT_TRUE(both.isEmpty() || both.volume() == 0) << i << " and " << j;
    }
  }
}

TEST(Captions, StandRightOfTheirPointAndAboveIt) {
  const std::vector<Eigen::Vector2i> corners =
      place_captions(std::vector<Caption>{{{300, 200}, word_px}}, picture_px);
  EXPECT_EQ(corners[0], Eigen::Vector2i(306, 200 - 6 - word_px.y()));
}

TEST(Captions, OfOnePointDoNotCoverEachOther) {
  expect_apart(boxes_of(std::vector<Caption>(20, {{300, 200}, word_px})));
}

TEST(Captions, StayInThePicture) {
  expect_apart(boxes_of({{{0, 0}, word_px},
                         {{639, 0}, word_px},
                         {{639, 479}, word_px},
                         {{0, 479}, word_px},
                         {{635, 470}, word_px},
                         {{-50, 500}, word_px}}));
}

TEST(Captions, OfAHeapDoNotCoverEachOther) {
  Random random = test_random();
  std::vector<Caption> captions;
  for (int i = 0; i < 25; ++i)
    captions.push_back({{random.uniform(250, 400), random.uniform(150, 300)}, word_px});
  expect_apart(boxes_of(captions));
}

// A picture too small for all of them.
TEST(Captions, ThatFindNoRoomCoverOthers) {
  const std::vector<Caption> captions(100, {{300, 200}, word_px});
  EXPECT_EQ(place_captions(captions, picture_px).size(), captions.size());
  EXPECT_EQ(place_captions(captions, {10, 5})[99], Eigen::Vector2i(0, 0));
}

}  // namespace
}  // namespace edgescout::test
