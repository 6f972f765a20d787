#include "experiments/run_folder.h"

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace halfstep {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void Fail(const std::string& what, const fs::path& path, int error) {
  throw std::runtime_error(path.string() + ": " + what + ": " + std::strerror(error));
}

void Sync(const fs::path& folder) {
  const int fd = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd < 0) return;
  fsync(fd);  // some file systems cannot sync a folder; the rename is atomic all the same
  close(fd);
}

std::string StagingPrefix(const fs::path& path) {
  return "." + path.filename().string() + ".partial-";
}

// Folders that killed runs of the same name left behind: those whose process is gone.
void RemoveAbandoned(const fs::path& path) {
  const std::string prefix = StagingPrefix(path);
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(path.parent_path(), ignored)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(prefix)) continue;
    pid_t pid = 0;
    std::from_chars(name.data() + prefix.size(), name.data() + name.size(), pid);
    if (pid > 0 && kill(pid, 0) != 0 && errno == ESRCH) fs::remove_all(entry.path(), ignored);
  }
}

}  // namespace

RunFolder::RunFolder(fs::path path, bool overwrite)
    : path_(fs::absolute(std::move(path)).lexically_normal()) {
  if (!path_.has_filename()) path_ = path_.parent_path();  // a trailing slash
  if (fs::exists(fs::symlink_status(path_))) {
    if (!overwrite) {
      throw std::runtime_error(path_.string() + ": is there already (--overwrite replaces it)");
    }
    if (!fs::exists(path_ / "manifest.json")) {
      throw std::runtime_error(path_.string() + ": is not a run folder, so it is not overwritten");
    }
  }
  std::error_code error;
  fs::create_directories(path_.parent_path(), error);
  if (error) Fail("cannot make the folder", path_.parent_path(), error.value());
  RemoveAbandoned(path_);
  staging_ = path_.parent_path() / (StagingPrefix(path_) + std::to_string(getpid()));
  fs::remove_all(staging_, error);
  if (!fs::create_directory(staging_, error))
    Fail("cannot make the folder", staging_, error.value());
}

RunFolder::~RunFolder() {
  std::error_code ignored;
  if (!published_) fs::remove_all(staging_, ignored);
}

void RunFolder::Write(const std::string& relative, std::string_view content) {
  const fs::path target = staging_ / relative;
  std::error_code error;
  fs::create_directories(target.parent_path(), error);
  const fs::path shown = path_ / relative;
  if (error) Fail("cannot make its folder", shown, error.value());
  const int fd = open(target.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (fd < 0) Fail("cannot be written", shown, errno);
  while (!content.empty()) {
    const ssize_t n = write(fd, content.data(), content.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      const int reason = errno;
      close(fd);
      Fail("cannot be written", shown, reason);
    }
    content.remove_prefix(static_cast<size_t>(n));
  }
  const int synced = fsync(fd);
  const int reason = errno;
  if (close(fd) != 0 || synced != 0) Fail("cannot be written", shown, synced != 0 ? reason : errno);
}

void RunFolder::Publish() {
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(staging_)) {
    if (entry.is_directory()) Sync(entry.path());
  }
  Sync(staging_);
  if (fs::exists(path_)) {
    // The older run and the new one change places in one step.
    if (renameat2(AT_FDCWD, staging_.c_str(), AT_FDCWD, path_.c_str(), RENAME_EXCHANGE) != 0) {
      Fail("cannot replace the older run", path_, errno);
    }
    fs::remove_all(staging_);
  } else if (renameat2(AT_FDCWD, staging_.c_str(), AT_FDCWD, path_.c_str(), RENAME_NOREPLACE) !=
             0) {
    Fail("cannot be given its name", path_, errno);
  }
  published_ = true;
  Sync(path_.parent_path());
}

}  // namespace halfstep
