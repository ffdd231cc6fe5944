#include "host/core/option_names.h"

#include <algorithm>
#include <atomic>

namespace edgescout {

namespace {

std::string field_name(const std::string& name) {
  std::string field = name;
  std::ranges::replace(field, '-', '_');
  return field;
}

std::atomic<std::string (*)(const std::string&)> naming{field_name};

}  // namespace

std::string option_name(const std::string& name) { return naming.load()(name); }

void set_option_naming(std::string (*name_of)(const std::string& name)) { naming = name_of; }

}  // namespace edgescout
