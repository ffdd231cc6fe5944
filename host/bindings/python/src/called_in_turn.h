// Objects that threads of Python share: a scout, a tracker.
#pragma once

#include <memory>
#include <mutex>
#include <type_traits>

#include "host/bindings/python/src/call_lock.h"

namespace edgescout::python {

// Calls of several threads follow one another. What `show` returned after the last one is read
// without waiting for a call.
template <typename Object, typename Shown>
class CalledInTurn {
 public:
  CalledInTurn(std::unique_ptr<Object> object, Shown (*show)(const Object&))
      : object_(std::move(object)), show_(show), shown_(show(*object_)) {}

  // Calls work(object). The caller has given up the interpreter's lock.
  template <typename Work>
  auto call(const Work& work) {
    const std::scoped_lock lock(calls_);
    if constexpr (std::is_void_v<decltype(work(*object_))>) {
      work(*object_);
      publish();
    } else {
      auto result = work(*object_);
      publish();
      return result;
    }
  }

  // For calls that may go beside others.
  Object& beside() { return *object_; }

  Shown shown() const {
    const std::scoped_lock instant(shown_mutex_);
    return shown_;
  }

 private:
  void publish() {
    Shown shown = show_(*object_);
    const std::scoped_lock instant(shown_mutex_);
    shown_ = std::move(shown);
  }

  std::unique_ptr<Object> object_;
  Shown (*show_)(const Object&);
  CallLock calls_{"scout, tracker"};  // held by a call
  mutable std::mutex shown_mutex_;    // of what follows, for an instant
  Shown shown_;
};

}  // namespace edgescout::python
