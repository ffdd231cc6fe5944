// Every reader on its saved corpus, which libFuzzer has found (scripts/fuzz.sh), and, under the
// address sanitizer, on damaged files of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

#include "tests/fuzz/memory_limit.h"
#include "tests/fuzz/readers.h"

namespace edgescout::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::vector<Bytes> corpus_of(const FuzzedReader& reader) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(EDGESCOUT_CORPUS) / reader.name))
    files.push_back(entry.path());
  std::ranges::sort(files);
  std::vector<Bytes> corpus;
  for (const auto& file : files) {
    std::ifstream stream(file, std::ios::binary);
    corpus.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  return corpus;
}

// A few bytes replaced, a piece taken out or put twice, or the rest of another file.
Bytes damaged(const std::vector<Bytes>& corpus, std::mt19937& random) {
  const auto below = [&](std::size_t end) { return random() % std::max<std::size_t>(end, 1); };
  Bytes bytes = corpus[below(corpus.size())];
  for (std::size_t times = 1 + below(4); times > 0 && !bytes.empty(); --times) {
    const auto from = bytes.begin() + static_cast<std::ptrdiff_t>(below(bytes.size()));
    const auto to = from + static_cast<std::ptrdiff_t>(below(64) % (bytes.end() - from));
    const Bytes piece(from, to), &other = corpus[below(corpus.size())];
    switch (below(4)) {
      case 0:
        *from = static_cast<std::uint8_t>(random());
        break;
      case 1:
        bytes.erase(from, to);
        break;
      case 2:
        bytes.insert(from, piece.begin(), piece.end());
        break;
      default:
        bytes.erase(from, bytes.end());
        bytes.insert(bytes.end(), other.begin() + static_cast<std::ptrdiff_t>(below(other.size())),
                     other.end());
    }
  }
  return bytes;
}

class Corpus : public testing::TestWithParam<FuzzedReader> {};

TEST_P(Corpus, IsReadOrRefusedInOneLine) {
  const std::vector<Bytes> corpus = corpus_of(GetParam());
  ASSERT_FALSE(corpus.empty());
  for (const Bytes& bytes : corpus) EXPECT_NO_THROW(read_bytes(GetParam(), bytes));
}

// The cases come in the same order every time; how many there are depends on the machine.
TEST_P(Corpus, IsReadOrRefusedWhenDamaged) {
  if (!counts_memory) GTEST_SKIP() << "needs the address sanitizer";
  constexpr std::clock_t enough = 2 * CLOCKS_PER_SEC;
  const std::vector<Bytes> corpus = corpus_of(GetParam());
  std::mt19937 random(7);
  for (const std::clock_t start = std::clock(); std::clock() - start < enough;)
    ASSERT_NO_THROW(read_bytes(GetParam(), damaged(corpus, random)));
}

INSTANTIATE_TEST_SUITE_P(Readers, Corpus,
                         testing::ValuesIn(fuzzed_readers().begin(), fuzzed_readers().end()),
                         [](const auto& reader) { return std::string(reader.param.name); });

}  // namespace
}  // namespace edgescout::test
