#include "host/io/zip_archive.h"

#include <minizip/unzip.h>

#include <memory>
#include <type_traits>

#include "host/io/files.h"
#include "kernels/error.h"

namespace edgescout {

namespace {

struct Close {
  void operator()(unzFile archive) const { unzClose(archive); }
};

}  // namespace

std::string read_zipped(const std::filesystem::path& archive, const std::string& ending,
                        std::uintmax_t most_bytes) {
  open_file(archive);  // for its errors
  const auto require = [&](bool holds, const char* found) {
    if (!holds) throw InputError(archive.string(), "ZIP archive", found, "a whole archive");
  };
  const std::unique_ptr<std::remove_pointer_t<unzFile>, Close> zip(unzOpen64(archive.c_str()));
  require(zip != nullptr, "no directory of files");
  std::string all;
  std::uintmax_t bytes = 0;
  int state = unzGoToFirstFile(zip.get());
  for (; state == UNZ_OK; state = unzGoToNextFile(zip.get())) {
    unz_file_info64 info{};
    char name[256] = "";
    require(unzGetCurrentFileInfo64(zip.get(), &info, name, sizeof name - 1, nullptr, 0, nullptr,
                                    0) == UNZ_OK,
            "a damaged directory of files");
    bytes += info.uncompressed_size;
    if (bytes > most_bytes || info.uncompressed_size > most_bytes)
      throw InputError(archive.string(), "size",
                       "more than " + std::to_string(most_bytes >> 20) + " MiB when unpacked",
                       "a smaller file, or STL or PLY");
    if (!std::string_view(name).ends_with(ending)) continue;
    const std::size_t before = all.size(), size = info.uncompressed_size;
    all.resize(before + size);
    require(unzOpenCurrentFile(zip.get()) == UNZ_OK, "a file that cannot be unpacked");
    const int read =
        unzReadCurrentFile(zip.get(), all.data() + before, static_cast<unsigned>(size));
    require(read >= 0 && static_cast<std::size_t>(read) == size &&
                unzCloseCurrentFile(zip.get()) == UNZ_OK,
            "a file that is cut short or damaged");
  }
  require(state == UNZ_END_OF_LIST_OF_FILE, "a damaged directory of files");
  return all;
}

}  // namespace edgescout
