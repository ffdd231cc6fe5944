// edgescout scout on little: what its tests call.
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "tests/cli/small_scene.h"

namespace edgescout::test {

struct SmallScout {
  TemporaryFolder folder;
  fs::path out = folder.path() / "out";
  std::string min_probability = "0.1", device = "cpu", max_views = "2";

  // A bracket in a rendered cell, seen from some of eight views, few of everything.
  std::vector<std::string> arguments(const std::vector<std::string>& more = {}) const {
    return joined({{"scout", "cell", "--out", out, "--device", device, "--model", part_file(1),
                    "--unit", "mm"},
                   {"--width", "320", "--height", "240", "--focal", "400", "--objects", "1",
                    "--clutter", "0"},
                   {"--radius", "0.3", "--view-count", "8", "--elevations", "40", "70",
                    "--max-views", max_views, "--min-entropy", "0"},
                   {"--viewpoints", "3", "--in-plane-steps", "12", "--coarse-poses", "200",
                    "--candidates", "8", "--particles", "60"},
                   {"--combinations", "200", "--min-probability", min_probability},
                   more});
  }
  nlohmann::json log() const { return nlohmann::json::parse(content_of(out / "scout.json")); }
  std::string page() const { return content_of(out / "scout.html"); }
};

inline std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
    ++count;
  return count;
}

// Pictures are in it, everything else it names too.
inline void expect_self_contained(const std::string& page) {
  for (const char* word : {"http:", "https:", "<script", "<link", "@import", "url("})
    EXPECT_EQ(page.find(word), std::string::npos) << word;
  const std::regex reference("(src|href)='([^']{0,12})");
  int references = 0;
  for (std::sregex_iterator it(page.begin(), page.end(), reference), end; it != end;
       ++it, ++references) {
    const std::string target = (*it)[2];
    EXPECT_TRUE(target.starts_with("data:image/p") || target == "#first") << target;
  }
  EXPECT_GE(references, 5);
  EXPECT_EQ(count_of(page, "src="), count_of(page, "src='data:image/png;base64,iVBORw0KGgo"));
  EXPECT_NE(page.find("id=first"), std::string::npos);
}

}  // namespace edgescout::test
