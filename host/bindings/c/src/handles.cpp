#include "host/bindings/c/src/handles.h"

#include <chrono>
#include <mutex>
#include <unordered_map>

namespace edgescout::c {

namespace {

static_assert(sizeof(std::uintptr_t) == 8,
              "a handle has 20 bits of the library and 44 of a number");
constexpr int NUMBER_BITS = 44;  // a million a second for half a year

// Others where it is loaded elsewhere or at another time. One of them is always set, so that small
// numbers are no handles.
std::uintptr_t bits_of_this_library() {
  static const char place = 0;
  const auto now = std::chrono::steady_clock::now().time_since_epoch().count();
  const std::uintptr_t mixed =
      (reinterpret_cast<std::uintptr_t>(&place) ^ std::uintptr_t(now)) * 0x9e3779b97f4a7c15u;
  return (mixed >> NUMBER_BITS | 0x80000) << NUMBER_BITS;
}

struct Table {
  std::mutex mutex;
  std::uintptr_t next = bits_of_this_library() + 1;
  std::unordered_map<std::uintptr_t, std::shared_ptr<Resource>> live;
};

// Never destroyed: calls of other threads may still run while the process ends.
Table& table() {
  static Table* const the_table = new Table;
  return *the_table;
}

std::uintptr_t number_of(const void* handle) { return reinterpret_cast<std::uintptr_t>(handle); }

}  // namespace

bool Resource::begin(Use use) {
  int uses = uses_;
  int after = 0;
  do {
    if (uses == EXCLUSIVE || (use == Use::Exclusive && uses != 0)) return false;
    after = use == Use::Exclusive ? EXCLUSIVE : uses + 1;
  } while (!uses_.compare_exchange_weak(uses, after));
  return true;
}

void Resource::end(Use use) {
  if (use == Use::Exclusive)
    uses_ = 0;
  else
    --uses_;
}

const void* add_resource(std::shared_ptr<Resource> resource) {
  Table& all = table();
  const std::scoped_lock lock(all.mutex);
  all.live.emplace(all.next, std::move(resource));
  // Nothing is read through it: NOLINTNEXTLINE(performance-no-int-to-ptr)
  return reinterpret_cast<const void*>(all.next++);
}

std::shared_ptr<Resource> resource_of(const void* handle, const char* name, const char* kind) {
  const std::string expected = std::string("one of kind ") + kind;
  if (!handle) refuse(EDGESCOUT_NULL, name, "NULL", expected);
  Table& all = table();
  const std::scoped_lock lock(all.mutex);
  const auto found = all.live.find(number_of(handle));
  if (found != all.live.end()) return found->second;
  const bool is_of_this_library =
      number_of(handle) >> NUMBER_BITS == all.next >> NUMBER_BITS && number_of(handle) < all.next;
  refuse(EDGESCOUT_BAD_HANDLE, name,
         is_of_this_library ? "a handle that was freed" : "a handle that this library never made",
         expected);
}

void free_handle(const void* handle) {
  if (!handle) return;
  const std::shared_ptr<Resource> resource = resource_of(handle, "handle", "any");
  if (resource->is_changing())
    refuse(EDGESCOUT_BUSY, resource->kind(), "one that another call uses", "one that none uses");
  Table& all = table();
  const std::scoped_lock lock(all.mutex);
  all.live.erase(number_of(handle));
}

}  // namespace edgescout::c

using namespace edgescout::c;

edgescout_status edgescout_free(const void* handle) {
  return guarded([&] { free_handle(handle); });
}

size_t edgescout_handle_count(void) {
  std::size_t count = 0;
  guarded([&] {
    Table& all = table();
    const std::scoped_lock lock(all.mutex);
    count = all.live.size();
  });
  return count;
}
