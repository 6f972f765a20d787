#include "experiments/run_folder.h"

#include <fcntl.h>
#include <stdio.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "planner/whole_file.h"
#include "wpg/input/sha256.h"

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

// Sets errno; EINVAL where the file system (NFS) knows no flags.
bool Rename(const fs::path& from, const fs::path& to, unsigned flags) {
  return renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), flags) == 0;
}

bool IsThere(const fs::path& path) { return fs::exists(fs::symlink_status(path)); }

// Gives `from` the name `to`, which nothing has; false when something has it.
bool TakeName(const fs::path& from, const fs::path& to) {
  if (Rename(from, to, RENAME_NOREPLACE)) return true;
  if (errno == EINVAL && !IsThere(to) && Rename(from, to, 0)) return true;
  if (errno != EEXIST && !IsThere(to)) Fail("cannot be given its name", to, errno);
  return false;
}

// Lets `from` and `to` change places.
void Exchange(const fs::path& from, const fs::path& to) {
  if (Rename(from, to, RENAME_EXCHANGE)) return;
  const fs::path aside = from.string() + "-older";
  if (errno != EINVAL || !Rename(to, aside, 0)) Fail("cannot replace the older run", to, errno);
  if (!Rename(from, to, 0)) {
    const int reason = errno;
    Rename(aside, to, 0);
    Fail("cannot replace the older run", to, reason);
  }
  if (!Rename(aside, from, 0)) Fail("cannot remove the older run", aside, errno);
}

}  // namespace

RunFolder::RunFolder(fs::path path, bool overwrite)
    : path_(fs::absolute(std::move(path)).lexically_normal()), overwrite_(overwrite) {
  if (!path_.has_filename()) path_ = path_.parent_path();  // a trailing slash
  if (IsThere(path_)) CheckReplaceable();
  std::error_code error;
  fs::create_directories(path_.parent_path(), error);
  if (error) Fail("cannot make the folder", path_.parent_path(), error.value());
  RemoveAbandonedSiblings(path_);
  staging_ = PartialSibling(path_);
  fs::remove_all(staging_, error);
  if (!fs::create_directory(staging_, error))
    Fail("cannot make the folder", staging_, error.value());
}

void RunFolder::CheckReplaceable() const {
  if (!overwrite_) {
    throw std::runtime_error(path_.string() + ": is there already (--overwrite replaces it)");
  }
  if (!fs::exists(path_ / "manifest.json")) {
    throw std::runtime_error(path_.string() + ": is not a run folder, so it is not overwritten");
  }
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
  WriteSynced(target, {content}, shown);
  written_[relative] = {relative, shown.string(), content.size(), Sha256(content)};
}

void RunFolder::CopyOlder() {
  std::error_code error;
  fs::copy(path_, staging_, fs::copy_options::recursive, error);
  if (error) Fail("cannot be copied", path_, error.value());
}

void RunFolder::Publish() {
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(staging_)) {
    if (entry.is_directory()) Sync(entry.path());
  }
  Sync(staging_);
  if (!TakeName(staging_, path_)) {
    CheckReplaceable();
    Exchange(staging_, path_);
    std::error_code ignored;
    fs::remove_all(staging_, ignored);
  }
  published_ = true;
  Sync(path_.parent_path());
}

}  // namespace halfstep
