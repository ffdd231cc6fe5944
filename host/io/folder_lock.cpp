#include "host/io/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>

#include "host/core/log.h"
#include "host/core/option_names.h"
#include "host/io/files.h"
#include "kernels/error.h"

namespace edgescout {

namespace fs = std::filesystem;

namespace {

fs::path lock_file(const fs::path& folder) { return folder / ".edgescout.lock"; }

std::string this_process() {
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  return "process " + std::to_string(::getpid()) + " on host " + host.data();
}

std::string holder_in(int descriptor) {
  std::array<char, 512> text{};
  const ssize_t length = ::pread(descriptor, text.data(), text.size(), 0);
  return length > 0 ? std::string(text.data(), std::size_t(length)) : "another program";
}

// Returns whether the descriptor's file still has its name. A holder removes the file when it ends.
bool is_still(const fs::path& file, int descriptor) {
  struct stat opened {
  }, named{};
  return ::fstat(descriptor, &opened) == 0 && ::stat(file.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

[[noreturn]] void refuse(const fs::path& folder, int error) {
  throw InputError(folder.string(), "output folder", std::strerror(error),
                   "a folder that can be written");
}

// Returns the uppermost folder that had to be made; empty: all existed.
fs::path create_folders(const fs::path& folder) {
  std::error_code failure;
  fs::path made;
  for (fs::path at = fs::absolute(folder).lexically_normal(); !fs::exists(at, failure);
       at = at.parent_path())
    made = at;
  fs::create_directories(folder, failure);
  if (failure)
    throw InputError(folder.string(), "output folder", failure.message(),
                     "a folder that can be created");
  return made;
}

// Removes empty folders from `folder` up to `uppermost`.
void remove_empty(fs::path folder, const fs::path& uppermost) {
  if (uppermost.empty()) return;
  folder = fs::absolute(folder).lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();
  while (::rmdir(folder.c_str()) == 0 && folder != uppermost) folder = folder.parent_path();
}

// Leaves folders alone that another program holds.
void remove_abandoned_below(const fs::path& folder, int levels) {
  remove_abandoned_files(folder, std::chrono::seconds(0));
  if (levels == 0) return;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
    if (entry.is_directory(ignored) && !entry.is_symlink(ignored) && !holder_of(entry.path()))
      remove_abandoned_below(entry.path(), levels - 1);
}

// Returns a descriptor that holds the lock of the named file. InputError: another program has it.
int locked(const fs::path& folder) {
  const fs::path file = lock_file(folder);
  while (true) {
    const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0) refuse(folder, errno);
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) {
      if (is_still(file, descriptor)) return descriptor;
    } else if (errno == EWOULDBLOCK) {
      const std::string holder = holder_in(descriptor);
      ::close(descriptor);
      throw InputError(
          folder.string(), "output folder", "it in use by " + holder,
          "one that no other program writes (wait for it, or another " + option_name("out") + ")");
    } else {
      log(LogLevel::Warning,
          folder.string() + ": output folder: found a file system without locks (" +
              std::strerror(errno) +
              "), expected one with them: a second program would not be refused");
      return descriptor;
    }
    ::close(descriptor);
  }
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder, int levels) : folder_(folder) {
  created_ = create_folders(folder);
  descriptor_ = locked(folder);
  const std::string holder = this_process();
  // What it says is for people; the lock holds without it, as on a full disk.
  if (::ftruncate(descriptor_, 0) != 0 ||
      ::pwrite(descriptor_, holder.data(), holder.size(), 0) < 0)
    log(LogLevel::Debug, lock_file(folder).string() + ": " + std::strerror(errno));
  remove_abandoned_below(folder, levels);
}

FolderLock::~FolderLock() {
  ::unlink(lock_file(folder_).c_str());  // before the lock is freed: the next one makes its own
  ::close(descriptor_);
  remove_empty(folder_, created_);
}

std::optional<std::string> holder_of(const fs::path& folder) {
  const int descriptor = ::open(lock_file(folder).c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return {};
  std::optional<std::string> holder;
  if (::flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    holder = holder_in(descriptor);
  ::close(descriptor);
  return holder;
}

}  // namespace edgescout
