// Keeps an output folder for one program at a time.
//
// The system frees the lock when its holder ends, however it ends. On NFS the lock holds between
// machines (Linux sends it to the server); there a machine that dies keeps it until the server
// gives up waiting for it, 90 seconds with NFS 4.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace edgescout {

class FolderLock {
 public:
  // Creates the folder and its parents where needed. Removes what killed runs left in it, and in
  // `levels` levels of folders in it (remove_abandoned_files), at any age: nobody else writes there
  // now. On a file system without locks a warning is logged and nothing is locked.
  // InputError: another program holds the folder (the line names its process and machine), or the
  // folder cannot be created or written.
  explicit FolderLock(const std::filesystem::path& folder, int levels = 0);
  // Removes the lock's file, and folders that the constructor created and that are still empty.
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  std::filesystem::path folder_;
  std::filesystem::path created_;  // the uppermost folder that was made; empty: none
  int descriptor_ = -1;
};

// Returns who holds the folder: "process 17 on host cell3". Nothing: nobody.
std::optional<std::string> holder_of(const std::filesystem::path& folder);

}  // namespace edgescout
