// --shard and merge: the parts of a batch are disjoint, whole, and join to what one run writes.
#include "host/cli/shard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "host/io/files.h"
#include "host/io/results.h"
#include "tests/cli/small_scene.h"
#include "tests/io/expect_input_error.h"

namespace edgescout::test {
namespace {

std::vector<InputImage> numbered_images(int count) {
  std::vector<InputImage> images;
  for (int i = 0; i < count; ++i) {
    InputImage& image = images.emplace_back();
    image.file = "/images/" + std::to_string(i * 7919 % count) + ".png";
    image.name = image.file.stem().string();
  }
  return images;
}

std::set<std::string> names_of(std::span<const InputImage> images) {
  std::set<std::string> names;
  for (const InputImage& image : images) names.insert(image.name);
  return names;
}

TEST(Shard, IsReadFromItsText) {
  EXPECT_EQ(shard_from("1/1"), (Shard{1, 1}));
  EXPECT_EQ(shard_from("12/1000"), (Shard{12, 1000}));
  for (const char* bad : {"", "1", "/", "0/4", "5/4", "-1/4", "1/0", "1/-4", "1/4/2", "a/4", "1/b",
                          " 1/4", "1/4 ", "1.0/4", "1/1000001", "1/99999999999"})
    expect_input_error([&] { shard_from(bad); }, {"--shard: found ", "expected I/N"});
}

TEST(Shard, PartsAreDisjointAndWholeAndOfEqualSize) {
  for (const int count : {1, 2, 7, 100})
    for (const int shards : {1, 2, 3, 8}) {
      const std::vector<InputImage> images = numbered_images(count);
      std::set<std::string> all;
      std::size_t sum = 0, least = images.size(), most = 0;
      for (int i = 1; i <= shards; ++i) {
        const std::set<std::string> part =
            names_of(images_of_shard(images, false, Shard{i, shards}));
        all.insert(part.begin(), part.end());
        sum += part.size();
        least = std::min(least, part.size());
        most = std::max(most, part.size());
      }
      EXPECT_EQ(sum, images.size());
      EXPECT_EQ(all, names_of(images));
      EXPECT_LE(most - least, 1u);
    }
}

TEST(Shard, DoesNotDependOnTheOrderOfTheImages) {
  std::vector<InputImage> images = numbered_images(50);
  const std::set<std::string> before = names_of(images_of_shard(images, false, Shard{2, 3}));
  std::ranges::reverse(images);
  EXPECT_EQ(names_of(images_of_shard(images, false, Shard{2, 3})), before);
}

TEST(Shard, KeepsTheViewsOfASceneTogether) {
  std::vector<InputImage> images;
  for (const char* scene : {"c", "a", "b"})
    for (int view = 0; view < 4; ++view) {
      InputImage& image = images.emplace_back();
      image.scene_folder = std::string("/scenes/") + scene;
      image.file = image.scene_folder / (std::to_string(view) + ".png");
    }
  for (int i = 1; i <= 2; ++i) {
    const std::vector<InputImage> part = images_of_shard(images, true, Shard{i, 2});
    EXPECT_EQ(part.size(), i == 1 ? 8u : 4u);
    std::map<fs::path, int> views;
    for (const InputImage& image : part) ++views[image.scene_folder];
    for (const auto& [scene, count] : views) EXPECT_EQ(count, 4) << scene;
  }
}

// A table without its last column, which is the time.
std::string without_times(const fs::path& csv) {
  std::istringstream lines(content_of(csv));
  std::string text, line;
  while (std::getline(lines, line)) text += line.substr(0, line.rfind(',')) + "\n";
  return text;
}

nlohmann::ordered_json summary_without_times(const fs::path& folder) {
  auto json = nlohmann::ordered_json::parse(content_of(folder / "summary.json"));
  for (const char* name : {"seconds", "images_per_second", "mean_ms_per_image"}) json.erase(name);
  for (auto& origin : json["templates"]) origin = origin.at("object_id");
  return json;
}

// Three images of one scene; the third may be no image.
struct Parts : SmallScene {
  Parts() : SmallScene(3) {}
  std::vector<std::string> call(const std::string& to, const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = detect(scene, joined({bracket(), more}));
    std::ranges::replace(arguments, out.string(), (folder.path() / to).string());
    return arguments;
  }
  Outcome run(const std::string& to, const std::vector<std::string>& more = {}) const {
    return run_program(call(to, more));
  }
  Outcome merge(const std::vector<std::string>& shards, const std::string& to = "merged") const {
    std::vector<std::string> arguments{"merge", "--out", folder.path() / to};
    for (const std::string& shard : shards) arguments.push_back(folder.path() / shard);
    return run_program(arguments);
  }
  fs::path at(const std::string& name) const { return folder.path() / name; }
};

TEST(Merge, JoinsShardsToWhatOneRunWrites) {
  const Parts t;
  t.folder.write("000003/gray/000002.png", "no image");
  ASSERT_EQ(t.run("one").exit_code, 1);
  // The bad image is alone in its shard.
  for (int i = 1; i <= 3; ++i)
    ASSERT_EQ(t.run("s" + std::to_string(i), {"--shard", std::to_string(i) + "/3"}).exit_code,
              i == 3 ? 1 : 0);
  const Outcome outcome = t.merge({"s3", "s1", "s2"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_NE(outcome.out.find("3 images in 3 shards: 2 done, 1 failed, 0 missing"),
            std::string::npos)
      << outcome.out;
  EXPECT_GT(load_bop_results(t.at("one/results.csv")).size(), 0u);
  EXPECT_EQ(without_times(t.at("merged/results.csv")), without_times(t.at("one/results.csv")));
  EXPECT_EQ(summary_without_times(t.at("merged")), summary_without_times(t.at("one")));
  EXPECT_EQ(pictures_in(t.at("merged")).size(), 2u);
  EXPECT_EQ(pictures_in(t.at("merged")), pictures_in(t.at("one")));
  const std::string page = content_of(t.at("merged/report.html"));
  EXPECT_NE(page.find("\"../s1\""), std::string::npos) << "where the overlays lie";
}

TEST(Merge, NamesWhatIsMissing) {
  const Parts t;
  ASSERT_EQ(t.run("s1", {"--shard", "1/2"}).exit_code, 0);
  fs::remove(t.at("s1/000003_000002.json"));
  const Outcome outcome = t.merge({"s1"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_NE(outcome.out.find("1 done, 0 failed, 2 missing"), std::string::npos) << outcome.out;
  for (const char* word : {"missing: shards 2/2", "000002.png"})
    EXPECT_NE(outcome.err.find(word), std::string::npos) << word << " not in " << outcome.err;
  EXPECT_EQ(summary_without_times(t.at("merged")).at("missing").size(), 2u);
}

TEST(Merge, RefusesShardsOfDifferentBatches) {
  const Parts t;
  ASSERT_EQ(t.run("s1", {"--shard", "1/3"}).exit_code, 0);
  ASSERT_EQ(t.run("other", {"--shard", "2/3", "--lambda", "50"}).exit_code, 0);
  const auto expect_merge_refused = [&](const std::vector<std::string>& shards,
                                        std::initializer_list<std::string> words) {
    const Outcome outcome = t.merge(shards);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
    EXPECT_TRUE(is_one_line_error(outcome.err)) << outcome.err;
    for (const std::string& word : words)
      EXPECT_NE(outcome.err.find(word), std::string::npos) << word << " not in " << outcome.err;
    EXPECT_FALSE(fs::exists(t.at("merged"))) << "nothing is written";
  };
  expect_merge_refused({"s1", "other"}, {"other/shard.json: lambda: found 50, expected 30 as in"});
  fs::copy(t.at("s1"), t.at("again"));
  expect_merge_refused({"s1", "again"}, {"shard: found 1/3 a second time"});
  t.folder.write("again/shard.json", "{\"edgescout_shard\": 1");
  expect_merge_refused({"s1", "again"}, {"again/shard.json"});
  expect_merge_refused({"s1", "000003"}, {"000003/shard.json"});
  auto shard = nlohmann::json::parse(content_of(t.at("s1/shard.json")));
  const auto with = [&](const char* field, const nlohmann::json& value) {
    auto changed = shard;
    changed["shard"] = 2;
    changed[field] = value;
    t.folder.write("again/shard.json", changed.dump());
  };
  with("version", "0.1.0");
  expect_merge_refused({"s1", "again"}, {"version: found 0.1.0, expected"});
  with("batch_checksum", "checksum 1");
  expect_merge_refused({"s1", "again"}, {"images of the batch: found 3, checksum 1, expected 3"});
  with("shards", 4);
  expect_merge_refused({"s1", "again"}, {"shards: found 4, expected 3"});
}

TEST(Shard, KeepsToItsFolder) {
  const Parts t;
  ASSERT_EQ(t.run("s", {"--shard", "1/2"}).exit_code, 0);
  for (const std::vector<std::string>& resume : {std::vector<std::string>{}, {"--resume"}}) {
    expect_refused(t.call("s", joined({{"--shard", "2/2"}, resume})),
                   {"shard.json: shard: found 1/2, expected 2/2"});
    expect_refused(t.call("s", joined({{"--shard", "1/3"}, resume})), {"found 1/2, expected 1/3"});
  }
  expect_refused(t.call("s", {"--resume"}), {"shard.json: shard: found 1/2, expected no shard"});
  expect_refused(t.call("s", {"--shard", "3/2"}), {"--shard: found 3/2, expected I/N"});
  EXPECT_EQ(t.run("s", {"--shard", "1/2", "--resume"}).exit_code, 0);
}

TEST(Shard, OfRegisterJoinsToWhatOneRunWrites) {
  const Parts t;
  ASSERT_EQ(t.run("starts").exit_code, 0);
  const auto refine = [&](const std::string& to, const std::vector<std::string>& more) {
    return run_program(
        joined({{"register", t.scene, "--poses", t.at("starts/results.csv"), "--model",
                 part_file(1), "--unit", "mm", "--device", "cpu", "--out", t.at(to)},
                more}));
  };
  ASSERT_LE(refine("one", {}).exit_code, 1);
  for (const char* i : {"1", "2"})
    ASSERT_LE(refine(std::string("r") + i, {"--shard", std::string(i) + "/2"}).exit_code, 1);
  ASSERT_LE(t.merge({"r1", "r2"}).exit_code, 1);
  EXPECT_GT(load_bop_results(t.at("one/results.csv")).size(), 0u);
  EXPECT_EQ(without_times(t.at("merged/results.csv")), without_times(t.at("one/results.csv")));
  EXPECT_EQ(summary_without_times(t.at("merged")), summary_without_times(t.at("one")));
}

}  // namespace
}  // namespace edgescout::test
