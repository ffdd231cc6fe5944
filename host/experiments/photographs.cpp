#include "host/experiments/photographs.h"

#include <fmt/format.h>

#include "kernels/error.h"

namespace edgescout {

namespace fs = std::filesystem;

namespace {

constexpr int CAT_FRAMES = 32, CAT_STRIDE = 2;  // 0, 2 .. 30; frame 26 belongs to them

std::vector<int> cat_frames(const fs::path& scene, int every) {
  std::vector<int> frames;
  for (int frame = 0; frame < CAT_FRAMES; frame += CAT_STRIDE * every)
    if (fs::exists(scene / "rgb" / fmt::format("{:06}.png", frame))) frames.push_back(frame);
  return frames;
}

}  // namespace

std::vector<Photographs> photographs_in(const fs::path& data, int every) {
  if (data.empty()) return {};
  const fs::path brackets = data / "brackets", cat = data / "cat";
  for (const fs::path& file :
       {brackets / "000001/scene_camera.json", brackets / "000002/scene_camera.json",
        brackets / "models/obj_000001.ply", cat / "scene_camera.json", cat / "models/obj_000001.ply"})
    if (!fs::exists(file)) throw InputError(file.string(), "file", "nothing", "a file of the photographs");
  return {{"brackets", brackets / "000001", brackets / "models", {1, 2, 3}},
          {"brackets", brackets / "000002", brackets / "models", {4}},
          {"cat", cat, cat / "models", cat_frames(cat, every)}};
}

std::vector<NamedPhotograph> single_photographs(const fs::path& data, int every) {
  std::vector<NamedPhotograph> singles;
  for (const Photographs& source : photographs_in(data, every))
    for (const int image : source.images)
      singles.push_back(
          {fmt::format("{}/{}_{:06}", source.set, source.scene.filename().string(), image), source, image});
  return singles;
}

}  // namespace edgescout
