// Draws line plots as SVG, with ticks, a legend and intervals as bands. One file has several panels
// side by side.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace edgescout {

struct PlotPoint {
  double x = 0, y = 0;
  std::optional<double> low, high;  // of y; drawn if both are given
};

struct PlotLine {
  std::string name;               // in the legend; lines of one name have one colour in all panels
  std::vector<PlotPoint> points;  // in the order of x
};

struct Panel {
  std::string title, x_label, y_label;
  std::vector<PlotLine> lines;
  double y_min = 0, y_max = 1;  // the range shown; higher values extend it
  bool logarithmic_x = false;   // then all x must be above 0; otherwise the axis includes 0
};

// Returns ticks at steps of 1, 2 or 5 times a power of ten that cover [low, high] with at most
// `most` steps. The first is at or below low, the last at or above high.
std::vector<double> tick_values(double low, double high, int most = 6);

// Returns a whole SVG file with at most `columns` panels per row. A panel without title and lines
// leaves its place empty. `description` is for readers of the file's text. Numbers that are not
// finite are left out.
std::string svg_of(std::span<const Panel> panels, int columns = 3,
                   const std::string& description = "");

}  // namespace edgescout
