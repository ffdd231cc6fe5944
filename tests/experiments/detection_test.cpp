// Tests the rows of the detectors' scores and the text of their report.
#include "host/experiments/detection.h"

#include <gtest/gtest.h>

#include <map>

#include "host/experiments/known_scene.h"
#include "host/experiments/photographs.h"
#include "host/experiments/rates.h"

namespace edgescout::test {
namespace {

ExperimentSettings one_small_image() {
  ExperimentSettings settings;
  settings.scenes = 1;
  settings.candidates = 120;
  settings.image_scale = 0.25;
  settings.supersampling = 1;
  return settings;
}

// The visible fraction distinguishes the instances.
TEST(DetectionRows, SayHowMuchOfAnInstanceShows) {
  const ExperimentSettings settings = one_small_image();
  const std::unique_ptr<Backend> backend = make_cpu_backend(1);
  const Table table = detection_experiment().cells(settings).at(0).run(*backend);
  const KnownScene scene = rendered_scene("scene_000", rendered_types(),
                                          single_image_options(settings, 0), backend->threads());
  std::map<std::string, std::string> visible{{"", ""}};  // by instance
  for (const KnownInstance& instance : scene.instances)
    visible[instance.name] = number_text(instance.visible);
  ASSERT_GT(visible.size(), 1u);
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    EXPECT_EQ(text_in(table, row, "visible"), visible.at(text_in(table, row, "instance")));
  EXPECT_EQ(values_of(table, "instance").size(), visible.size())
      << "each has candidates, and there are others";
}

// Each cost is capped by itself: the mean of a candidate that lies in the clutter falls, none
// rises.
TEST(DetectionRows, CostNoMoreUnderTheLowerCap) {
  const std::unique_ptr<Backend> backend = make_cpu_backend(1);
  const Table table = detection_experiment().cells(one_small_image()).at(0).run(*backend);
  ASSERT_FALSE(table.rows.empty());
  int less = 0, between = 0;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const double capped = number_in(table, row, "fdcm_cap_px"),
                 full = number_in(table, row, "fdcm_px");
    EXPECT_LE(capped, full + 1e-3) << row;
    EXPECT_LE(capped, 15.01) << row;  // values are rounded
    less += capped < full - 1e-3;
    between += capped < full - 1e-3 && full < 15;
  }
  EXPECT_GT(less, 0);
  EXPECT_GT(between, 0) << "it is no cap of the mean";
}

// One candidate of an instance and one of none, with the columns of rows from before there was
// `visible`.
Table older_rows() {
  return {{},
          {"set", "image", "object", "instances", "candidate", "instance", "fdcm_px", "fdcm_lsd_px",
           "fdcm_own_px", "fdcm_cap_px", "line2d"},
          {{"rendered", "scene_000", "part", "1", "0", "part_0", "1", "1", "1", "1", "90"},
           {"rendered", "scene_000", "part", "1", "1", "", "5", "5", "5", "5", "20"}}};
}

TEST(DetectionReport, IsMadeOfOlderRowsToo) {
  const std::string text = detection_experiment().report({}, older_rows()).markdown;
  EXPECT_NE(text.find("| rendered, all types | FDCM | 100 %"), std::string::npos) << text;
}

TEST(DetectionReport, NotesThatPhotographsOfOneSceneCountAsIndependent) {
  ExperimentSettings settings;
  EXPECT_EQ(
      detection_experiment().report(settings, older_rows()).markdown.find(PHOTOGRAPHS_COUNT_APART),
      std::string::npos)
      << "there are none without data";
  settings.data = "data";
  EXPECT_NE(
      detection_experiment().report(settings, older_rows()).markdown.find(PHOTOGRAPHS_COUNT_APART),
      std::string::npos);
}

}  // namespace
}  // namespace edgescout::test
