// Results note their data, so that results of other data are not mixed with them.
#include "host/experiments/data_mark.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "host/experiments/experiment.h"
#include "tests/io/expect_input_error.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

constexpr const char* FILES[] = {"d2co-starts/ground_truth.json",
                                 "d2co-starts/starts.csv",
                                 "brackets/000001/scene_camera.json",
                                 "brackets/000001/scene_gt.json",
                                 "brackets/000002/scene_camera.json",
                                 "brackets/000002/scene_gt.json",
                                 "cat/scene_camera.json",
                                 "cat/scene_gt.json",
                                 "triangle/scene_camera.json",
                                 "triangle/scene_gt.json",
                                 "brackets/models/models_info.json",
                                 "brackets/models/obj_000001.ply",
                                 "cat/models/obj_000001.ply",
                                 "triangle/models/obj_000001.ply",
                                 "cad/AX-01_bearing_box.stl",
                                 "cad/flange.stl",
                                 "cad/t13.stl"};

void write_data(const TemporaryFolder& folder) {
  for (const char* file : FILES) folder.write(file, file);
}

TEST(DataMark, IsOfTheContentAlone) {
  const TemporaryFolder a, b;
  write_data(a);
  write_data(b);
  EXPECT_EQ(data_mark(a.path()), data_mark(b.path()));
  std::set<std::string> marks{data_mark(a.path())};
  for (const char* file : FILES) {
    b.write(file, "another");
    EXPECT_TRUE(marks.insert(data_mark(b.path())).second) << file;
  }
}

// Symmetries, meshes and images decide what is right as much as truths do.
TEST(DataMark, IsOfWhateverLiesInTheSets) {
  const TemporaryFolder folder;
  write_data(folder);
  const std::string before = data_mark(folder.path());
  folder.write("cat/models/models_info.json", "{}");
  const std::string with = data_mark(folder.path());
  EXPECT_NE(with, before);
  folder.write("cat/models/models_info.json", "{ }");
  EXPECT_NE(data_mark(folder.path()), with);
  folder.write("elsewhere/notes.txt", "");
  std::filesystem::remove(folder.path() / "cat/models/models_info.json");
  EXPECT_EQ(data_mark(folder.path()), before);
}

TEST(DataMark, NamesWhatIsMissing) {
  const TemporaryFolder folder;
  for (const char* file : FILES) {
    expect_input_error([&] { data_mark(folder.path()); }, {file});
    folder.write(file, "");
  }
}

TEST(DataMark, IsNotedByEveryExperimentThatReadsData) {
  const TemporaryFolder folder;
  write_data(folder);
  ExperimentSettings settings;
  settings.data = folder.path();
  for (const Experiment& experiment :
       experiments_named({"detection", "registration", "multiview", "nbv"})) {
    const Notes notes = experiment.options(settings);
    EXPECT_NE(std::ranges::find(
                  notes, std::pair<std::string, std::string>("data", data_mark(folder.path()))),
              notes.end())
        << experiment.name;
  }
}

}  // namespace
}  // namespace edgescout::test
