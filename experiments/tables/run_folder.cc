#include "experiments/tables/run_folder.h"

#include <fcntl.h>
#include <stdio.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "wpg/files/sha256.h"
#include "wpg/files/whole_file.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void Fail(const std::string& what, const fs::path& path, int error) {
  throw std::runtime_error(path.string() + ": " + what + ": " + std::strerror(error));
}

// Sets errno; EINVAL where the file system (NFS) knows no flags.
bool Rename(const fs::path& from, const fs::path& to, unsigned flags) {
  return renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), flags) == 0;
}

bool IsThere(const fs::path& path) { return fs::exists(fs::symlink_status(path)); }

// Gives `from` the name `to`, which nothing has; false when something has it.
bool TakeName(const fs::path& from, const fs::path& to) {
  if (Rename(from, to, RENAME_NOREPLACE)) return true;
  int reason = errno;
  if (reason == EINVAL) {
    if (IsThere(to)) return false;
    if (Rename(from, to, 0)) return true;
    reason = errno;
  }
  if (reason == EEXIST || reason == ENOTEMPTY) return false;
  Fail("cannot be given its name", to, reason);
}

bool IsRun(const fs::path& path) {
  return fs::is_directory(fs::symlink_status(path)) && fs::exists(path / "manifest.json");
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
  if (Rename(aside, from, 0)) return;
  std::error_code ignored;
  fs::remove_all(aside, ignored);
}

}  // namespace

RunFolder::RunFolder(fs::path path, bool overwrite, bool tidy)
    : path_(fs::absolute(std::move(path)).lexically_normal()), overwrite_(overwrite) {
  if (!path_.has_filename()) path_ = path_.parent_path();  // a trailing slash
  if (IsThere(path_)) CheckReplaceable();
  std::error_code error;
  fs::create_directories(path_.parent_path(), error);
  if (error) Fail("cannot make the folder", path_.parent_path(), error.value());
  if (tidy) RemoveAbandonedSiblings(path_.parent_path(), path_.filename().string());
  staging_.emplace(path_, PartialSibling::Kind::kFolder);
}

void RunFolder::CheckReplaceable() const {
  if (fs::is_symlink(fs::symlink_status(path_))) {
    throw std::runtime_error(path_.string() +
                             ": is a link, which is not followed (name the folder itself)");
  }
  if (!overwrite_) {
    throw std::runtime_error(path_.string() + ": is there already (--overwrite replaces it)");
  }
  if (!IsRun(path_)) {
    throw std::runtime_error(path_.string() + ": is not a run folder, so it is not overwritten");
  }
}

void RunFolder::Write(const std::string& relative, std::string_view content) {
  WriteParts(relative, [content](const TextSink& add) { add(content); });
}

void RunFolder::WriteParts(const std::string& relative,
                           const std::function<void(const TextSink&)>& write) {
  const fs::path target = staging() / relative;
  std::error_code error;
  fs::create_directories(target.parent_path(), error);
  const fs::path shown = path_ / relative;
  if (error) Fail("cannot make its folder", shown, error.value());
  fs::remove(target, error);  // of the older run
  if (error) Fail("cannot be written", shown, error.value());
  SyncedFile file(target, shown);
  Sha256Hash hash;
  size_t bytes = 0;
  write([&](std::string_view part) {
    file.Add(part);
    hash.Add(part);
    bytes += part.size();
  });
  file.Sync();
  written_[relative] = {relative, shown.string(), bytes, hash.FinishHex()};
}

void RunFolder::CopyOlder() {
  for (auto entry = fs::recursive_directory_iterator(path_);
       entry != fs::recursive_directory_iterator(); ++entry) {
    const fs::path relative = entry->path().lexically_relative(path_);
    const fs::file_type type = entry->symlink_status().type();
    std::error_code error;
    if (type == fs::file_type::directory) {
      fs::create_directory(staging() / relative, error);
      if (error) Fail("cannot make its folder", path_ / relative, error.value());
    } else if (type == fs::file_type::regular) {
      CopySynced(entry->path(), staging() / relative, path_ / relative);
    } else {
      throw std::runtime_error(entry->path().string() +
                               ": is a link, a pipe or a device: a run that holds one is not "
                               "rewritten");
    }
  }
}

void RunFolder::Publish() {
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(staging())) {
    if (entry.is_directory()) SyncFolder(entry.path(), path_);
  }
  SyncFolder(staging(), path_);
  if (TakeName(staging(), path_)) {
    staging_->Release();
  } else {
    CheckReplaceable();
    Exchange(staging(), path_);
    if (IsThere(staging()) &&
        !IsRun(staging())) {  // something else took the name after it was looked at
      Exchange(staging(), path_);
      CheckReplaceable();
    }
  }
  SyncFolder(path_.parent_path(), path_);
  staging_.reset();  // removes the older run
}

}  // namespace halfstep
