// Internal to host/io: where the files of a BOP scene lie.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace edgescout {

bool is_there(const std::filesystem::path& path);  // false where it cannot be examined

// The image files of one camera. Those of camera NAME lie in gray_NAME/, rgb_NAME/, .. or in NAME/
// itself; those of scene_camera.json in gray/, rgb/ and folders of like names. Of several folders
// with an image the first of these counts.
class ImageFiles {
 public:
  ImageFiles(const std::filesystem::path& scene, const std::string& camera_name);
  // Its depth images: in depth/ or depth_NAME/.
  static ImageFiles of_depth(const std::filesystem::path& scene, const std::string& camera_name);
  // If there is none, the name that it would have, so that the error of reading it names the
  // missing file.
  std::filesystem::path of(int image_id) const;
  bool has(int image_id) const { return files_.contains(image_id); }

 private:
  ImageFiles() = default;
  void add_folder(const std::filesystem::path& folder);
  std::map<int, std::filesystem::path> files_;
  std::filesystem::path folder_;  // in which a missing image is missed
};

}  // namespace edgescout
