// edgescout_ros2: detection as a node of ROS 2, without ROS.
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <thread>

#include "host/bridge/ros2/dds/bridge_topics.h"
#include "host/bridge/ros2/frames.h"
#include "host/bridge/ros2/program/program_options.h"
#include "host/cli/caught_errors.h"
#include "host/cli/common_arguments.h"
#include "host/cli/exit_codes.h"
#include "host/cli/template_sets.h"
#include "host/core/freed_memory.h"
#include "host/core/log.h"
#include "host/io/one_line.h"
#include "kernels/backend.h"
#include "kernels/error.h"

namespace edgescout::ros2 {

namespace {

std::atomic<bool> is_interrupted = false;

void send_log_to_stderr(const std::string& level) {
  spdlog::set_default_logger(spdlog::stderr_color_mt("edgescout_ros2"));
  spdlog::set_pattern("%n: %^%l%$: %v");
  spdlog::set_level(spdlog::level::from_str(level));
  set_log_sink([](LogLevel of, const std::string& message) {
    constexpr spdlog::level::level_enum levels[] = {spdlog::level::debug, spdlog::level::info,
                                                    spdlog::level::warn, spdlog::level::err};
    spdlog::log(levels[static_cast<int>(of)], message);
  });
}

std::uint32_t domain_of_environment() {
  const char* text = std::getenv("ROS_DOMAIN_ID");
  if (!text || !*text) return 0;
  char* end = nullptr;
  const unsigned long domain = std::strtoul(text, &end, 10);
  if (*end != 0 || domain > 232) throw InputError("environment", "ROS_DOMAIN_ID", text, "0 to 232");
  return std::uint32_t(domain);
}

// The second variable is that of ROS 2 from Iron on.
bool is_local_only() {
  const auto is = [](const char* variable, const char* value) {
    const char* text = std::getenv(variable);
    return text && std::string(text) == value;
  };
  return is("ROS_LOCALHOST_ONLY", "1") || is("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST");
}

// Reads models before anything else, so that a wrong file ends the program at once. Templates are
// made for the first camera.
TemplateSource template_source(const ProgramOptions& options, Backend& backend) {
  KnownModels models = load_models(options.models);
  for (const Object& object : models.objects)
    require_distances_of_size(object.mesh.name, object.mesh.diameter_m, options.templates);
  return [known = std::move(models), &options, &backend](const Camera& camera,
                                                         const IsCancelled& is_cancelled) {
    const SearchedImages searched{camera, {}, {}};
    return template_sets_of(known, options.templates, searched, backend,
                            make_template_cache(options.models.cache), is_cancelled)
        .sets;
  };
}

msg::Time now() {
  return time_of(std::chrono::duration_cast<std::chrono::nanoseconds>(
                     std::chrono::system_clock::now().time_since_epoch())
                     .count());
}

// Works until the bridge is stopped. A failed device stops it.
void work(Bridge& bridge, std::exception_ptr& failure) {
  constexpr double longest_wait_s = 0.5;
  try {
    while (!bridge.is_stopped()) bridge.work(longest_wait_s);
  } catch (...) {
    failure = std::current_exception();
    bridge.stop();
  }
}

void receive(DdsNode& node, Bridge& bridge, const InputTopics& inputs,
             const ResultTopics& results) {
  using namespace std::chrono;
  constexpr double longest_wait_s = 0.1;
  auto next_report = steady_clock::now() + seconds(1);
  while (!is_interrupted && !bridge.is_stopped()) {
    node.spin(longest_wait_s);
    if (steady_clock::now() < next_report) continue;
    next_report = steady_clock::now() + seconds(1);
    inputs.check();
    bridge.diagnostics().set("messages left out: no memory", std::to_string(node.left_out()));
    results.send(bridge.diagnostics().message(now()));
  }
}

int run_node(const ProgramOptions& options) {
  const std::unique_ptr<Backend> backend = backend_of(options.device);
  const TemplateSource templates = template_source(options, *backend);
  DdsNode node(domain_of_environment(), is_local_only());
  ResultTopics results(node, options.ros);
  Bridge bridge(templates, *backend, options.bridge, results);
  const InputTopics inputs(node, options.ros, options.topics, bridge);
  log(LogLevel::Info, "images of " + full_name("image", options.ros) + ", detections to " +
                          full_name("~/detections", options.ros) + ", on " + backend->name());
  std::exception_ptr failure;
  std::thread worker([&] { work(bridge, failure); });
  receive(node, bridge, inputs, results);
  bridge.stop();
  worker.join();
  if (failure) std::rethrow_exception(failure);
  return exit_done;
}

int run(const std::vector<std::string>& arguments) {
  ProgramOptions options;
  const std::string text = read_options(arguments, options);
  if (!text.empty()) {
    std::cout << text << std::flush;
    return exit_done;
  }
  send_log_to_stderr(options.log_level);
  for (const std::string& warning : options.ros.warnings) log(LogLevel::Warning, warning);
  return run_node(options);
}

int fail(const std::string& message, ExitCode code) {
  std::cerr << "edgescout_ros2: error: " << one_line(message) << std::endl;
  return code;
}

}  // namespace

}  // namespace edgescout::ros2

int main(int argc, char** argv) {
  for (const int signal : {SIGINT, SIGTERM})
    std::signal(signal, [](int) { edgescout::ros2::is_interrupted = true; });
  edgescout::keep_freed_memory();
  return edgescout::with_caught_errors(
      [&] {
        return edgescout::ros2::run({argv + 1, argv + argc});
      },
      edgescout::ros2::fail);
}
