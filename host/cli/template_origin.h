// Where the templates of an object came from, and how long that took.
#pragma once

#include <string>

namespace edgescout {

struct TemplateOrigin {
  int object_id = 0;
  std::string source;  // "built", "cache" or "file"
  double seconds = 0;
};

}  // namespace edgescout
