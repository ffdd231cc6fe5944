// --symmetry: by object, in place of what files say, in every verb.
#include <gtest/gtest.h>

#include "host/cli/symmetry_arguments.h"
#include "host/io/bop.h"
#include "host/model/axis_symmetry.h"
#include "host/render/parts.h"
#include "tests/cli/example_scene.h"
#include "tests/io/collected_log.h"
#include "tests/io/expect_input_error.h"

namespace edgescout::test {
namespace {

TEST(StatedSymmetries, BelongToTheObjectThatTheyName) {
  const Mesh mesh = make_part("l_bracket").mesh;
  const StatedSymmetries of_one({"z2", "x2"}, {7});
  EXPECT_EQ(of_one.of(7, mesh, 8).value().discrete.size(), 4u);
  const StatedSymmetries of_two({"5:z4", "7:y", "5:x2"}, {5, 6, 7});
  EXPECT_EQ(of_two.of(5, mesh, 8).value().discrete.size(), 8u);
  EXPECT_EQ(of_two.of(7, mesh, 16).value().discrete.size(), 16u);
  EXPECT_FALSE(of_two.of(6, mesh, 8).has_value());
}

TEST(StatedSymmetries, RejectWordsOfNoObject) {
  const Mesh mesh = make_part("l_bracket").mesh;
  expect_input_error([] { StatedSymmetries({"z2"}, {1, 2}); }, {"--symmetry", "z2", "ID:z2"});
  expect_input_error([] { StatedSymmetries({"3:z2"}, {1, 2}); }, {"--symmetry", "3:z2", "id"});
  expect_input_error([] { StatedSymmetries({"a:z2"}, {1}); }, {"--symmetry", "a:z2", "id"});
  expect_input_error([&] { StatedSymmetries({"1:"}, {1}).of(1, mesh, 8); }, {"symmetry"});
  expect_input_error([&] { StatedSymmetries({"z1"}, {1}).of(1, mesh, 8); }, {"symmetry", "z1"});
}

TemplateSet bracket_with(const std::vector<std::string>& words) {
  const Object bracket = make_part("l_bracket");
  TemplateSet set;
  set.object_id = 1;
  set.model.mesh = bracket.mesh;
  set.symmetries = axis_symmetries(bracket.mesh, words);
  return set;
}

// A file has no templates of views that are equal by its own symmetries.
TEST(StatedSymmetries, OfTemplatesHoldThoseOfTheFile) {
  CollectedLog log;
  TemplateSet set = bracket_with({"z2"});
  const auto stated = [&](const std::vector<std::string>& words) {
    return axis_symmetries(set.model.mesh, words);
  };
  replace_symmetries(set, stated({"z4"}), "part.est");
  EXPECT_EQ(set.symmetries.discrete.size(), 4u);
  ASSERT_EQ(log.messages.size(), 1u);
  for (const char* word : {"object 1", "--symmetry", "part.est", "replace"})
    EXPECT_NE(log.messages[0].second.find(word), std::string::npos) << log.messages[0].second;
  replace_symmetries(set, stated({"z"}), "part.est");
  EXPECT_EQ(set.symmetries.discrete.size(), 64u);
  set = bracket_with({"z4"});
  expect_input_error([&] { replace_symmetries(set, stated({"z2"}), "part.est"); },
                     {"part.est", "--symmetry", "lack"});
}

TEST(Symmetry, IsRefusedByEveryVerbWhereItIsNone) {
  const TemporaryFolder folder;
  const std::string out = folder.path() / "out", poses = folder.path() / "r.csv";
  save_bop_results(true_results(load_bop_scene(one_view()), 0), poses);
  const std::vector<std::string> model{"--model", part_file(1), "--unit", "mm", "--symmetry", "q4"};
  const std::vector<std::vector<std::string>> verbs{
      {"detect", one_view(), "--out", out},
      {"register", one_view(), "--poses", poses, "--out", out},
      {"explain", one_view(), "--truth", "--out", out},
      {"scout", two_views(), "--out", out},
      {"eval", poses, one_view()},
  };
  for (const std::vector<std::string>& verb : verbs) {
    const Outcome outcome = run_program(joined({verb, model}));
    EXPECT_EQ(outcome.exit_code, 2) << verb[0];
    EXPECT_TRUE(is_one_line_error(outcome.err)) << outcome.err;
    for (const char* word : {"--symmetry", "\"q4\"", "z2"})
      EXPECT_NE(outcome.err.find(word), std::string::npos) << verb[0] << ": " << outcome.err;
  }
}

TEST(Symmetry, WarnsOfAFileThatLacksTheObject) {
  const TemporaryFolder folder;
  const fs::path poses = folder.path() / "r.csv", info = folder.write("info.json", "{\"77\": {}}");
  save_bop_results(true_results(load_bop_scene(one_view()), 0), poses);
  const auto evaluated = [&](const std::vector<std::string>& more) {
    return run_program(joined({{"eval", poses, one_view(), "--model", part_file(2), "--unit", "mm",
                                "--models-info", info},
                               more}));
  };
  const Outcome outcome = evaluated({});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("info.json: object 2: found nothing"), std::string::npos)
      << outcome.err;
  EXPECT_EQ(evaluated({"--symmetry", "y2"}).err.find("found nothing"), std::string::npos);
}

// The second half turn of eval's figures is right only where the symmetry is known.
TEST(Symmetry, JudgesLikeTheFileThatItReplaces) {
  const TemporaryFolder folder;
  const fs::path poses = folder.path() / "r.csv";
  std::vector<BopResult> turned = true_results(load_bop_scene(one_view()), 0);
  std::erase_if(turned, [](const BopResult& row) { return row.object_id != 2; });
  ASSERT_FALSE(turned.empty());
  const Mesh mesh = load_mesh(part_file(2), LengthUnit::Millimetre);
  const Symmetries half = axis_symmetries(mesh, std::vector<std::string>{"y2"});
  for (BopResult& row : turned) row.camera_from_object = row.camera_from_object * half.discrete[1];
  save_bop_results(turned, poses);
  const auto evaluated = [&](const std::vector<std::string>& more) {
    return run_program(
        joined({{"eval", poses, one_view(), "--model", part_file(2), "--unit", "mm"}, more}));
  };
  const Outcome stated = evaluated({"--symmetry", "y2"}), by_file = evaluated(models_info());
  EXPECT_EQ(stated.exit_code, 0) << stated.err;
  EXPECT_EQ(stated.out, by_file.out);
  EXPECT_NE(stated.out, evaluated({}).out);
  const Outcome both = evaluated(joined({models_info(), {"--symmetry", "y4"}}));
  EXPECT_NE(both.err.find("replace the 1 of "), std::string::npos) << both.err;
}

}  // namespace
}  // namespace edgescout::test
