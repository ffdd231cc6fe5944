#include "host/bindings/c/src/status.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <new>

#include "host/active/scout.h"
#include "kernels/error.h"

namespace edgescout::c {

namespace {

// Without a constructor and in a fixed place: keeping a message cannot fail.
thread_local char last_message[2048] = "";

// The longest part of the text that ends with a whole letter of UTF-8, in so many bytes.
std::size_t whole_letters(const char* text, std::size_t size) noexcept {
  while (size > 0 && (static_cast<unsigned char>(text[size]) & 0xc0) == 0x80) --size;
  return size;
}

// In one line; what is too long ends in "...".
edgescout_status keep(edgescout_status status, const char* message) noexcept {
  constexpr std::size_t room = sizeof last_message - 1;
  constexpr char more[] = "...";
  std::size_t size = std::strlen(message);
  const bool is_cut = size > room;
  if (is_cut) size = whole_letters(message, room - std::strlen(more));
  std::memcpy(last_message, message, size);
  std::replace_if(
      last_message, last_message + size,
      [](unsigned char byte) { return byte < 0x20 || byte == 0x7f; }, ' ');
  std::strcpy(last_message + size, is_cut ? more : "");
  return status;
}

constexpr std::array<const char*, 11> status_names{
    "ok",        "null",   "bad handle", "wrong kind",    "busy",    "wrong version",
    "bad input", "device", "cancelled",  "out of memory", "internal"};

}  // namespace

void refuse(edgescout_status status, const std::string& name, const std::string& found,
            const std::string& expected) {
  throw Failure(status, name + ": found " + found + ", expected " + expected);
}

void require(const void* pointer, const char* name) {
  if (!pointer) refuse(EDGESCOUT_NULL, name, "NULL", "a pointer");
}

void require_index(std::size_t index, std::size_t count, const char* name) {
  if (index >= count)
    refuse(EDGESCOUT_BAD_INPUT, name, std::to_string(index), "below " + std::to_string(count));
}

void require_count(std::size_t count, const char* name) {
  constexpr std::size_t most = 1 << 28;
  if (count > most)
    refuse(EDGESCOUT_BAD_INPUT, name, std::to_string(count) + " items",
           "at most " + std::to_string(most));
}

edgescout_status status_of_exception() noexcept {
  try {
    throw;
  } catch (const Failure& failure) {
    return keep(failure.status(), failure.what());
  } catch (const InputError& error) {
    return keep(EDGESCOUT_BAD_INPUT, error.what());
  } catch (const GpuError& error) {
    return keep(EDGESCOUT_DEVICE, error.what());
  } catch (const Cancelled&) {
    return keep(EDGESCOUT_CANCELLED, "the limit of the call was over");
  } catch (const std::bad_alloc&) {
    return keep(EDGESCOUT_OUT_OF_MEMORY, "out of memory");
  } catch (const std::exception& error) {
    return keep(EDGESCOUT_INTERNAL, error.what());
  } catch (...) {
    return keep(EDGESCOUT_INTERNAL, "an exception of an unknown type");
  }
}

}  // namespace edgescout::c

using namespace edgescout::c;

const char* edgescout_last_error(void) { return last_message; }

const char* edgescout_status_name(edgescout_status status) {
  const bool is_known = status >= 0 && std::size_t(status) < status_names.size();
  return is_known ? status_names[std::size_t(status)] : "unknown";
}

const char* edgescout_version(void) { return EDGESCOUT_VERSION; }

int32_t edgescout_abi(void) { return EDGESCOUT_ABI; }

edgescout_status edgescout_require_abi(int32_t abi) {
  return guarded([&] {
    if (abi != EDGESCOUT_ABI)
      refuse(EDGESCOUT_WRONG_VERSION, "abi", std::to_string(abi),
             std::to_string(EDGESCOUT_ABI) + " of this library, " EDGESCOUT_VERSION);
  });
}
