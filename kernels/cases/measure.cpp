#include "kernels/cases/measure.h"

#include <algorithm>
#include <chrono>

namespace edgescout::bench {

namespace {

double now_ms() {
  return std::chrono::duration<double, std::milli>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

}  // namespace

std::optional<double> Row::on_device_ms() const {
  double seconds = 0;
  bool has_host_beside = false;
  for (const StageTime& stage : stages)
    if (stage.name == HOST_STAGE)
      has_host_beside = true;
    else
      seconds += stage.seconds;
  if (!has_host_beside || repetitions == 0) return {};
  return 1000 * seconds / repetitions;
}

Row measure(Backend& backend, const Case& timed, int repetitions) {
  constexpr double enough_ms = 20000;
  timed.run();  // warm-up: caches, pages, the driver's compiler
  backend.take_timings();
  std::vector<double> times;
  const double begin = now_ms();
  for (int i = 0; i < repetitions && (i < 3 || now_ms() - begin < enough_ms); ++i) {
    const double start = now_ms();
    timed.run();
    times.push_back(now_ms() - start);
  }
  const std::vector<StageTime> stages = backend.take_timings();
  std::ranges::sort(times);
  const double median = 0.5 * (times[(times.size() - 1) / 2] + times[times.size() / 2]);
  return {timed.kernel, timed.size,    static_cast<int>(times.size()),
          median,       times.front(), times.back(),
          timed.bytes,  stages};
}

}  // namespace edgescout::bench
