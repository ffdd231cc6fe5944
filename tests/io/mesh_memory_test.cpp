// The readers of meshes within their limit: 64 n + 64 MiB for a file of n bytes.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <new>

#include "host/io/mesh.h"
#include "kernels/error.h"
#include "tests/io/sample_meshes.h"
#include "tests/io/temporary_folder.h"

namespace edgescout::test {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool is_sanitized = true;  // its memory is no measure
#else
constexpr bool is_sanitized = false;
#endif

std::size_t address_space_bytes() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * std::size_t(::sysconf(_SC_PAGESIZE));
}

enum Ended { Read, Refused, OutOfMemory };

// Loads the file in a process that may ask for this much more memory.
Ended load_within(const std::filesystem::path& file, std::size_t bytes) {
  const pid_t child = ::fork();
  if (child == 0) {
    const rlimit limit{address_space_bytes() + bytes, RLIM_INFINITY};
    ::setrlimit(RLIMIT_AS, &limit);
    try {
      load_mesh(file, LengthUnit::Millimetre);
      ::_exit(Read);
    } catch (const InputError&) {
      ::_exit(Refused);
    } catch (const std::bad_alloc&) {
      ::_exit(OutOfMemory);
    }
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? Ended(WEXITSTATUS(status)) : OutOfMemory;
}

std::string many(const std::string& row, std::size_t bytes) {
  std::string text;
  while (text.size() < bytes) text += row;
  return text;
}

constexpr std::size_t FILE_BYTES = 1 << 20;

// Rows that take the fewest bytes of a file for what is made of them.
TEST(MeshMemory, OfDenseFilesIsBounded) {
  if (is_sanitized) GTEST_SKIP() << "measured without sanitizers";
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n",
                    ply_head =
                        "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty char "
                        "x\nproperty char y\n"
                        "property char z\nelement face ";
  const std::string ply_rows = "\nproperty list uchar uchar vertex_indices\nend_header\n" +
                               std::string("\0\0\0\1\0\0\0\1\0", 9);
  const std::vector<std::pair<std::string, std::string>> files{
      {"empty.ply", ply_head + "1000000" + ply_rows + std::string(1'000'000, '\0')},
      {"faces.ply", ply_head + "250000" + ply_rows + many({3, 0, 1, 2}, 1'000'000)},
      {"faces.obj", vertices + many("f 1 2 3\n", FILE_BYTES)},
      {"vertices.obj", many("v 0 0 0\n", FILE_BYTES) + "f 1 2 3\n"},
      {"polygons.obj", vertices + many("f" + many(" 1 2 3", 90) + "\n", FILE_BYTES)},
      {"a.stl", many("solid\nfacet outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop "
                     "endfacet\nendsolid\n",
                     FILE_BYTES)},
      {"rings.cao", "V1\n3\n0 0 0\n0 0 1\n1 0 0\n0\n0\n0\n1000\n" + many("0 1 1\n", 6000)},
  };
  const TemporaryFolder folder;
  for (const auto& [name, content] : files)
    EXPECT_NE(load_within(folder.write(name, content), 64 * content.size() + (64u << 20)),
              OutOfMemory)
        << name;
}

// Counts that a small file cannot keep.
TEST(MeshMemory, OfCountsThatLieIsBounded) {
  if (is_sanitized) GTEST_SKIP() << "measured without sanitizers";
  const TemporaryFolder folder;
  std::string stl = binary_stl(box(1, 2, 3), 80'000'000), ply = ascii_ply(box(1, 2, 3));
  ply.replace(ply.find("vertex 8"), 8, "vertex 99000000");
  const std::vector<std::pair<std::string, std::string>> files{
      {"a.stl", stl},
      {"a.ply", ply},
      {"a.off", "OFF\n99000000 99000000 0\n0 0 0\n"},
      {"a.cao", "V1\n99000000\n0 0 0\n"},
      {"b.cao", "V1\n0\n0\n0\n1\n99000000\n"},
  };
  for (const auto& [name, content] : files)
    EXPECT_EQ(load_within(folder.write(name, content), 64u << 20), Refused) << name;
}

}  // namespace
}  // namespace edgescout::test
