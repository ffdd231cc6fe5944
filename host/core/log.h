// The library prints nothing: it hands its messages to one installed sink.
#pragma once

#include <functional>
#include <string>

namespace edgescout {

enum class LogLevel { Debug, Info, Warning, Error };
using LogSink = std::function<void(LogLevel, const std::string&)>;

// Replaces the sink for the whole process; an empty one (the start) drops every message. Not for
// use while another thread logs.
void set_log_sink(LogSink sink);
void log(LogLevel level, const std::string& message);

}  // namespace edgescout
