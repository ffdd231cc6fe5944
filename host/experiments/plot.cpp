#include "host/experiments/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace edgescout {

namespace {

constexpr double WIDTH = 380, HEIGHT = 300;                     // of a panel with its labels
constexpr double LEFT = 62, RIGHT = 14, TOP = 34, BOTTOM = 50;  // around the axes
constexpr double LEGEND_LINE = 20, MARGIN = 10;
// Okabe and Ito's colours, told apart by colour-blind readers too; then dashes.
constexpr const char* COLOURS[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                   "#56b4e9", "#e69f00", "#000000"};
constexpr const char* DASHES[] = {"", "6 3", "2 2"};

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else if (static_cast<unsigned char>(c) >= 0x20)
      result += c;
  }
  return result;
}

struct Style {
  std::string colour, dash;
};

Style style_of(std::size_t index) {
  return {COLOURS[index % std::size(COLOURS)],
          DASHES[index / std::size(COLOURS) % std::size(DASHES)]};
}

std::vector<std::string> names_in(std::span<const Panel> panels) {
  std::vector<std::string> names;
  for (const Panel& panel : panels)
    for (const PlotLine& line : panel.lines)
      if (std::ranges::find(names, line.name) == names.end()) names.push_back(line.name);
  return names;
}

bool is_drawn(const PlotPoint& point, const Panel& panel) {
  return std::isfinite(point.x) && std::isfinite(point.y) && (!panel.logarithmic_x || point.x > 0);
}

// Values to places on the page.
class Axes {
 public:
  Axes(const Panel& panel, double left, double top)
      : panel_(panel), left_(left + LEFT), top_(top + TOP) {
    double x_low = std::numeric_limits<double>::infinity(), x_high = -x_low, y_low = panel.y_min,
           y_high = panel.y_max;
    for (const PlotLine& line : panel.lines)
      for (const PlotPoint& point : line.points) {
        if (!is_drawn(point, panel)) continue;
        x_low = std::min(x_low, along(point.x));
        x_high = std::max(x_high, along(point.x));
        y_low = std::min({y_low, point.y, point.low.value_or(point.y)});
        y_high = std::max({y_high, point.y, point.high.value_or(point.y)});
      }
    if (!(x_low <= x_high)) x_low = 0, x_high = 1;
    x_ticks =
        panel.logarithmic_x ? decades(x_low, x_high) : tick_values(std::min(0.0, x_low), x_high);
    y_ticks = tick_values(y_low, y_high);
  }
  double x(double value) const {
    return left_ + (along(value) - along(x_ticks.front())) /
                       (along(x_ticks.back()) - along(x_ticks.front())) * width();
  }
  double y(double value) const {
    return top_ + (1 - (value - y_ticks.front()) / (y_ticks.back() - y_ticks.front())) * height();
  }
  double left() const { return left_; }
  double top() const { return top_; }
  static double width() { return WIDTH - LEFT - RIGHT; }
  static double height() { return HEIGHT - TOP - BOTTOM; }

  std::vector<double> x_ticks, y_ticks;

 private:
  double along(double value) const { return panel_.logarithmic_x ? std::log10(value) : value; }
  static std::vector<double> decades(double low, double high) {
    const double first = std::floor(low), last = std::max(std::ceil(high), first + 1);
    std::vector<double> ticks;
    for (double exponent = first; exponent <= last; ++exponent)
      ticks.push_back(std::pow(10, exponent));
    return ticks;
  }

  const Panel& panel_;
  double left_, top_;
};

std::string text_at(double x, double y, const std::string& text, const std::string& more = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\"{}>{}</text>\n", x, y, more, escaped(text));
}

std::string frame(const Panel& panel, const Axes& axes) {
  const double right = axes.left() + Axes::width(), bottom = axes.top() + Axes::height();
  std::string svg;
  for (const double tick : axes.x_ticks) {
    svg += fmt::format(
        "<line class=\"grid\" x1=\"{0:.1f}\" y1=\"{1:.1f}\" x2=\"{0:.1f}\" y2=\"{2:.1f}\"/>\n",
        axes.x(tick), axes.top(), bottom);
    svg += text_at(axes.x(tick), bottom + 15, fmt::format("{:g}", tick), " text-anchor=\"middle\"");
  }
  for (const double tick : axes.y_ticks) {
    svg += fmt::format(
        "<line class=\"grid\" x1=\"{1:.1f}\" y1=\"{0:.1f}\" x2=\"{2:.1f}\" y2=\"{0:.1f}\"/>\n",
        axes.y(tick), axes.left(), right);
    svg += text_at(axes.left() - 6, axes.y(tick) + 4, fmt::format("{:g}", tick),
                   " text-anchor=\"end\"");
  }
  svg += fmt::format(
      "<rect class=\"axes\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n",
      axes.left(), axes.top(), Axes::width(), Axes::height());
  const double middle_x = axes.left() + Axes::width() / 2,
               middle_y = axes.top() + Axes::height() / 2;
  svg += text_at(middle_x, axes.top() - 10, panel.title,
                 " text-anchor=\"middle\" font-weight=\"bold\"");
  svg += text_at(middle_x, bottom + 34, panel.x_label, " text-anchor=\"middle\"");
  svg += text_at(axes.left() - 44, middle_y, panel.y_label,
                 fmt::format(" text-anchor=\"middle\" transform=\"rotate(-90 {:.1f} {:.1f})\"",
                             axes.left() - 44, middle_y));
  return svg;
}

std::string band(const PlotLine& line, const Panel& panel, const Axes& axes, const Style& style) {
  std::string upper, lower;
  for (const PlotPoint& point : line.points) {
    if (!is_drawn(point, panel) || !point.low || !point.high) continue;
    upper += fmt::format("{:.1f},{:.1f} ", axes.x(point.x), axes.y(*point.high));
    lower = fmt::format("{:.1f},{:.1f} ", axes.x(point.x), axes.y(*point.low)) + lower;
  }
  if (upper.empty()) return {};
  return fmt::format(
      "<polygon points=\"{}{}\" fill=\"{}\" fill-opacity=\"0.13\" stroke=\"none\"/>\n", upper,
      lower, style.colour);
}

std::string stroke(const Style& style) {
  return fmt::format("stroke=\"{}\"{}", style.colour,
                     style.dash.empty() ? "" : " stroke-dasharray=\"" + style.dash + "\"");
}

std::string curve(const PlotLine& line, const Panel& panel, const Axes& axes, const Style& style) {
  constexpr std::size_t MOST_MARKED = 30;
  std::string points, marks;
  for (const PlotPoint& point : line.points) {
    if (!is_drawn(point, panel)) continue;
    points += fmt::format("{:.1f},{:.1f} ", axes.x(point.x), axes.y(point.y));
    marks += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.5\" fill=\"{}\"/>\n",
                         axes.x(point.x), axes.y(point.y), style.colour);
  }
  return fmt::format("<polyline class=\"curve\" points=\"{}\" {}/>\n", points, stroke(style)) +
         (line.points.size() > MOST_MARKED ? "" : marks);
}

// Room for the longest name at 12 px and the line before it.
double legend_column(const std::vector<std::string>& names) {
  constexpr double LETTER = 7, LEAST = 190, BACKGROUND_COPIES = 50;
  std::size_t longest = 0;
  for (const std::string& name : names) longest = std::max(longest, name.size());
  return std::max(LEAST, LETTER * static_cast<double>(longest) + BACKGROUND_COPIES);
}

std::string legend(const std::vector<std::string>& names, double top, int a_row) {
  const double column = legend_column(names);
  std::string svg;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double x = MARGIN + LEFT + column * static_cast<double>(i % a_row),
                 y = top + LEGEND_LINE * static_cast<double>(i / a_row);
    svg += fmt::format(
        "<line class=\"curve\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", x,
        y, x + 26, y, stroke(style_of(i)));
    svg += text_at(x + 32, y + 4, names[i]);
  }
  return svg;
}

}  // namespace

std::vector<double> tick_values(double low, double high, int most) {
  if (!(high > low)) high = low + 1;
  double step = std::pow(10, std::floor(std::log10((high - low) / most)));
  constexpr double SLACK = 1e-9;  // of a step: rounding must not add one
  const auto steps = [&](double size) {
    return std::ceil(high / size - SLACK) - std::floor(low / size + SLACK);
  };
  for (const double factor : {2.0, 2.5, 2.0})
    if (steps(step) > most) step *= factor;
  const double first = std::floor(low / step + SLACK);
  std::vector<double> ticks;
  for (int i = 0; i <= static_cast<int>(steps(step)); ++i) {
    const double tick = (first + i) * step;
    ticks.push_back(std::abs(tick) < SLACK * step ? 0 : tick);
  }
  return ticks;
}

std::string svg_of(std::span<const Panel> panels, int columns, const std::string& description) {
  const std::vector<std::string> names = names_in(panels);
  const int count = static_cast<int>(panels.size()), across = std::max(1, std::min(columns, count));
  const int a_row = std::max(1, static_cast<int>((across * WIDTH - LEFT) / legend_column(names)));
  const double legend_top = MARGIN + HEIGHT * ((count + across - 1) / across);
  const double width = 2 * MARGIN + across * WIDTH,
               height = legend_top +
                        LEGEND_LINE * static_cast<double>((names.size() + a_row - 1) / a_row) +
                        MARGIN;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 "
      "0 {0:.0f} "
      "{1:.0f}\" "
      "font-family=\"sans-serif\" "
      "font-size=\"12\">\n<style>.grid{{stroke:#ddd}}.axes{{fill:none;stroke:#333}}"
      ".curve{{fill:none;stroke-width:1.8}}</style>\n<rect width=\"100%\" height=\"100%\" "
      "fill=\"white\"/>\n",
      width, height);
  if (!description.empty()) svg += "<desc>" + escaped(description) + "</desc>\n";
  for (int i = 0; i < count; ++i) {
    const Panel& panel = panels[i];
    if (panel.lines.empty() && panel.title.empty()) continue;
    const Axes axes(panel, MARGIN + WIDTH * (i % across), MARGIN + HEIGHT * (i / across));
    svg += frame(panel, axes);
    const auto style = [&](const PlotLine& line) {
      return style_of(std::ranges::find(names, line.name) - names.begin());
    };
    for (const PlotLine& line : panel.lines) svg += band(line, panel, axes, style(line));
    for (const PlotLine& line : panel.lines) svg += curve(line, panel, axes, style(line));
  }
  return svg + legend(names, legend_top, a_row) + "</svg>\n";
}

}  // namespace edgescout
