#include "host/render/board.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <opencv2/imgproc.hpp>

#include "host/render/photographs.h"

namespace edgescout {
namespace {

// Draws shapes at random places. Every shape takes its numbers from `random` in a fixed order.
class Printer {
 public:
  Printer(cv::Mat& board, double smallest_px, double largest_px, Random& random)
      : board_(board), smallest_(smallest_px), largest_(largest_px), random_(random) {}

  void draw_one() {
    switch (random_.below(9)) {
      case 0:
        return ellipse(cv::FILLED);
      case 1:
        return ellipse(stroke());
      case 2:
        return polygon(true);
      case 3:
        return polygon(false);
      case 4:
      case 5:
        return word();
      case 6:
        return checkers();
      case 7:
        return bars();
      default:
        return line();
    }
  }

 private:
  // Sizes spread evenly over the octaves.
  double size() { return smallest_ * std::pow(largest_ / smallest_, random_.uniform()); }
  int stroke() { return 1 + static_cast<int>(smallest_ * random_.uniform(0.02, 0.25)); }
  cv::Point place() { return {random_.below(board_.cols), random_.below(board_.rows)}; }
  cv::Scalar ink() { return cv::Scalar::all(255 * std::pow(random_.uniform(0.12, 0.95), 2)); }

  void ellipse(int thickness) {
    const cv::Point centre = place();
    const double a = 0.5 * size(), b = a * random_.uniform(0.3, 1.0),
                 angle = random_.uniform(0, 180);
    cv::ellipse(board_, centre, {static_cast<int>(a), static_cast<int>(b)}, angle, 0, 360, ink(),
                thickness, cv::LINE_AA);
  }

  void polygon(bool filled) {
    const cv::Point centre = place();
    const double radius = 0.5 * size(), turn = random_.uniform(0, 2 * std::numbers::pi);
    const double squeeze = random_.uniform(0.25, 1.0);
    const int corners = random_.below(3) == 0 ? 3 + random_.below(4) : 4;
    std::vector<cv::Point> points;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * std::numbers::pi * (i + 0.5) / corners;
      const double x = radius * std::cos(angle), y = squeeze * radius * std::sin(angle);
      points.emplace_back(static_cast<int>(centre.x + x * std::cos(turn) - y * std::sin(turn)),
                          static_cast<int>(centre.y + x * std::sin(turn) + y * std::cos(turn)));
    }
    const cv::Scalar colour = ink();
    if (filled)
      cv::fillPoly(board_, points, colour, cv::LINE_AA);
    else
      cv::polylines(board_, points, true, colour, stroke(), cv::LINE_AA);
  }

  void line() {
    const cv::Point from = place();
    const double length = 1.5 * size(), angle = random_.uniform(0, 2 * std::numbers::pi);
    const cv::Point to(static_cast<int>(from.x + length * std::cos(angle)),
                       static_cast<int>(from.y + length * std::sin(angle)));
    cv::line(board_, from, to, ink(), stroke(), cv::LINE_AA);
  }

  // Draws an upright patch, then turns it into its place.
  void stamp(const cv::Mat& ink_map, const cv::Mat& mask) {
    const cv::Point centre = place();
    cv::Mat turn = cv::getRotationMatrix2D({0.5f * ink_map.cols, 0.5f * ink_map.rows},
                                           random_.uniform(0, 360), 1.0);
    turn.at<double>(0, 2) += centre.x - 0.5 * ink_map.cols;
    turn.at<double>(1, 2) += centre.y - 0.5 * ink_map.rows;
    const int reach = static_cast<int>(0.5 * std::hypot(ink_map.cols, ink_map.rows)) + 2;
    const cv::Rect window = cv::Rect(centre.x - reach, centre.y - reach, 2 * reach, 2 * reach) &
                            cv::Rect({}, board_.size());
    turn.at<double>(0, 2) -= window.x;
    turn.at<double>(1, 2) -= window.y;
    cv::Mat turned, cover;
    cv::warpAffine(ink_map, turned, turn, window.size(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    cv::warpAffine(mask, cover, turn, window.size(), cv::INTER_LINEAR, cv::BORDER_CONSTANT, 0);
    cv::Mat target = board_(window);
    for (int y = 0; y < target.rows; ++y)
      for (int x = 0; x < target.cols; ++x) {
        std::uint8_t& grey = target.at<std::uint8_t>(y, x);
        const int share = cover.at<std::uint8_t>(y, x);
        grey = static_cast<std::uint8_t>(
            (grey * (255 - share) + turned.at<std::uint8_t>(y, x) * share + 127) / 255);
      }
  }

  void word() {
    static constexpr const char* WORDS[] = {"SCALE 1:5", "Part No. 17", "bolt M6",  "TRAY B",
                                            "edge",      "0427-A",      "Keep dry", "FRONT",
                                            "ISO 2768",  "batch 93",    "QC ok",    "R12.5"};
    const char* text = WORDS[random_.below(static_cast<int>(std::size(WORDS)))];
    const int font = random_.below(5);  // Hershey simplex, plain, duplex, complex, triplex
    const double height = 0.35 * size();
    const double scale = std::max(0.3, height / 22.0);
    const int thickness = 1 + static_cast<int>(scale * random_.uniform(0.5, 3.0));
    int baseline = 0;
    const cv::Size box = cv::getTextSize(text, font, scale, thickness, &baseline);
    cv::Mat mask = cv::Mat::zeros(box.height + 2 * baseline + 4, box.width + 8, CV_8U);
    cv::putText(mask, text, {4, box.height + 2}, font, scale, cv::Scalar::all(255), thickness,
                cv::LINE_AA);
    stamp(cv::Mat(mask.size(), CV_8U, ink()), mask);
  }

  void checkers() {
    const int columns = 3 + random_.below(5), rows = 3 + random_.below(4);
    const int cell = std::max(2, static_cast<int>(0.6 * size() / columns));
    const cv::Scalar dark = ink(), light = ink();
    cv::Mat patch(rows * cell, columns * cell, CV_8U);
    for (int y = 0; y < rows; ++y)
      for (int x = 0; x < columns; ++x)
        patch(cv::Rect(x * cell, y * cell, cell, cell)).setTo((x + y) % 2 ? light : dark);
    stamp(patch, cv::Mat(patch.size(), CV_8U, cv::Scalar::all(255)));
  }

  void bars() {
    const int width = static_cast<int>(0.8 * size()) + 8,
              height = width * (2 + random_.below(3)) / 6;
    cv::Mat patch(height, width, CV_8U, cv::Scalar::all(200));
    for (int x = 0; x < width;) {
      const int bar = 1 + static_cast<int>(0.06 * width * random_.uniform());
      cv::rectangle(patch, {x, 0, bar, height}, cv::Scalar::all(20), cv::FILLED);
      x += bar + 1 + static_cast<int>(0.06 * width * random_.uniform());
    }
    stamp(patch, cv::Mat(patch.size(), CV_8U, cv::Scalar::all(255)));
  }

  cv::Mat& board_;
  double smallest_, largest_;
  Random& random_;
};

// Adds a low, cloudy variation of the paper, so that the edge detector's robustness is tested: an
// even grey has no false edges.
void add_grain(cv::Mat& board, Random& random) {
  for (const auto& [cells, amplitude] : {std::pair{6, 0.04}, {40, 0.02}, {400, 0.02}}) {
    cv::Mat coarse(cells, cells, CV_32F), fine;
    for (int y = 0; y < cells; ++y)
      for (int x = 0; x < cells; ++x)
        coarse.at<float>(y, x) = static_cast<float>(1 + amplitude * random.normal());
    cv::resize(coarse, fine, board.size(), 0, 0, cv::INTER_CUBIC);
    cv::multiply(board, fine, board, 1, CV_8U);
  }
}

// Plain paper, or the albedo * 255 that a photograph shows.
cv::Mat paper_of(const PrintOptions& options, double plain_albedo) {
  cv::Mat paper(options.side_px, options.side_px, CV_8U, cv::Scalar::all(255 * plain_albedo));
  if (options.texture.pixels.empty()) return paper;
  constexpr double WHITEST = 0.9;
  for (int y = 0; y < paper.rows; ++y)
    for (int x = 0; x < paper.cols; ++x)
      paper.at<std::uint8_t>(y, x) =
          static_cast<std::uint8_t>(255 * WHITEST * light_of_grey(options.texture.at(x, y)));
  return paper;
}

}  // namespace

Image print_board(const PrintOptions& options, Random random) {
  const double plain_albedo = std::pow(random.uniform(0.45, 0.85), 2);
  cv::Mat board = paper_of(options, plain_albedo);
  // As many shapes of middle size as together have the given share of the board's area.
  const double middle = std::sqrt(options.smallest_px * options.largest_px);
  const double cover = options.clutter == 0 ? 0.0 : options.clutter == 1 ? 0.45 : 1.2;
  const int shapes =
      static_cast<int>(cover * options.side_px * options.side_px / (middle * middle));
  Printer printer(board, options.smallest_px, options.largest_px, random);
  for (int i = 0; i < shapes; ++i) printer.draw_one();
  add_grain(board, random);
  return {board.cols, board.rows, std::vector<std::uint8_t>(board.datastart, board.dataend)};
}

}  // namespace edgescout
