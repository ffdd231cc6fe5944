// Internal to host/io: the header of a PLY file, which says what its body holds.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace edgescout {

struct PlyProperty {
  std::string name;
  // b, h, i, q: signed of 1, 2, 4, 8 bytes; B, H, I, Q: unsigned; f, d: float, double
  char type = 'f';
  char count_type = '\0';  // of a list
};

struct PlyElement {
  std::string name;
  int count = 0;
  std::vector<PlyProperty> properties;
};

enum class PlyStorage { Text, LittleEndian, BigEndian };

struct PlyHeader {
  PlyStorage storage = PlyStorage::Text;
  std::vector<PlyElement> elements;
  std::size_t bytes = 0;  // of the header with the end of its last line
};

// The lines of the header end as its first line does: in LF, CR LF or CR. InputError naming
// `source`: no header of PLY 1.0.
PlyHeader read_ply_header(std::string_view file, const std::string& source);

// The number of bytes of a number; in text 2, a digit and a blank.
std::size_t least_bytes(char type, PlyStorage storage);
// That of a row; lists are empty.
std::size_t least_bytes(const PlyElement& element, PlyStorage storage);

}  // namespace edgescout
