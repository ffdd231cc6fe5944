#include "host/experiments/photographs.h"

#include <fmt/format.h>

#include "host/model/axis_symmetry.h"
#include "kernels/error.h"

namespace edgescout {

namespace fs = std::filesystem;

namespace {

constexpr int CAT_FRAMES = 32, CAT_STRIDE = 2;  // 0, 2 .. 30

std::vector<int> cat_frames(int every) {
  std::vector<int> frames;
  for (int frame = 0; frame < CAT_FRAMES; frame += CAT_STRIDE * every) frames.push_back(frame);
  return frames;
}

void require_files(const Photographs& source) {
  std::vector<fs::path> files{source.scene / "scene_camera.json", source.scene / "scene_gt.json",
                              source.models / "obj_000001.ply"};
  for (const int image : source.images)
    files.push_back(source.scene / "rgb" / fmt::format("{:06}.png", image));
  for (const fs::path& file : files)
    if (!fs::exists(file))
      throw InputError(file.string(), "file", "nothing", "a file of the photographs");
}

}  // namespace

std::vector<Photographs> photographs_in(const fs::path& data, int every) {
  if (data.empty()) return {};
  const fs::path brackets = data / "brackets", cat = data / "cat", triangle = data / "triangle";
  const std::vector<Photographs> sources{
      {"brackets", brackets / "000001", brackets / "models", {1, 2, 3}},
      {"brackets", brackets / "000002", brackets / "models", {4}},
      {"cat", cat, cat / "models", cat_frames(every)},
      {"triangle", triangle, triangle / "models", {200, 201}, {"z3", "x2"}}};
  for (const Photographs& source : sources) require_files(source);
  return sources;
}

KnownScene photographed_scene(const Photographs& source) {
  KnownScene scene = bop_scene(source.set, source.scene, source.models, source.images);
  if (!source.symmetry.empty())
    for (Object& object : scene.objects)
      object.symmetries = axis_symmetries(object.mesh, source.symmetry);
  return scene;
}

std::vector<NamedPhotograph> single_photographs(const fs::path& data, int every) {
  std::vector<NamedPhotograph> singles;
  for (Photographs source : photographs_in(data, every))
    for (const int image : std::vector(source.images)) {
      source.images = {image};
      singles.push_back(
          {fmt::format("{}/{}_{:06}", source.set, source.scene.filename().string(), image),
           source});
    }
  return singles;
}

}  // namespace edgescout
