#include "host/cli/batch_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "host/cli/batch_page_script.h"
#include "host/cli/page_parts.h"
#include "host/io/json_text.h"
#include "host/io/thumbnail.h"

namespace edgescout {

namespace {

constexpr std::size_t MOST_LISTED = 20'000;
constexpr int BINS = 20;

std::string thousands(std::size_t number) {
  std::string text = std::to_string(number);
  for (int at = static_cast<int>(text.size()) - 3; at > 0; at -= 3)
    text.insert(static_cast<std::size_t>(at), ",");
  return text;
}

std::size_t missing_images(const BatchSummary& summary) {
  std::size_t count = 0;
  for (const MissingPart& part : summary.missing) count += static_cast<std::size_t>(part.images);
  return count;
}

std::string tiles(const BatchTables& tables, const BatchSummary& summary) {
  std::string html = "<div class=tiles>" + tile(thousands(tables.images.size()), "images") +
                     tile(thousands(static_cast<std::size_t>(tables.done)), "with a result");
  html += tile(thousands(summary.failures.size()), "failed");
  if (tables.incomplete > 0)
    html += tile(thousands(std::size_t(tables.incomplete)), "cut short by --max-seconds");
  if (const std::size_t missing = missing_images(summary); missing > 0)
    html += tile(thousands(missing), "missing");
  html += tile(thousands(tables.rows.size()), "poses");
  double seconds = 0;
  for (const StageSeconds& stage : tables.stages) seconds += stage.seconds;
  if (tables.done > 0) html += tile(fmt::format("{:.2f} s", seconds / tables.done), "per image");
  return html + "</div>";
}

std::string warnings(const BatchSummary& summary) {
  std::string html;
  if (!summary.error.empty())
    html += "<p class=warning>Ended by an error: " + escaped_html(summary.error) + "</p>";
  for (const MissingPart& part : summary.missing)
    if (part.images != 1)
      html +=
          fmt::format("<p class=warning>Missing: {}, {} images: {}</p>", escaped_html(part.what),
                      thousands(static_cast<std::size_t>(part.images)), escaped_html(part.reason));
  return html;
}

std::array<std::size_t, BINS> bins_of(const BatchTables& tables) {
  std::array<std::size_t, BINS> bins{};
  for (const BopResult& row : tables.rows)
    ++bins[static_cast<std::size_t>(std::clamp(static_cast<int>(row.score * BINS), 0, BINS - 1))];
  return bins;
}

std::string histogram(const BatchTables& tables) {
  const std::array<std::size_t, BINS> bins = bins_of(tables);
  const std::size_t most = std::max<std::size_t>(1, *std::ranges::max_element(bins));
  constexpr double left = 12, width = 26, height = 250, foot = 280;
  std::string svg = "<svg class=histogram viewBox='0 0 544 306' role=img>";
  for (int b = 0; b < BINS; ++b) {
    const std::size_t count = bins[static_cast<std::size_t>(b)];
    const double bar = height * static_cast<double>(count) / static_cast<double>(most),
                 x = left + width * b;
    svg += fmt::format(
        "<g><title>{:.2f} to {:.2f}: {} poses</title><rect class=bar x={:.1f} y={:.1f} "
        "width={:.1f} height={:.1f} /></g>",
        b / double(BINS), (b + 1) / double(BINS), thousands(count), x + 1, foot - bar, width - 2,
        bar);
    if (count > 0)
      svg += fmt::format("<text class=count x={:.1f} y={:.1f}>{}</text>", x + width / 2,
                         foot - bar - 5,
                         count < 10000 ? std::to_string(count) : fmt::format("{}k", count / 1000));
  }
  svg += fmt::format("<path class=axis d='M{} {}h{}'/>", left, foot, width * BINS);
  for (int tick = 0; tick <= 10; tick += 2)
    svg += fmt::format("<text class=tick x={:.1f} y={}>{:.1f}</text>",
                       left + width * BINS * tick / 10.0, foot + 17, tick / 10.0);
  return svg + "</svg>";
}

std::string stage_table(const BatchTables& tables) {
  double longest = 1e-9;
  for (const StageSeconds& stage : tables.stages) longest = std::max(longest, stage.seconds);
  std::string html = "<table class=stages><tr><th>stage<th class=figure>ms per image<th>";
  for (const StageSeconds& stage : tables.stages)
    html += fmt::format(
        "<tr><td>{}<td class=figure>{:.1f}<td><span class=length style='width:{:.1f}%'></span>",
        escaped_html(stage.name), 1000 * stage.seconds / std::max(1, tables.done),
        100 * stage.seconds / longest);
  return html + "</table>";
}

// An image of the page's list.
struct Listed {
  const PageImage* image;
  std::filesystem::path overlay;  // empty: there is none
};

// Failed and missing images first, then the others, each as listed.
std::vector<Listed> listed(const std::vector<PageImage>& images,
                           const std::filesystem::path& folder) {
  std::vector<Listed> list;
  std::error_code unknown;
  for (const bool is_done : {false, true})
    for (const PageImage& image : images) {
      if ((image.state == PageImage::State::Done) != is_done || list.size() == MOST_LISTED)
        continue;
      Listed& entry = list.emplace_back(Listed{&image, {}});
      const std::filesystem::path overlay = folder / image.folder / (image.name + "_overlay.png");
      if (is_done && std::filesystem::is_regular_file(overlay, unknown)) entry.overlay = overlay;
    }
  return list;
}

// The images as the script reads them.
nlohmann::json images_as_json(const std::vector<Listed>& list) {
  nlohmann::json folders = nlohmann::json::array(), images = nlohmann::json::array();
  std::map<std::filesystem::path, std::size_t> numbers;
  for (const auto& [image, overlay] : list) {
    const auto [folder, is_new] = numbers.emplace(image->folder, numbers.size());
    if (is_new) folders.push_back(image->folder.generic_string());
    images.push_back({image->name, folder->second, static_cast<int>(image->state), image->poses,
                      std::round(1000 * image->best_probability) / 1000,
                      std::round(1000 * image->seconds) / 1000, image->message,
                      overlay.empty() ? 0 : 1});
  }
  return {{"folders", folders}, {"images", images}};
}

// "</script>" in a message would end the script, "<!--" with "<script" hide its end.
std::string in_script(const nlohmann::json& json) {
  std::string text;
  for (const char c : json_text(json, -1)) text += c == '<' ? "\\u003c" : std::string(1, c);
  return text;
}

std::string gallery_start(const BatchTables& tables, const std::vector<Listed>& list,
                          int thumbnails) {
  std::string html = "<section><h2>Images <small id=shown></small></h2>";
  if (tables.images.size() > MOST_LISTED)
    html += fmt::format(
        "<p class=warning>{} of {} images are listed here: those that failed or are missing, then "
        "the first others. The counts above are of all.</p>",
        thousands(MOST_LISTED), thousands(tables.images.size()));
  const auto overlays =
      std::ranges::count_if(list, [](const Listed& entry) { return !entry.overlay.empty(); });
  if (overlays > thumbnails)
    html += fmt::format(
        "<p class=warning>{} of {} pictures are in this page (--thumbnails). The others are the "
        "files NAME_overlay.png, shown while the page lies in its folder.</p>",
        thousands(static_cast<std::size_t>(thumbnails)),
        thousands(static_cast<std::size_t>(overlays)));
  return html + GALLERY_CONTROLS +
         "<div id=grid class=grid></div><div class=pager></div>"
         "<noscript><p class=warning>The pictures are shown by a script of this page, which the "
         "browser does not run. They are the files NAME_overlay.png.</p></noscript></section>"
         "<script type='application/json' id=data>" +
         in_script(images_as_json(list)) + "</script>";
}

// Each is text of its own, which the script makes a picture of when its image is shown.
void write_thumbnails(const std::vector<Listed>& list, int thumbnails,
                      const std::function<void(std::string_view)>& write) {
  for (std::size_t i = 0; i < list.size() && thumbnails > 0; ++i) {
    if (list[i].overlay.empty()) continue;
    --thumbnails;
    if (const std::optional<std::string> jpeg = thumbnail_in(list[i].overlay))
      write(fmt::format("<script type='text/plain' id=picture{}>{}</script>\n", i, base64(*jpeg)));
  }
}

}  // namespace

void write_batch_page(const BatchTables& tables, const BatchSummary& summary,
                      const std::string& device, const PagePictures& pictures,
                      const std::function<void(std::string_view)>& write) {
  write(html_page_start("edgescout " + escaped_html(summary.verb),
                        std::string("<style>") + GALLERY_STYLE + "</style>"));
  write(fmt::format("<header><h1>edgescout <em>{}</em></h1><p>{}</p></header>",
                    escaped_html(summary.verb), escaped_html(device)));
  write(tiles(tables, summary) + warnings(summary));
  write("<div class=row><section><h2>Probabilities of the poses</h2>" + histogram(tables) +
        "</section><section><h2>Time by stage</h2>" + stage_table(tables) + "</section></div>");
  const std::vector<Listed> list = listed(tables.images, pictures.folder);
  write(gallery_start(tables, list, pictures.thumbnails));
  write_thumbnails(list, pictures.thumbnails, write);
  write(std::string("<script>") + GALLERY_SCRIPT + "</script>");
  write(HTML_PAGE_END);
}

}  // namespace edgescout
