// The table of live objects, by which a handle that is null, freed, invented or of another kind is
// found out, and the count of calls that use an object.
//
// A handle is a number in the form of a pointer. Numbers are never used twice, so that a freed one
// stays invalid. Those of another library, or of this one loaded again, begin elsewhere.
#pragma once

#include <atomic>
#include <memory>
#include <utility>

#include "host/bindings/c/src/status.h"

namespace edgescout::c {

enum class Use {
  Shared,     // reads: any number of calls at once
  Exclusive,  // changes: one call alone
};

class Resource {
 public:
  virtual ~Resource() = default;
  virtual const char* kind() const = 0;
  // False: another call's use is in the way.
  bool begin(Use use);
  void end(Use use);
  bool is_changing() const { return uses_ == EXCLUSIVE; }

 private:
  static constexpr int EXCLUSIVE = -1;
  std::atomic<int> uses_ = 0;  // shared ones, or EXCLUSIVE
};

// What the library keeps under a handle; contents.h has one for each type:
//   using Type; static constexpr const char* name;
template <typename Handle>
struct Content;

template <typename Handle>
struct Live : Resource {
  explicit Live(typename Content<Handle>::Type given) : value(std::move(given)) {}
  const char* kind() const override { return Content<Handle>::name; }
  typename Content<Handle>::Type value;
};

// Returns its handle.
const void* add_resource(std::shared_ptr<Resource> resource);
// EDGESCOUT_NULL, EDGESCOUT_BAD_HANDLE. `name` is that of the argument.
std::shared_ptr<Resource> resource_of(const void* handle, const char* name, const char* kind);
void free_handle(const void* handle);

// An object in use by a call.
template <typename Handle>
class Borrowed {
 public:
  // EDGESCOUT_BUSY.
  Borrowed(std::shared_ptr<Live<Handle>> object, Use use) : object_(std::move(object)), use_(use) {
    if (!object_->begin(use_))
      refuse(EDGESCOUT_BUSY, Content<Handle>::name, "one that another call uses",
             "one call at a time");
  }
  Borrowed(Borrowed&& other) noexcept : object_(std::move(other.object_)), use_(other.use_) {}
  Borrowed& operator=(Borrowed&&) = delete;
  ~Borrowed() {
    if (object_) object_->end(use_);
  }
  auto& operator*() const { return object_->value; }
  auto* operator->() const { return &object_->value; }

 private:
  std::shared_ptr<Live<Handle>> object_;  // lives on where it is freed meanwhile
  Use use_;
};

// EDGESCOUT_NULL, EDGESCOUT_BAD_HANDLE, EDGESCOUT_WRONG_KIND.
template <typename Handle>
std::shared_ptr<Live<Handle>> live(const Handle* handle) {
  const char* const kind = Content<Handle>::name;
  std::shared_ptr<Resource> resource = resource_of(handle, kind, kind);
  auto object = std::dynamic_pointer_cast<Live<Handle>>(resource);
  if (!object)
    refuse(EDGESCOUT_WRONG_KIND, kind, std::string("a handle of kind ") + resource->kind(),
           std::string("one of kind ") + kind);
  return object;
}

template <typename Handle>
Borrowed<Handle> shared(const Handle* handle) {
  return {live(handle), Use::Shared};
}

template <typename Handle>
Borrowed<Handle> exclusive(const Handle* handle) {
  return {live(handle), Use::Exclusive};
}

// Keeps what `make` returns under a new handle; NULL where it throws.
template <typename Handle, typename Make>
edgescout_status create(Handle** out, const Make& make) noexcept {
  return guarded([&] {
    require(out, "out");
    *out = nullptr;
    const void* const handle = add_resource(std::make_shared<Live<Handle>>(make()));
    *out = static_cast<Handle*>(const_cast<void*>(handle));
  });
}

}  // namespace edgescout::c
