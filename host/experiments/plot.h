// Line plots as SVG: axes with ticks, a legend, intervals as bands. Panels stand side by side in
// one file.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace edgescout {

struct PlotPoint {
  double x = 0, y = 0;
  std::optional<double> low, high;  // of y; drawn where both are given
};

struct PlotLine {
  std::string name;               // in the legend; lines of one name have one colour in all panels
  std::vector<PlotPoint> points;  // by rising x
};

struct Panel {
  std::string title, x_label, y_label;
  std::vector<PlotLine> lines;
  double y_min = 0, y_max = 1;  // at least this range is shown; higher values extend it
  bool logarithmic_x = false;   // all x above 0; otherwise 0 belongs to the axis
};

// Steps of 1, 2 or 5 times a power of ten that cover [low, high] with at most `most` steps; the
// first is at or below low, the last at or above high.
std::vector<double> tick_values(double low, double high, int most = 6);

// A whole SVG file, at most `columns` panels a row, of one without title and lines the place left
// free, with a description for whoever opens it as text. Numbers that are not finite are left out.
std::string svg_of(std::span<const Panel> panels, int columns = 3,
                   const std::string& description = "");

}  // namespace edgescout
