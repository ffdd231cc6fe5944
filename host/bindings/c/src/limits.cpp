#include "host/bindings/c/src/limits.h"

#include <cmath>

#include "host/bindings/c/src/contents.h"
#include "host/bindings/c/src/structs.h"

namespace edgescout::c {

TimeLimit limit_of(const edgescout_limit* given) {
  if (!given) return {};
  const auto asked = read_struct(given, "limit");
  if (!(asked.max_seconds >= 0))
    refuse(EDGESCOUT_BAD_INPUT, "limit.max_seconds", std::to_string(asked.max_seconds),
           "0 or more");
  TimeLimit limit;
  if (asked.max_seconds > 0) limit = TimeLimit::after(asked.max_seconds);
  std::shared_ptr<Live<edgescout_canceller>> canceller;
  if (asked.canceller) canceller = live(asked.canceller);
  if (canceller || asked.cancelled)
    limit.cancelled = [canceller, cancelled = asked.cancelled, user = asked.user] {
      return (canceller && *canceller->value) || (cancelled && cancelled(user) != 0);
    };
  return latched(limit);
}

}  // namespace edgescout::c

using namespace edgescout::c;

edgescout_status edgescout_canceller_create(edgescout_canceller** out) {
  return create(out, [] { return std::make_unique<std::atomic<bool>>(false); });
}

edgescout_status edgescout_cancel(edgescout_canceller* canceller) {
  return guarded([&] { *live(canceller)->value = true; });
}

edgescout_status edgescout_canceller_reset(edgescout_canceller* canceller) {
  return guarded([&] { *live(canceller)->value = false; });
}
