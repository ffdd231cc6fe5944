// Inputs behind an option that takes a list.
#include "host/cli/words_behind_lists.h"

#include <gtest/gtest.h>

#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

using Words = std::vector<std::string>;

struct TwoVerbs {
  CLI::App program;
  Words inputs, lists;
  std::string out;

  TwoVerbs() {
    for (const char* verb : {"detect", "eval"}) {
      CLI::App& added = *program.add_subcommand(verb);
      added.add_option("--templates", lists);
      added.add_option("--out", out);
    }
    program.get_subcommand("detect")->add_option("inputs", inputs);
  }
  Words moved(const Words& words) const { return with_inputs_in_front(program, words); }
};

TEST(WordsBehindLists, InputsStandInFront) {
  const TwoVerbs t;
  const TemporaryFolder folder;
  const std::string images = folder.path().string();
  EXPECT_EQ(t.moved({"detect", "--templates", "t", images, "--out", "r"}),
            (Words{"detect", images, "--templates", "t", "--out", "r"}));
  EXPECT_EQ(t.moved({"detect", "--templates", "t", "u", "a.png", "b.mp4"}),
            (Words{"detect", "a.png", "b.mp4", "--templates", "t", "u"}));
  EXPECT_EQ(t.moved({"detect", "--templates=t", "a.png", "--out", "r"}),
            (Words{"detect", "a.png", "--templates=t", "--out", "r"}));
  EXPECT_EQ(
      t.moved({"detect", "--templates", "t", "a.png", "--out", "r", "--templates", "u", "b.png"}),
      (Words{"detect", "a.png", "b.png", "--templates", "t", "--out", "r", "--templates", "u"}));
}

TEST(WordsBehindLists, OtherWordsStayWhereTheyAre) {
  const TwoVerbs t;
  for (const Words& words :
       {Words{}, Words{"--log-level", "error"}, Words{"detect", "a.png", "--templates", "t"},
        Words{"detect", "--templates", "first.png", "--out", "r"},
        Words{"detect", "--templates", "t", "-1", "-.5", "--out", "r"},
        Words{"detect", "--templates"}, Words{"detect", "--out", "r", "a.png"},
        Words{"detect", "--", "--templates", "t", "a.png"},
        Words{"eval", "--templates", "t", "a.png"}})
    EXPECT_EQ(t.moved(words), words);
}

}  // namespace
}  // namespace edgescout::test
