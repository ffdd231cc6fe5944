// libFuzzer's entry. `edgescout_fuzz --reader=NAME CORPUS_FOLDER..`; scripts/fuzz.sh runs it.
#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <string_view>

#include "tests/fuzz/readers.h"

namespace edgescout::test {

namespace {

const FuzzedReader* chosen = nullptr;

void choose(std::string_view name) {
  const auto readers = fuzzed_readers();
  const auto found = std::ranges::find(readers, name, &FuzzedReader::name);
  if (found != readers.end()) {
    chosen = &*found;
    return;
  }
  std::cerr << "--reader: found " << (name.empty() ? "none" : name) << ", expected one of:";
  for (const FuzzedReader& reader : readers) std::cerr << ' ' << reader.name;
  std::cerr << '\n';
  std::exit(2);
}

}  // namespace

}  // namespace edgescout::test

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  constexpr std::string_view option = "--reader=";
  std::string_view name;
  for (int i = 1; i < *argc; ++i)
    if (std::string_view((*argv)[i]).starts_with(option))
      name = std::string_view((*argv)[i]).substr(option.size());
  edgescout::test::choose(name);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  edgescout::test::read_bytes(*edgescout::test::chosen, {data, size});
  return 0;
}
