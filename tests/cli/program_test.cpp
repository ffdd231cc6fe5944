// The program as a user calls it: exit codes, one-line errors, nothing written.
#include "tests/cli/program.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/io/sample_meshes.h"

namespace edgescout::test {
namespace {

void expect_bad_request(const std::vector<std::string>& arguments,
                        std::initializer_list<std::string> words,
                        const std::string& environment = "") {
  const Outcome outcome = run_program(arguments, environment);
  EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_TRUE(is_one_line_error(outcome.err)) << outcome.err;
  for (const std::string& word : words)
    EXPECT_NE(outcome.err.find(word), std::string::npos) << word << " not in " << outcome.err;
}

TEST(Program, ExplainsItself) {
  const Outcome help = run_program({"--help"}), version = run_program({"--version"});
  EXPECT_EQ(help.exit_code, 0);
  for (const char* word : {"devices", "model", "--config", "--log-level"})
    EXPECT_NE(help.out.find(word), std::string::npos) << word;
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_TRUE(version.out.starts_with("edgescout "));
  EXPECT_EQ(run_program({"model", "inspect", "--help"}).exit_code, 0);
}

// What stands behind the names of the options; CLI11 begins it in this column.
std::vector<std::string> descriptions(const std::string& help) {
  constexpr std::size_t column = 30;
  std::vector<std::string> texts;
  std::istringstream lines(help);
  for (std::string line; std::getline(lines, line);)
    if (line.size() > column && line[column - 1] == ' ' && line[column] != ' ')
      texts.push_back(line.substr(column));
  return texts;
}

const std::vector<std::vector<std::string>>& all_verbs() {
  static const std::vector<std::vector<std::string>> verbs{{"bench", "devices"},
                                                           {"bench", "experiments"},
                                                           {"camera"},
                                                           {"detect"},
                                                           {"devices"},
                                                           {"eval"},
                                                           {"explain"},
                                                           {"model", "build"},
                                                           {"model", "draw"},
                                                           {"model", "inspect"},
                                                           {"register"},
                                                           {"render"},
                                                           {"scout"}};
  return verbs;
}

std::string help_of(std::vector<std::string> verb, const char* which) {
  verb.push_back(which);
  const Outcome outcome = run_program(verb);
  EXPECT_EQ(outcome.exit_code, 0) << verb.front() << ": " << outcome.err;
  return outcome.out;
}

// A reader comes to one option, not to the one above it.
TEST(Program, ExplainsEveryOptionByItself) {
  for (const std::vector<std::string>& verb : all_verbs())
    for (const std::string& text : descriptions(help_of(verb, "--help-all"))) {
      for (const char* fragment : {"Of ", "And ", "On it", "As ", "By which", "The same", "m;"})
        EXPECT_FALSE(text.starts_with(fragment)) << verb.back() << ": " << text;
      EXPECT_TRUE(text != "m" && text != "degrees") << verb.back();
    }
}

// The lines of options: "  --name ...". A long name has its text in the next line.
TEST(Program, ExplainsEveryOption) {
  for (const std::vector<std::string>& verb : all_verbs()) {
    std::istringstream help(help_of(verb, "--help-all"));
    std::string line;
    while (std::getline(help, line)) {
      if (!line.starts_with("  -")) continue;
      const std::size_t text = line.find("  ", 4);
      const bool here =
          text != std::string::npos && line.find_first_not_of(' ', text) != std::string::npos;
      if (here || (line.size() > 30 && line[29] == ' ')) continue;
      std::string next;
      std::getline(help, next);
      EXPECT_TRUE(next.starts_with(std::string(30, ' '))) << verb.back() << ": " << line;
    }
  }
}

TEST(Program, ShowsNoNotationOfTheParserInItsHelp) {
  for (const std::vector<std::string>& verb : all_verbs()) {
    const std::string help = help_of(verb, "--help-all");
    for (const char* notation : {"{false}", "{true}", "=[]"})
      EXPECT_EQ(help.find(notation), std::string::npos) << verb.back() << ": " << notation;
  }
  EXPECT_NE(help_of({"detect"}, "--help-all").find("--faint-edges,--no-faint-edges\n"),
            std::string::npos);
}

TEST(Program, ListsExpertOptionsOnlyInHelpAll) {
  const auto expect_expert = [](const std::vector<std::string>& verb, const std::string& option) {
    const std::string basic = help_of(verb, "--help"), all = help_of(verb, "--help-all");
    EXPECT_EQ(basic.find(option), std::string::npos) << option << " in " << basic;
    EXPECT_NE(all.find(option), std::string::npos) << option << " not in " << all;
    EXPECT_NE(basic.find("--help-all shows "), std::string::npos) << basic;
    EXPECT_EQ(all.find("--help-all shows "), std::string::npos) << all;
  };
  expect_expert({"detect"}, "--coarse-poses");
  expect_expert({"register"}, "--solver");
  expect_expert({"scout"}, "--particles");
  expect_expert({"bench", "experiments"}, "--paper-formula");
  expect_expert({"model", "build"}, "--crease-angle");
  const std::string detect = help_of({"detect"}, "--help"), scout = help_of({"scout"}, "--help");
  for (const char* option :
       {"--model", "--unit", "--camera", "--out", "--device", "--joint", "--distance-min",
        "--region-x", "--min-probability", "--resume", "--max-detections", "--no-overlays"})
    EXPECT_NE(detect.find(option), std::string::npos) << option << " not in " << detect;
  for (const char* option : {"--max-views", "--strategy", "--max-seconds", "--resume"})
    EXPECT_NE(scout.find(option), std::string::npos) << option << " not in " << scout;
  for (const char* option : {"--paper-formula", "--sharpness", "--search-alone"})
    EXPECT_EQ(help_of({"scout"}, "--help-all").find(option), std::string::npos) << option;
}

TEST(Program, WarnsOfRenamedOptions) {
  const TemporaryFolder folder;
  // The file of models is missing: the run ends after its options are read.
  const std::vector<std::string> detect{"detect",  folder.path(), "--out",  folder.path() / "out",
                                        "--model", "none.ply",    "--unit", "mm"};
  const auto expect_warned = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = detect;
    arguments.insert(arguments.end(), more.begin(), more.end());
    const std::string err = run_program(arguments).err;
    EXPECT_NE(err.find("warning: --aligned is now --coarse-poses"), std::string::npos) << err;
    // The bound is that of the new option.
    EXPECT_NE(err.find("--coarse-poses: found 0, expected 1 to 1000000"), std::string::npos) << err;
  };
  expect_warned({"--aligned", "0"});
  expect_warned({"--aligned=0"});
  expect_warned({"--config", folder.write("a.yaml", "aligned: 0\n")});
  expect_warned({"--config", folder.write("b.yaml", "detect: {aligned: 0}\n")});
  for (const std::vector<std::string>& verb : all_verbs())
    EXPECT_EQ(help_of(verb, "--help-all").find("--aligned"), std::string::npos) << verb.back();
}

TEST(Program, SendsAblationsToTheExperiments) {
  const TemporaryFolder folder;
  for (const char* verb : {"scout", "detect"}) {
    expect_bad_request({verb, "cell", "--literal"},
                       {"--literal is now --paper-formula of edgescout bench experiments"});
    expect_bad_request({verb, "cell", "--free-sight=1"}, {"--free-sight is now"});
    expect_bad_request({verb, "cell", "--sharpness", "2"},
                       {"--sharpness is an option of edgescout bench experiments"});
  }
  expect_bad_request({"scout", "cell", "--out", folder.path() / "out", "--config",
                      folder.write("a.yaml", "literal: true\n")},
                     {"a.yaml", "--literal is now --paper-formula of edgescout bench"});
  const Outcome bench = run_program(
      {"bench", "experiments", "--out", folder.path() / "out", "--literal", "--sharpness", "501"});
  EXPECT_EQ(bench.exit_code, 2);
  EXPECT_NE(bench.err.find("--literal is now --paper-formula"), std::string::npos) << bench.err;
  EXPECT_NE(bench.err.find("--sharpness: found 501, expected 0 to 500"), std::string::npos);
}

TEST(Program, RejectsACommandLineItDoesNotUnderstand) {
  expect_bad_request({}, {"subcommand"});
  expect_bad_request({"detekt"}, {"detekt", "devices", "model"});
  expect_bad_request({"devices", "--jsn"},
                     {"command line: found --jsn, expected what edgescout devices --help-all"});
  expect_bad_request({"detect"}, {"inputs: found nothing, expected a value (edgescout detect"});
  expect_bad_request({"devices", "--log-level", "loud"}, {"--log-level", "loud"});
  expect_bad_request({"model"}, {"found no subcommand, expected one of:", "inspect"});
  expect_bad_request({"model", "inspekt"}, {"found inspekt, expected one of:", "inspect"});
}

TEST(Program, KeepsWarningsToOneLine) {
  const TemporaryFolder folder;
  const Outcome outcome =
      run_program({"camera", folder.write("a\nb.yaml",
                                          "image_width: 640\nimage_height: 480\n"
                                          "K: [700, 0, 319.5, 0, 1400, 239.5, 0, 0, 1]\n")});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("a b.yaml: "), std::string::npos) << outcome.err;
}

TEST(Devices, ListsThemAsTextAndJson) {
  const Outcome text = run_program({"devices"});
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_NE(text.out.find("auto takes: "), std::string::npos) << text.out;
  const Outcome json = run_program({"devices", "--json"});
  const auto list = nlohmann::json::parse(json.out);
  for (const auto& device : list.at("devices")) {
    EXPECT_TRUE(device.at("choice").get<std::string>().starts_with("vulkan:"));
    EXPECT_GT(device.at("memory_bytes").get<std::uint64_t>(), 0u);
    EXPECT_NE(text.out.find(device.at("name").get<std::string>()), std::string::npos);
  }
  EXPECT_EQ(
      nlohmann::json::parse(run_program({"devices", "--json", "--device", "cpu"}).out).at("taken"),
      "cpu");
}

TEST(Devices, RejectsADeviceThatIsNotThere) {
  // The Vulkan loader finds no driver then.
  const std::string without_drivers = "VK_DRIVER_FILES=/nonexistent VK_ICD_FILENAMES=/nonexistent";
  const Outcome list = run_program({"devices"}, without_drivers);
  EXPECT_EQ(list.exit_code, 0) << list.err;
  EXPECT_NE(list.out.find("no Vulkan device"), std::string::npos) << list.out;
  EXPECT_NE(list.out.find("auto takes: cpu\n"), std::string::npos) << list.out;
  expect_bad_request({"devices", "--device", "vulkan"}, {"device", "vulkan"}, without_drivers);
  expect_bad_request({"devices", "--device", "vulkan:0"}, {"device", "vulkan:0"}, without_drivers);
  expect_bad_request({"devices", "--device", "vulkan:99"}, {"device", "vulkan:99"});
  expect_bad_request({"devices", "--device", "cuda"}, {"device", "cuda", "cpu"});
}

TEST(Devices, ReportsAFullStandardOutput) {
  const TemporaryFolder folder;
  const auto err = folder.path() / "err";
  const std::string command = "'" EDGESCOUT_CLI "' devices >/dev/full 2>'" + err.string() + "'";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 2);
  EXPECT_TRUE(is_one_line_error(content_of(err))) << content_of(err);
}

TEST(ModelInspect, MeasuresABox) {
  const TemporaryFolder folder;
  const std::string file = folder.write("box.stl", binary_stl(box(30, 40, 120)));
  const Outcome text = run_program({"model", "inspect", file, "--unit", "mm"});
  EXPECT_EQ(text.exit_code, 0) << text.err;
  for (const char* word :
       {"30.000 x 40.000 x 120.000 mm", "130.000 mm", "12", "18", "0 on open borders"})
    EXPECT_NE(text.out.find(word), std::string::npos) << word << " not in " << text.out;
  const auto list =
      nlohmann::json::parse(run_program({"model", "inspect", file, "--unit", "cm", "--json"}).out);
  EXPECT_NEAR(list.at(0).at("diameter_mm").get<double>(), 1300, 1e-3);
  EXPECT_EQ(list.at(0).at("vertices"), 8);
  EXPECT_EQ(list.at(0).at("edges"), 18);
  EXPECT_EQ(list.at(0).at("open_border_edges"), 0);
  EXPECT_EQ(list.at(0).at("drawn_open_border_share"), 0);
  EXPECT_EQ(list.at(0).at("inconsistent_edges"), 0);
  EXPECT_NEAR(list.at(0).at("drawn_length_mm").get<double>(), 40 * (30 + 40 + 120), 1e-2);
  EXPECT_EQ(list.at(0).at("warning"), "");
}

TEST(ModelInspect, TakesFileNamesThatAreNoUtf8) {
  const TemporaryFolder folder;
  const std::string file = folder.write("caf\xe9.stl", binary_stl(box(30, 40, 120)));
  const Outcome outcome = run_program({"model", "inspect", file, "--unit", "mm", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string name = nlohmann::json::parse(outcome.out).at(0).at("file");
  EXPECT_TRUE(name.ends_with("caf\xef\xbf\xbd.stl")) << name;
}

TEST(ModelInspect, CountsOpenBordersAndWarnsOfTheUnit) {
  const TemporaryFolder folder;
  Triangles open = box(30, 40, 120);
  open.triangles.resize(10);  // one side is missing
  const std::string file = folder.write("open.ply", ascii_ply(open));
  const Outcome outcome = run_program({"model", "inspect", file, "--unit", "m", "--json"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(nlohmann::json::parse(outcome.out).at(0).at("open_border_edges"), 4);
  EXPECT_NE(outcome.err.find("edgescout: warning: "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("is the unit right (--unit)?"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("of the drawn edge length is open border"), std::string::npos)
      << outcome.err;
  EXPECT_EQ(run_program({"model", "inspect", file, "--unit", "m", "--log-level", "error"}).err, "");
}

TEST(ModelInspect, RejectsBadMeshesAndAMissingUnit) {
  const TemporaryFolder folder;
  const Triangles b = box(30, 40, 120);
  Triangles bad = b;
  bad.vertices[3].x() = std::numeric_limits<double>::quiet_NaN();
  const std::string good = folder.write("good.stl", binary_stl(b));
  const auto inspect = [](const std::string& file) {
    return std::vector<std::string>{"model", "inspect", file, "--unit", "mm"};
  };
  expect_bad_request({"model", "inspect", good}, {"--unit"});
  expect_bad_request({"model", "inspect", good, "--unit", "foot"},
                     {"unit", "foot", "mm, cm, m or in"});
  expect_bad_request({"model", "inspect", "--unit", "mm"}, {"files"});
  expect_bad_request(inspect(folder.path() / "none.stl"), {"none.stl", "No such file"});
  expect_bad_request(inspect(folder.write("cut.stl", binary_stl(b).substr(0, 500))),
                     {"cut.stl", "truncated"});
  expect_bad_request(inspect(folder.write("lie.stl", binary_stl(b, 11))), {"lie.stl", "count"});
  expect_bad_request(inspect(folder.write("zero.stl", binary_stl({}))), {"zero.stl", "triangles"});
  expect_bad_request(inspect(folder.write("nan.stl", binary_stl(bad))),
                     {"nan.stl", "vertex", "not finite"});
  Triangles slivers;
  for (const double z : {0.0, 20.0, 40.0}) {
    const int first = int(slivers.vertices.size());
    slivers.vertices.insert(slivers.vertices.end(), {{0, 0, z}, {50, 1e-4, z}, {100, 0, z}});
    slivers.triangles.push_back({first, first + 1, first + 2});
  }
  expect_bad_request(inspect(folder.write("slivers.stl", binary_stl(slivers))),
                     {"slivers.stl: triangles", "slivers"});
  // A good file before a bad one is not half reported.
  expect_bad_request({"model", "inspect", good, folder.path() / "none.stl", "--unit", "mm"},
                     {"none.stl"});
}

TEST(Config, GivesAVerbItsOptions) {
  const TemporaryFolder folder;
  const std::string mesh = folder.write("box.stl", binary_stl(box(30, 40, 120)));
  const std::string own = folder.write(
      "own.yaml", "model:\n  inspect: {unit: mm, json: true}\ndevices: {json: true}\n");
  const Outcome outcome = run_program({"model", "inspect", mesh, "--config", own});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NEAR(nlohmann::json::parse(outcome.out).at(0).at("diameter_mm").get<double>(), 130, 1e-3);
  const Outcome wins = run_program({"--config", own, "model", "inspect", mesh, "--unit", "cm"});
  EXPECT_NEAR(nlohmann::json::parse(wins.out).at(0).at("diameter_mm").get<double>(), 1300, 1e-3);
}

TEST(Config, NamesFileAndKeyOfWhatIsWrong) {
  const TemporaryFolder folder;
  expect_bad_request({"devices", "--config", folder.path() / "none.yaml"}, {"none.yaml"});
  expect_bad_request({"devices", "--config", folder.write("a.yaml", "jsn: true\n")},
                     {"a.yaml", "jsn", "unknown option"});
  expect_bad_request({"devices", "--config", folder.write("b.yaml", "json: [true\n")},
                     {"b.yaml", "line"});
  expect_bad_request({"devices", "--config", folder.write("c.yaml", "verb: {json: true}\n")},
                     {"c.yaml", "verb"});
  expect_bad_request({"devices", "--config", folder.write("d.yaml", "- json\n")},
                     {"d.yaml", "no keys"});
  expect_bad_request({"devices", "--config", folder.write("e.yaml", "log-level: loud\n")},
                     {"log-level", "loud"});
}

}  // namespace
}  // namespace edgescout::test
