// What the library logs while this lives, at the level that programs begin with.
#pragma once

#include <string>
#include <vector>

#include "host/core/log.h"

namespace edgescout::test {

struct CollectedLog {
  std::vector<std::pair<LogLevel, std::string>> messages;
  CollectedLog() {
    set_log_sink([this](LogLevel level, const std::string& text) {
      if (level != LogLevel::Debug) messages.emplace_back(level, text);
    });
  }
  CollectedLog(const CollectedLog&) = delete;
  CollectedLog& operator=(const CollectedLog&) = delete;
  ~CollectedLog() { set_log_sink({}); }
};

}  // namespace edgescout::test
