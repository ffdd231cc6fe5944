// A rendered BOP scene of one part, small enough to detect in within a second.
#pragma once

#include <map>

#include "host/io/image.h"
#include "host/render/parts.h"
#include "host/render/write_bop.h"
#include "kernels/thread_pool.h"
#include "tests/bare_board.h"
#include "tests/cli/example_scene.h"

namespace edgescout::test {

// Rendered once a program.
struct RenderedBracket {
  std::vector<Object> parts{make_part("l_bracket")};
  SimulatedScene scene;
  std::vector<Rendering> renderings;

  explicit RenderedBracket(int views) : scene(make_scene(parts, bare_board(1, views))) {
    ThreadPool pool(2);
    renderings = render(scene, pool);
  }
  static const RenderedBracket& in(int views) {
    static std::map<int, RenderedBracket> made;
    return made.try_emplace(views, views).first->second;
  }
};

struct SmallScene {
  TemporaryFolder folder;
  fs::path scene = folder.path() / "000003";
  fs::path out = folder.path() / "out";

  explicit SmallScene(int views = 1) {
    const RenderedBracket& made = RenderedBracket::in(views);
    write_bop_scene(made.scene, made.renderings, scene);
  }

  fs::path image(int index = 0) const {
    return scene / ("gray/00000" + std::to_string(index) + ".png");
  }

  // A ROS calibration of the scene's camera; the numbers may be replaced.
  std::string camera(const std::string& fx = "400", int width = 320, int height = 240) const {
    return folder.write("camera.yaml", "image_width: " + std::to_string(width) +
                                           "\nimage_height: " + std::to_string(height) +
                                           "\ncamera_matrix:\n  rows: 3\n  cols: 3\n  data: [" +
                                           fx + ", 0, 159.5, 0, 400, 119.5, 0, 0, 1]\n");
  }

  // `edgescout detect INPUT`, following few hits; where the line of what is reported lies is fitted
  // elsewhere.
  std::vector<std::string> detect(const fs::path& input,
                                  const std::vector<std::string>& more = {}) const {
    return joined({{"detect", input, "--out", out, "--device", "cpu", "--coarse-poses", "200",
                    "--medium-poses", "60", "--candidates", "10", "--min-probability", "0.1"},
                   more});
  }
};

// The pictures in a folder's report.html, in base64.
inline std::vector<std::string> pictures_in(const fs::path& out) {
  const std::string page = content_of(out / "report.html"), before = "id=picture";
  std::vector<std::string> pictures;
  for (std::size_t at = 0; (at = page.find(before, at)) != std::string::npos;) {
    const std::size_t start = page.find('>', at) + 1;
    pictures.push_back(page.substr(start, page.find('<', start) - start));
    at = start;
  }
  return pictures;
}

// The part and the templates that detections of it are made with.
inline std::vector<std::string> few_templates() {
  return {"--viewpoints",   "3",    "--in-plane-steps", "12",
          "--distance-min", "0.27", "--distance-max",   "0.33"};
}
inline std::vector<std::string> bracket() {
  return joined({{"--model", part_file(1), "--unit", "mm"}, few_templates()});
}

}  // namespace edgescout::test
