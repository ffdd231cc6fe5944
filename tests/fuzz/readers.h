// The readers of files, as functions that are given any bytes: by libFuzzer (fuzz_main.cpp) and,
// from the saved corpus, by an ordinary test (corpus_test.cpp).
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace edgescout::test {

struct FuzzedReader {
  const char* name;       // also of its folder in corpus/
  const char* file_name;  // of the file that holds the bytes
  void (*read)(const std::filesystem::path& file);
  // Whether a header states length and checksum of the rest. They are set right, for a wrong one
  // would keep every byte after it from being read.
  bool has_checksum = false;
};

std::span<const FuzzedReader> fuzzed_readers();

// Lets the reader read a file of these bytes. LogicError where it does anything but accept them or
// refuse them with one line that names the file. With the address sanitizer, a reader that holds
// more than 64 bytes for each given byte and 64 MiB ends the process.
void read_bytes(const FuzzedReader& reader, std::span<const std::uint8_t> bytes);

}  // namespace edgescout::test
