#include "host/cli/config.h"

#include <gtest/gtest.h>

#include <cmath>

#include "host/cli/help.h"
#include "host/cli/option_table.h"
#include "host/cli/renamed_options.h"
#include "kernels/error.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

struct Options {
  double lambda = 100;
  int bins = 60;
  float sigma = 1.5f;
  unsigned top = 10;
  bool fast = false;
  std::string mode = "one";
  std::vector<std::string> files;
};

// A program with two verbs of the same options.
struct Program {
  CLI::App app{"test"};
  Options first, second;

  Program() {
    app.require_subcommand(1);
    app.fallthrough();
    add_yaml_config(app);
    add_verb("first", first);
    add_verb("second", second);
  }
  void add_verb(const std::string& name, Options& options) {
    CLI::App* verb = app.add_subcommand(name);
    OptionTable(*verb, "Test")
        .bounded("lambda", options.lambda, 0.5, 1000.0, "weight")
        .bounded("bins", options.bins, 4, 180, "bins")
        .bounded("sigma", options.sigma, 0.0f, 10.0f, "blur")
        .bounded("top", options.top, 1u, 99u, "how many")
        .flag("fast", options.fast, "fast")
        .choice("mode", options.mode, {"one", "two"}, "mode");
    verb->add_option("files", options.files, "files");
  }
  void parse(std::vector<std::string> arguments) {
    std::reverse(arguments.begin(), arguments.end());  // what CLI11 asks for
    app.parse(arguments);
  }
  std::string parse_error(const std::vector<std::string>& arguments) {
    try {
      parse(arguments);
    } catch (const CLI::ParseError& error) {
      return error.what();
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
};

TEST(OptionTable, ListsTheSettingsOfAResultWhereverTheyComeFrom) {
  Program p;
  p.parse({"first", "--lambda", "50.0", "--fast"});
  CLI::App& verb = *p.app.get_subcommand("first");
  const std::vector<std::pair<std::string, std::string>> expected{
      {"verb", "first"}, {"lambda", "50"}, {"bins", "60"}, {"sigma", "1.5"},
      {"top", "10"},     {"fast", "true"}, {"mode", "one"}};
  EXPECT_EQ(settings_of(verb, {"Test"}), expected);
  p.first.fast = false;
  EXPECT_EQ(settings_of(verb, {"Test"})[5].second, "false");
  EXPECT_EQ(settings_of(verb, {"Another"}).size(), 1u);
}

TEST(OptionTable, FillsTheFieldsAndKeepsTheDefaults) {
  Program program;
  program.parse({"first", "--lambda", "6", "--top=3", "--fast", "--mode", "two", "a.png", "b.png"});
  EXPECT_EQ(program.first.lambda, 6);
  EXPECT_EQ(program.first.top, 3u);
  EXPECT_TRUE(program.first.fast);
  EXPECT_EQ(program.first.mode, "two");
  EXPECT_EQ(program.first.files, (std::vector<std::string>{"a.png", "b.png"}));
  EXPECT_EQ(program.first.bins, 60);
  EXPECT_EQ(program.first.sigma, 1.5f);
  EXPECT_EQ(program.second.lambda, 100);
}

TEST(OptionTable, BoundsAreInclusiveAndNamedWhenViolated) {
  for (const char* good : {"0.5", "1000", "1e2"})
    EXPECT_EQ(Program().parse_error({"first", "--lambda", good}), "") << good;
  for (const char* bad : {"0.49", "1000.1", "nan", "inf", "-5", "many"})
    EXPECT_EQ(Program()
                  .parse_error({"first", std::string("--lambda=") + bad})
                  .find("--lambda: found " + std::string(bad) + ", expected 0.5 to 1000"),
              0u)
        << bad << ": " << Program().parse_error({"first", std::string("--lambda=") + bad});
  for (const char* bad : {"3", "181", "60.5", "99999999999"})
    EXPECT_EQ(Program().parse_error({"first", "--bins", bad}),
              "--bins: found " + std::string(bad) + ", expected 4 to 180");
  EXPECT_EQ(Program().parse_error({"first", "--top=-1"}), "--top: found -1, expected 1 to 99");
  EXPECT_EQ(Program().parse_error({"first", "--mode", "three"}),
            "--mode: found three, expected one of one, two");
}

TEST(YamlConfig, UsesTheSameNamesAndBounds) {
  const TemporaryFolder folder;
  const std::string file = folder.write(
      "c.yaml",
      "lambda: 6\nfast: true\nfirst:\n  bins: 30\n  files: [a.png, b.png]\nsecond: {bins: 31}\n");
  Program program;
  program.parse({"first", "--config", file});
  EXPECT_EQ(program.first.lambda, 6);
  EXPECT_TRUE(program.first.fast);
  EXPECT_EQ(program.first.bins, 30);
  EXPECT_EQ(program.first.files, (std::vector<std::string>{"a.png", "b.png"}));
  EXPECT_EQ(program.second.bins, 60);
  Program other;
  other.parse({"--config", file, "second"});
  EXPECT_EQ(other.second.bins, 31);
  EXPECT_EQ(other.second.lambda, 6);
  const std::string bad = folder.write("bad.yaml", "bins: 3\n");
  EXPECT_EQ(Program().parse_error({"first", "--config", bad}),
            "--bins: found 3, expected 4 to 180");
}

TEST(YamlConfig, TurnsFlagsOnAndOff) {
  const TemporaryFolder folder;
  bool shadows = true, blur = true, noise = false;
  CLI::App app{"test"};
  app.fallthrough();
  add_yaml_config(app);
  OptionTable(*app.add_subcommand("verb"), "Test")
      .flag("shadows,!--no-shadows", shadows, "on at first")
      .flag("blur,!--no-blur", blur, "on at first")
      .flag("noise", noise, "off at first");
  app.parse("verb --config " +
            folder.write("c.yaml", "shadows: false\nno-blur: true\nnoise: on\n").string());
  EXPECT_FALSE(shadows);
  EXPECT_FALSE(blur);
  EXPECT_TRUE(noise);
}

TEST(YamlConfig, TheCommandLineWins) {
  const TemporaryFolder folder;
  const std::string file = folder.write("c.yaml", "lambda: 6\nbins: 30\n");
  Program program;
  program.parse({"first", "--lambda", "7", "--config", file});
  EXPECT_EQ(program.first.lambda, 7);
  EXPECT_EQ(program.first.bins, 30);
}

TEST(YamlConfig, NamesFileAndKeyOfWhatItDoesNotKnow) {
  const TemporaryFolder folder;
  const auto error_of = [&](const std::string& yaml) {
    return Program().parse_error({"first", "--config", folder.write("c.yaml", yaml)});
  };
  EXPECT_NE(error_of("lamda: 6\n").find("c.yaml: lamda: found an unknown option"),
            std::string::npos);
  EXPECT_NE(error_of("third: {lambda: 6}\n").find("c.yaml: third: found a section"),
            std::string::npos);
  EXPECT_NE(error_of("first: {second: {bins: 5}}\n").find("c.yaml: second"), std::string::npos);
  EXPECT_NE(error_of("first: {lamda: 6}\n").find("c.yaml: lamda"), std::string::npos);
  EXPECT_NE(error_of("lambda: 6: 7\n").find("c.yaml: line 1"), std::string::npos);
  EXPECT_NE(error_of("lambda: [6, [7]]\n").find("c.yaml: line 1"), std::string::npos);
  EXPECT_NE(error_of("6\n").find("c.yaml: configuration"), std::string::npos);
  EXPECT_EQ(error_of(""), "");
  EXPECT_EQ(error_of("# nothing\n"), "");
}

TEST(YamlConfig, WritesWhatItReads) {
  const TemporaryFolder folder;
  Program program;
  program.parse({"first", "--lambda", "6.25", "--fast", "--mode", "two"});
  const std::string yaml = program.app.config_to_str(true);
  Program again;
  again.parse({"first", "--config", folder.write("c.yaml", yaml)});
  EXPECT_EQ(again.first.lambda, 6.25) << yaml;
  EXPECT_TRUE(again.first.fast) << yaml;
  EXPECT_EQ(again.first.mode, "two") << yaml;
  EXPECT_EQ(again.first.bins, 60) << yaml;
  EXPECT_EQ(again.app.config_to_str(true), yaml);
  EXPECT_EQ(program.app.config_to_str(false).find("bins"), std::string::npos);
}

enum class Mode { One, Two };
struct Described {
  double lambda = 100;
  bool on = true, off = false, inverse = true;
  Mode mode = Mode::One;
  Range width_px{2, 3};
};
constexpr const char* MODES[] = {"one", "two"};

void describe(Described& o, OptionVisitor& visit) {
  visit.group("Test");
  visit.number({"the-lambda", "weight"}, o.lambda, 0.5, 1000.0);
  visit.flag({"on", "on at first"}, o.on);
  visit.flag({"off", "off at first"}, o.off);
  visit.off_flag({"not-inverse", "switches off"}, o.inverse);
  visit.choice({"mode", "mode", OptionLevel::Basic}, o.mode, MODES);
  visit.range({"width", "range"}, o.width_px, 0, 9);
}

struct DescribedProgram {
  CLI::App app{"test"};
  CLI::App* verb = nullptr;
  Described options;

  DescribedProgram() {
    app.fallthrough();
    add_help(app);
    add_yaml_config(app);
    verb = app.add_subcommand("verb");
    CommandLineOptions add(*verb);
    describe(options, add);
  }
};

std::string error_of(const std::string& line) {
  try {
    DescribedProgram().app.parse(line);
  } catch (const CLI::ParseError& error) {
    return error.what();
  }
  return "";
}

TEST(CommandLineOptions, FillTheDescribedFields) {
  DescribedProgram p;
  p.app.parse("verb --the-lambda 6 --no-on --off --not-inverse --mode two --width 1 4.5");
  EXPECT_EQ(p.options.lambda, 6);
  EXPECT_FALSE(p.options.on);
  EXPECT_TRUE(p.options.off);
  EXPECT_FALSE(p.options.inverse);
  EXPECT_EQ(p.options.mode, Mode::Two);
  EXPECT_EQ(p.options.width_px.low, 1);
  EXPECT_EQ(p.options.width_px.high, 4.5);
  const std::vector<std::pair<std::string, std::string>> expected{
      {"verb", "verb"},        {"the-lambda", "6"}, {"on", "false"},      {"off", "true"},
      {"not-inverse", "true"}, {"mode", "two"},     {"width", "[1, 4.5]"}};
  EXPECT_EQ(settings_of(*p.verb, {"Test"}), expected);
}

TEST(CommandLineOptions, TakeTheSameNamesFromYaml) {
  const TemporaryFolder folder;
  DescribedProgram p;
  p.app.parse(
      "verb --config " +
      folder.write("c.yaml", "on: false\nnot-inverse: true\nmode: two\nwidth: [1, 4]\n").string());
  EXPECT_FALSE(p.options.on);
  EXPECT_FALSE(p.options.inverse);
  EXPECT_EQ(p.options.mode, Mode::Two);
  EXPECT_EQ(p.options.width_px.low, 1);
  EXPECT_EQ(p.options.width_px.high, 4);
  DescribedProgram off;
  off.app.parse("verb --config " + folder.write("d.yaml", "not-inverse: false\n").string());
  EXPECT_TRUE(off.options.inverse);
}

TEST(CommandLineOptions, KeepDefaultsAndNameBounds) {
  DescribedProgram p;
  p.app.parse("verb");
  EXPECT_EQ(p.options.lambda, 100);
  EXPECT_TRUE(p.options.inverse);
  EXPECT_EQ(p.options.mode, Mode::One);
  EXPECT_EQ(error_of("verb --the-lambda 0.4"), "--the-lambda: found 0.4, expected 0.5 to 1000");
  EXPECT_EQ(error_of("verb --mode three"), "--mode: found three, expected one of one, two");
}

TEST(CommandLineOptions, ASingleNumberIsBothEndsOfARange) {
  DescribedProgram p;
  p.app.parse("verb --width 4");
  EXPECT_EQ(p.options.width_px.low, 4);
  EXPECT_EQ(p.options.width_px.high, 4);
}

TEST(CommandLineOptions, RefuseARangeByName) {
  EXPECT_EQ(error_of("verb --width 5 3"), "--width: found 5 before 3, expected MIN MAX");
  EXPECT_EQ(error_of("verb --width 5 12"), "--width: found 12, expected 0 to 9");
  EXPECT_EQ(error_of("verb --width 5 wide"), "--width: found wide, expected 0 to 9");
  EXPECT_NE(error_of("verb --width 5 6 7").find("--width"), std::string::npos);
}

TEST(BoundsCheck, NamesTheOptionWithUnderscores) {
  Described options;
  EXPECT_NO_THROW(check_bounds(options, "test"));
  options.lambda = std::nan("");
  try {
    check_bounds(options, "test");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find("options: test.the_lambda: found nan, expected 0.5"),
              0u)
        << error.what();
  }
}

TEST(Help, ShowsExpertOptionsOnlyWhenAllAreAskedFor) {
  const DescribedProgram p;
  const std::string basic = p.verb->help(), all = p.verb->help("", CLI::AppFormatMode::All);
  EXPECT_NE(basic.find("--mode"), std::string::npos) << basic;
  EXPECT_EQ(basic.find("--the-lambda"), std::string::npos) << basic;
  EXPECT_TRUE(basic.ends_with("--help-all shows 5 more options\n")) << basic;
  for (const char* name : {"--mode", "--the-lambda", "--not-inverse", "--on,--no-on"})
    EXPECT_NE(all.find(name), std::string::npos) << name << " not in " << all;
}

TEST(RenamedOptions, AreReplacedOnTheCommandLine) {
  const std::vector<std::string> given{"detect", "--aligned=5", "--helping-views",
                                       "3",      "--",          "--aligned"},
      expected{"detect", "--coarse-poses=5", "--support-views", "3", "--", "--aligned"};
  EXPECT_EQ(with_present_names(given), expected);
  EXPECT_EQ(with_present_names({"bench", "experiments", "--literal"}).back(), "--paper-formula");
  EXPECT_THROW(with_present_names({"scout", "cell", "--literal"}), InputError);
}

}  // namespace
}  // namespace edgescout::test
