// Internal to host/io: camera files of every syntax as one tree of JSON values.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace edgescout {

// Objects are the fields of one camera, or of several below their names. Several documents or
// cameras without names are an array. Accepts JSON with comments, YAML (also OpenCV's), XML, INI,
// and the texts of text_camera_tree. A byte order mark, UTF-16 and CRLF are accepted. InputError:
// none of these, a field that stands twice, nesting or aliases without an end.
nlohmann::json parse_camera_tree(const std::string& bytes, const std::string& source, bool is_json);

// One function for each syntax.
nlohmann::json yaml_camera_tree(const std::string& text, const std::string& source);
nlohmann::json xml_camera_tree(std::string_view text, const std::string& source);
// Numbers alone (cam_K.txt), COLMAP's cameras.txt, ROS ost.txt, the list of `rs-enumerate-devices
// -c`, and INI. Null: the text is none of these.
nlohmann::json text_camera_tree(std::string_view text, const std::string& source);

// The camera.txt of DSO and TUM's monoVO data, and the camera parameters of HALCON (file or tuple),
// as lines without empty ones. Null: another text. InputError: a model that is not read.
nlohmann::json dso_camera(const std::vector<std::string>& lines, const std::string& source);
nlohmann::json halcon_camera(const std::vector<std::string>& lines, const std::string& source);
// Kalibr's results-cam.txt and results-imucam.txt, as lines without empty ones. Null: neither.
nlohmann::json kalibr_results(const std::vector<std::string>& lines, const std::string& source);
// What programs print of a camera, as lines without empty ones: a table below names (rostopic echo
// -p) with commas, semicolons or tabs, cells in quotes or not; ROS 2's rows without names; a name
// and its numbers in each line; librealsense's intrinsics. Null: none of these.
nlohmann::json printed_camera_tree(const std::vector<std::string>& lines,
                                   const std::string& source);
// ROS 2: messages as Python prints them (`CameraInfo(height=480, ..)`) become YAML; what `ros2
// topic echo` says of lost messages is left out. Other texts come back unchanged.
std::string without_ros_prints(const std::string& text);
// Python's dictionary, and fields of one line, as YAML. Other texts come back unchanged.
std::string printed_as_yaml(const std::string& text);
// Names that stand above their numbers (numpy's print). Null: no matrix has one, or a name stands
// twice.
nlohmann::json headed_numbers(const std::string& text);

// A number, a truth value, null (also for an empty word) or the word itself. "nan" and "inf" are
// numbers, so that their reader can refuse them as such.
nlohmann::json scalar_of(const std::string& word);
// The numbers of a text, between blanks, commas, semicolons and brackets. Null: it holds anything
// else, or nothing.
nlohmann::json numbers_in(std::string_view text);
// A number, a list of several, or as scalar_of.
nlohmann::json value_in(const std::string& text);
// Joins the lines of a list that goes on over several lines. Its first line has `assigns` between
// name and list: '=' or ':'. Comments at the ends of lines are left out; within brackets a
// semicolon divides rows.
std::vector<std::string> with_whole_lists(const std::vector<std::string>& lines, char assigns);

// Adds a field. InputError: the object has one of that name.
void add_field(nlohmann::json& object, const std::string& name, nlohmann::json value,
               const std::string& source);
// Adds to the list of that name. InputError: the object has one of that name that is no list.
void add_to_list(nlohmann::json& object, const std::string& name, nlohmann::json value,
                 const std::string& source);

}  // namespace edgescout
