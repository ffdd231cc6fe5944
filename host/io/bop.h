// Reads and writes BOP datasets and result files. BOP has millimetres; these functions convert to
// and from metres.
//
// Public header.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/core/types.h"
#include "host/io/mesh.h"

namespace edgescout {

struct BopImage {
  int image_id = 0;
  std::filesystem::path file;
  Camera camera;  // size 0 x 0 until the image is read; `dist` is read if given
  std::optional<Se3> camera_from_world;  // set if the file has cam_R_w2c and cam_t_w2c
  std::filesystem::path depth_file;  // in depth/ or depth_NAME/; empty: the scene has none of it
  double depth_scale = 1;            // mm per stored unit; 1 if the file does not state it
  double depth_unit_m() const { return 1e-3 * depth_scale; }
};

struct BopTruth {
  int object_id = 0;
  Se3 camera_from_object;
  double visible_fraction = 1;  // visib_fract of scene_gt_info.json; 1 without that file
};

// What one camera saw of a scene. Most sets have one camera, with scene_camera.json. The industrial
// and the headset sets have several. Camera NAME has scene_camera_NAME.json, scene_gt_NAME.json and
// its images in gray_NAME/, rgb_NAME/ or NAME/.
struct BopScene {
  int scene_id = 0;  // from the folder's name; 0 if that is no number
  std::filesystem::path folder;
  std::string camera_name;                     // empty: the camera of scene_camera.json
  std::vector<BopImage> images;                // by image_id
  std::map<int, std::vector<BopTruth>> truth;  // by image_id; empty without scene_gt.json
};

std::string six_digits(int number);  // in BOP's names of files and folders: "000012"

// Returns whether the folder has scene_camera.json or scene_camera_NAME.json.
bool is_bop_scene(const std::filesystem::path& folder);

// Returns the names of the scene's cameras, sorted; "" stands for scene_camera.json and comes
// first.
std::vector<std::string> bop_cameras(const std::filesystem::path& folder);

// Returns the scene's file for `kind`: "scene_camera", "scene_gt" or "scene_gt_info".
std::filesystem::path bop_file(const std::filesystem::path& folder, const std::string& kind,
                               const std::string& camera_name);

// Reads what a camera saw; without a name the scene's only camera. Rotations up to 0.01 off are
// projected to the nearest one, with one warning a file. InputError naming file and field; several
// cameras and no name.
BopScene load_bop_scene(const std::filesystem::path& folder, const std::string& camera_name = "");
// Reads the same without the truth, whose files may be missing or broken.
BopScene load_bop_images(const std::filesystem::path& folder, const std::string& camera_name = "");

// Enough to find duplicates: a pose is at most 0.05 rad from the next sample.
inline constexpr int DETECTION_SYMMETRY_STEPS = 64;
// The BOP toolkit's value for evaluation (max_sym_disc_step 0.01): 0.01 rad.
inline constexpr int EVALUATION_SYMMETRY_STEPS = 315;

// Reads the symmetries of models_info.json, by object id. Continuous symmetries are sampled in
// `continuous_steps` steps. Discrete symmetries are extended to the group that they generate. They
// may be measured values, exact to 0.1 rad and 1 % of the diameter. If they generate no finite
// group, they are taken as listed. Every discrete symmetry is combined with every sample, as BOP
// does.
std::map<int, Symmetries> load_symmetries(const std::filesystem::path& models_info,
                                          int continuous_steps = DETECTION_SYMMETRY_STEPS);

// One row of a results CSV: scene_id,im_id,obj_id,score,R,t,time. If a scene has several cameras, a
// column `camera` may follow.
struct BopResult {
  int scene_id = 0, image_id = 0, object_id = 0;
  double score = 0;
  Se3 camera_from_object;
  double time_s = -1;       // below 0: unknown
  std::string camera_name;  // empty: not told
};
// Reads BOP's results. Rows that hold no pose (NaN, a matrix that is no rotation, too few numbers)
// are left out; one warning counts them and names the first. InputError: the file is empty, or it
// has rows and none holds a pose.
std::vector<BopResult> load_bop_results(const std::filesystem::path& file);
struct BopResultRows {
  std::vector<BopResult> results;
  int rows_without_pose = 0;  // left out
};
// Reads them with the number of the rows left out.
BopResultRows load_bop_result_rows(const std::filesystem::path& file);
// Writes BOP's results, with the column `camera` where a result has a camera.
void save_bop_results(const std::vector<BopResult>& results,
                      const std::filesystem::path& file);  // atomically

// Writes the scene's three files (bop_file) of a rendered scene. The caller writes the images.
void save_bop_scene(const BopScene& scene, const std::filesystem::path& folder);

}  // namespace edgescout
