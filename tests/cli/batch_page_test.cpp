// report.html: what failed comes first, text cannot break the page, long lists are cut openly, and
// the pictures are in it.
#include "host/cli/batch_page.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "host/cli/page_parts.h"
#include "host/io/thumbnail.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

InputImage input_named(const std::string& name) {
  InputImage input;
  input.file = "/images/" + name + ".png";
  input.name = name;
  return input;
}

ImageResult result_with(const std::vector<double>& probabilities) {
  ImageResult result;
  result.device = "cpu";
  result.objects = {{1, "part"}};
  result.stages = {{"scan", 0.5}, {"fine", 0.25}};
  for (const double probability : probabilities) {
    Detection& found = result.detections.emplace_back();
    found.object = 0;
    found.probability = probability;
  }
  return result;
}

std::string batch_page(const BatchTables& tables, const BatchSummary& summary,
                       const std::string& device, const PagePictures& pictures = {}) {
  std::string page;
  write_batch_page(tables, summary, device, pictures, [&](std::string_view part) { page += part; });
  return page;
}

// What the script of the page reads.
nlohmann::json data_of(const std::string& page) {
  const std::string before = "id=data>";
  const std::size_t start = page.find(before) + before.size();
  return nlohmann::json::parse(page.substr(start, page.find("</script>", start) - start));
}

TEST(BatchPage, ListsWhatFailedFirst) {
  BatchTables tables(false);
  tables.add(input_named("a"), result_with({0.9, 0.31}));
  tables.add_failed(input_named("b"), "no image");
  tables.add(input_named("c"), result_with({}), "../shard 2");
  tables.add_missing(input_named("d"), "not done");
  BatchSummary summary;
  summary.verb = "detect";
  summary.failures["/images/b.png"] = "no image";
  const std::string page = batch_page(tables, summary, "cpu");
  const nlohmann::json data = data_of(page);
  std::string order;
  for (const auto& image : data.at("images")) order += image.at(0).get<std::string>();
  EXPECT_EQ(order, "bdac");
  EXPECT_EQ(data.at("images").at(0).at(6), "no image");
  EXPECT_EQ(data.at("images").at(2).at(3), 2) << "poses";
  EXPECT_EQ(data.at("images").at(2).at(4), 0.9) << "the best";
  EXPECT_EQ(data.at("folders").at(data.at("images").at(3).at(1).get<std::size_t>()), "../shard 2");
  EXPECT_NE(page.find("0.30 to 0.35: 1 poses"), std::string::npos);
  EXPECT_NE(page.find("0.95 to 1.00: 0 poses"), std::string::npos);
  EXPECT_NE(page.find("<td>scan<td class=figure>500.0"), std::string::npos) << "mean of two images";
  EXPECT_NE(page.find("<th class=figure>ms per image<th>"), std::string::npos);
  EXPECT_NE(page.find(">per image<"), std::string::npos);
  EXPECT_EQ(page.find("cut short"), std::string::npos);
}

TEST(BatchPage, CountsWhatWasCutShort) {
  BatchTables tables(false);
  ImageResult cut = result_with({});
  cut.incomplete = "deadline passed";
  tables.add(input_named("a"), cut);
  EXPECT_NE(batch_page(tables, {}, "cpu").find("cut short"), std::string::npos);
}

TEST(BatchPage, TextCannotBreakIt) {
  BatchTables tables(false);
  const std::string bad = "</script><script>alert(1)</script>\"'&\xff";
  tables.add_failed(input_named(bad), bad);
  BatchSummary summary;
  summary.verb = "detect";
  summary.error = "<b>";
  const std::string page = batch_page(tables, summary, "vulkan:0 <i>");
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
  EXPECT_EQ(page.find("<b>Ended"), std::string::npos);
  EXPECT_NE(page.find("Ended by an error: &lt;b&gt;"), std::string::npos);
  EXPECT_NE(page.find("vulkan:0 &lt;i&gt;"), std::string::npos);
  EXPECT_EQ(data_of(page).at("images").at(0).at(0),
            "</script><script>alert(1)</script>\"'&\xef\xbf\xbd");
  for (const char* network : {"http:", "https:", "src='//", "@import"})
    EXPECT_EQ(page.find(network), std::string::npos) << network;
}

std::string picture(std::size_t number, const std::filesystem::path& overlay) {
  return "<script type='text/plain' id=picture" + std::to_string(number) + ">" +
         base64(thumbnail_in(overlay).value()) + "</script>";
}

TEST(BatchPage, HoldsThePicturesOfItsImages) {
  const TemporaryFolder folder;
  BatchTables tables(false);
  const auto overlay = [&](const std::string& name, std::uint8_t grey) {
    const std::filesystem::path file = folder.path() / (name + "_overlay.png");
    std::filesystem::create_directories(file.parent_path());
    save_png_with_thumbnail({32, 24, std::vector<std::uint8_t>(32 * 24 * 3, grey)}, file);
    return file;
  };
  const std::filesystem::path a = overlay("out/a", 10), b = overlay("shard 2/b", 200);
  tables.add(input_named("a"), result_with({0.9}));
  tables.add(input_named("none"), result_with({0.9}));
  tables.add(input_named("b"), result_with({0.9}), "../shard 2");
  tables.add_failed(input_named("bad"), "no image");
  const std::string page = batch_page(tables, {}, "cpu", {folder.path() / "out", 2});
  EXPECT_NE(page.find(picture(1, a)), std::string::npos) << "number 0 failed";
  EXPECT_NE(page.find(picture(3, b)), std::string::npos);
  EXPECT_EQ(page.find("id=picture2"), std::string::npos);
  EXPECT_EQ(page.find("--thumbnails"), std::string::npos) << "all pictures are there";
  std::string overlays;
  const nlohmann::json data = data_of(page);
  for (const auto& image : data.at("images")) overlays += image.at(7).dump();
  EXPECT_EQ(overlays, "0101");

  const std::string cut = batch_page(tables, {}, "cpu", {folder.path() / "out", 1});
  EXPECT_NE(cut.find("id=picture1"), std::string::npos);
  EXPECT_EQ(cut.find("id=picture3"), std::string::npos);
  EXPECT_NE(cut.find("1 of 2 pictures are in this page (--thumbnails)"), std::string::npos);
  EXPECT_EQ(batch_page(tables, {}, "cpu", {folder.path() / "out", 0}).find("id=picture"),
            std::string::npos);
}

TEST(BatchPage, SaysWhereItListsNotAll) {
  BatchTables tables(false);
  for (int i = 0; i < 20'001; ++i) tables.add(input_named(std::to_string(i)), result_with({0.5}));
  tables.add_failed(input_named("bad"), "no image");
  BatchSummary summary;
  summary.verb = "detect";
  const std::string page = batch_page(tables, summary, "cpu");
  EXPECT_EQ(data_of(page).at("images").size(), 20'000u);
  EXPECT_EQ(data_of(page).at("images").at(0).at(0), "bad");
  EXPECT_NE(page.find("20,000 of 20,002 images are listed here"), std::string::npos);
  EXPECT_LT(page.size(), 2'000'000u);
}

}  // namespace
}  // namespace edgescout::test
