// Messages of the library, which go to one installed sink. The library prints nothing itself.
//
// Public header.
#pragma once

#include <functional>
#include <string>

namespace edgescout {

enum class LogLevel { Debug, Info, Warning, Error };
using LogSink = std::function<void(LogLevel, const std::string&)>;

// Replaces the sink of the whole process. An empty sink (the default) drops every message. No other
// thread may log at the same time.
void set_log_sink(LogSink sink);
void log(LogLevel level, const std::string& message);

}  // namespace edgescout
