#include "host/io/files.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <sstream>
#include <utility>

#include "kernels/error.h"

namespace edgescout {

namespace fs = std::filesystem;

namespace {

std::string reason(int error) { return std::strerror(error); }

// Returns a name in the folder of `file` that no other writer uses now. It may exist already, left
// by a killed run: in a container every run has the same process id.
fs::path temporary_beside(const fs::path& file) {
  static std::atomic<unsigned> counter{0};
  std::ostringstream name;
  name << '.' << file.filename().string() << '.' << ::getpid() << '-' << counter++ << ".part";
  return file.parent_path() / name.str();
}

}  // namespace

// An open temporary file in the folder of `file`. It is deleted unless it is renamed to its target.
// A lock marks it as in use; the system drops the lock when the process ends, however it ends.
class TemporaryFile {
 public:
  explicit TemporaryFile(const fs::path& file) {
    do {
      path_ = temporary_beside(file);
      descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (descriptor_ < 0 && errno == EEXIST);
    created_ = descriptor_ >= 0;
    if (created_) ::flock(descriptor_, LOCK_EX | LOCK_NB);
    error_ = created_ ? 0 : errno;
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (created_ && !renamed_) ::unlink(path_.c_str());
  }

  // Each returns 0 or the errno of the first failure. After a failure the functions do nothing.
  int write(std::string_view content) {
    while (!error_ && !content.empty()) {
      const ssize_t written = ::write(descriptor_, content.data(), content.size());
      if (written >= 0)
        content.remove_prefix(static_cast<std::size_t>(written));
      else if (errno != EINTR)
        error_ = errno;
    }
    return error_;
  }
  int flush() {
    if (!error_ && ::fsync(descriptor_) != 0) error_ = errno;
    return error_;
  }
  int rename_to(const fs::path& target) {
    if (!error_ && ::close(std::exchange(descriptor_, -1)) != 0) error_ = errno;
    if (!error_ && ::rename(path_.c_str(), target.c_str()) != 0) error_ = errno;
    renamed_ = !error_;
    return error_;
  }

 private:
  fs::path path_;
  int descriptor_ = -1;
  int error_ = 0;
  bool created_ = false;
  bool renamed_ = false;
};

namespace {

bool is_locked(const fs::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return true;  // not to be touched
  const bool locked = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0;
  ::close(descriptor);
  return locked;
}

// Writes in `where`. InputError about `folder`: that fails.
void require_writable(const fs::path& where, const fs::path& folder) {
  TemporaryFile probe(where / "probe");
  probe.write("x");
  if (const int error = probe.flush())
    throw InputError(folder.string(), "output folder", reason(error),
                     "a folder that can be written");
}

void require_written(const fs::path& file, int error) {
  if (error)
    throw InputError(file.string(), "output file", reason(error), "a file that can be written");
}

}  // namespace

std::ifstream open_file(const fs::path& file) {
  std::error_code unknown;  // opening the file reports the error
  if (fs::is_directory(file, unknown))
    throw InputError(file.string(), "file", "a folder", "a readable file");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError(file.string(), "file", reason(errno), "a readable file");
  return stream;
}

std::string read_file(const fs::path& file) {
  const std::ifstream stream = open_file(file);
  std::ostringstream content;
  content << stream.rdbuf();
  if (stream.bad() || content.bad())
    throw InputError(file.string(), "file", "a read error", "a readable file");
  std::string text = std::move(content).str();
  if (text.starts_with("version https://git-lfs.github.com/spec/"))
    throw InputError(file.string(), "file", "a pointer of Git LFS", "its content (git lfs pull)");
  return text;
}

void write_file_atomically(const fs::path& file, std::string_view content, Flush flush) {
  write_parts_atomically(file, {content}, flush);
}

void write_parts_atomically(const fs::path& file, std::initializer_list<std::string_view> parts,
                            Flush flush) {
  AtomicFile whole(file);
  for (const std::string_view part : parts) whole.write(part);
  whole.finish(flush);
}

AtomicFile::AtomicFile(fs::path file)
    : file_(std::move(file)), temporary_(std::make_unique<TemporaryFile>(file_)) {}

AtomicFile::~AtomicFile() = default;

void AtomicFile::write(std::string_view part) { require_written(file_, temporary_->write(part)); }

void AtomicFile::finish(Flush flush) {
  if (flush == Flush::Yes) require_written(file_, temporary_->flush());
  require_written(file_, temporary_->rename_to(file_));
}

void remove_earlier_files(std::span<const fs::path> files) {
  for (const fs::path& file : files) {
    std::error_code failure;
    fs::remove(file, failure);
    if (failure)
      throw InputError(file.string(), "file of an earlier run", failure.message(),
                       "one that can be removed");
  }
}

void require_writable_place(const fs::path& folder) {
  std::error_code missing;
  fs::path there = fs::weakly_canonical(fs::absolute(folder, missing), missing);
  if (folder.empty() || there.empty())
    throw InputError(folder.string(), "output folder",
                     folder.empty() ? "no name" : missing.message(),
                     "a folder that can be created");
  while (!fs::exists(there, missing) && there.has_relative_path()) there = there.parent_path();
  require_writable(there, folder);
}

void remove_abandoned_files(const fs::path& folder, std::chrono::seconds least_age) {
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with('.') || !name.ends_with(".part") || !entry.is_regular_file(ignored))
      continue;
    const auto age = fs::file_time_type::clock::now() - entry.last_write_time(ignored);
    if (age >= least_age && !is_locked(entry.path())) fs::remove(entry.path(), ignored);
  }
}

void require_writable_folder(const fs::path& folder) {
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (failure)
    throw InputError(folder.string(), "output folder", failure.message(),
                     "a folder that can be created");
  require_writable(folder, folder);
  remove_abandoned_files(folder);
}

}  // namespace edgescout
