// Structs of the caller, which may be of an older or a newer header: struct_size says which.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

#include "host/bindings/c/src/status.h"

namespace edgescout::c {

// The sizes that a struct had in earlier headers of this ABI, by which it grew.
template <typename Struct>
inline constexpr std::initializer_list<std::size_t> earlier_sizes{};
template <>
inline constexpr std::initializer_list<std::size_t> earlier_sizes<edgescout_view>{
    offsetof(edgescout_view, depth)};
template <>
inline constexpr std::initializer_list<std::size_t> earlier_sizes<edgescout_shot>{
    offsetof(edgescout_shot, depth)};
template <>
inline constexpr std::initializer_list<std::size_t> earlier_sizes<edgescout_frame>{
    offsetof(edgescout_frame, depth), offsetof(edgescout_frame, limit)};
// It has a frame inside: what lies behind that moved (tracker.cpp).
inline constexpr std::size_t search_size_with(std::size_t frame_size) {
  return sizeof(edgescout_search) - sizeof(edgescout_frame) + frame_size;
}
template <>
inline constexpr std::initializer_list<std::size_t> earlier_sizes<edgescout_search>{
    search_size_with(offsetof(edgescout_frame, depth)),
    search_size_with(offsetof(edgescout_frame, limit))};

// A newer struct ends below: a larger number is none of a size.
inline constexpr std::size_t LARGEST_STRUCT = 1 << 16;

template <typename Struct>
std::size_t struct_size_of(const Struct* given, const char* name) {
  require(given, name);
  std::size_t size = 0;
  std::memcpy(&size, given, sizeof size);
  const auto& earlier = earlier_sizes<Struct>;
  const bool is_known = (size >= sizeof(Struct) && size <= LARGEST_STRUCT) ||
                        std::find(earlier.begin(), earlier.end(), size) != earlier.end();
  if (!is_known)
    refuse(EDGESCOUT_WRONG_VERSION, std::string(name) + ".struct_size", std::to_string(size),
           "the struct's size, which is " + std::to_string(sizeof(Struct)) + " in version " +
               EDGESCOUT_VERSION);
  return size;
}

// Refuses what only a newer header has: bytes from `begin` on that are not 0.
inline void require_zeros(const void* given, std::size_t begin, std::size_t end, const char* name) {
  const auto* const bytes = static_cast<const unsigned char*>(given);
  if (begin < end &&
      std::any_of(bytes + begin, bytes + end, [](unsigned char byte) { return byte != 0; }))
    refuse(EDGESCOUT_WRONG_VERSION, name, "fields that version " EDGESCOUT_VERSION " does not have",
           "0 in them");
}

// What the caller gave, with the rest 0. Fields that only a newer header has, or that have no
// meaning yet, must be 0.
template <typename Struct>
Struct read_struct(const Struct* given, const char* name) {
  const std::size_t size = struct_size_of(given, name);
  Struct result{};
  std::memcpy(&result, given, std::min(size, sizeof result));
  require_zeros(given, sizeof result, size, name);
  if constexpr (requires { result.reserved; })
    if (result.reserved != 0)
      refuse(EDGESCOUT_WRONG_VERSION, std::string(name) + ".reserved",
             std::to_string(result.reserved), "0");
  return result;
}

// The fields that the caller's header has; those that only a newer one has become 0.
template <typename Struct>
void write_struct(Struct value, Struct* to, const char* name) {
  const std::size_t size = struct_size_of(to, name);
  value.struct_size = size;
  std::memcpy(to, &value, std::min(size, sizeof value));
  auto* const bytes = reinterpret_cast<unsigned char*>(to);
  for (std::size_t i = sizeof value; i < size; ++i) bytes[i] = 0;
}

// An array of structs, all of one size. NULL with 0 of them is one.
template <typename Struct>
std::vector<Struct> read_structs(const Struct* given, std::size_t count, const char* name) {
  std::vector<Struct> result;
  if (count == 0) return result;
  require_count(count, name);
  const std::size_t size = struct_size_of(given, name);
  const auto* const bytes = reinterpret_cast<const unsigned char*>(given);
  for (std::size_t i = 0; i < count; ++i) {
    result.push_back(read_struct(reinterpret_cast<const Struct*>(bytes + i * size), name));
    if (result.back().struct_size != size)
      refuse(EDGESCOUT_WRONG_VERSION, std::string(name) + ".struct_size",
             std::to_string(result.back().struct_size),
             "that of the first, " + std::to_string(size));
  }
  return result;
}

}  // namespace edgescout::c
