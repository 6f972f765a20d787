#include "wpg/files/partial_sibling.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>

#include "wpg/files/leftovers.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMark = ".partial-";
constexpr std::string_view kOlder = "-older";  // beside a folder that takes an older one's place
constexpr size_t kDigits = 16;

std::string RandomDigits() {
  std::uint64_t bits = 0;
  if (getrandom(&bits, sizeof bits, 0) != sizeof bits) {
    throw std::runtime_error(std::string("no random numbers: ") + std::strerror(errno));
  }
  std::string digits(kDigits, '0');
  for (char& digit : digits) {
    digit = "0123456789abcdef"[bits & 15];
    bits >>= 4;
  }
  return digits;
}

// NAME of ".NAME.partial-<digits>", with or without "-older"; "" of other texts.
std::string_view NameOfPartial(std::string_view text) {
  if (text.ends_with(kOlder)) text.remove_suffix(kOlder.size());
  const size_t mark = text.rfind(kMark);
  if (!text.starts_with('.') || mark == std::string_view::npos) return "";
  const std::string_view digits = text.substr(mark + kMark.size());
  if (digits.size() != kDigits ||
      digits.find_first_not_of("0123456789abcdef") != std::string_view::npos) {
    return "";
  }
  return text.substr(1, mark - 1);
}

// Whether a lock that could be taken here says that no other machine holds it.
bool LocksAreKnownToAll(const fs::path& folder) {
  constexpr std::array<std::uint32_t, 10> kElsewhere = {
      0x6969,      // NFS
      0x517B,      // SMB
      0xFE534D42,  // SMB 2
      0xFF534D42,  // CIFS
      0x65735546,  // FUSE
      0x01021997,  // 9P
      0x00C36400,  // Ceph
      0x0BD00BD0,  // Lustre
      0x5346414F,  // AFS
      0x47504653,  // GPFS
  };
  struct statfs status {};
  if (statfs(folder.c_str(), &status) != 0) return false;
  const auto type = static_cast<std::uint32_t>(status.f_type);
  return std::find(kElsewhere.begin(), kElsewhere.end(), type) == kElsewhere.end();
}

// Whether the descriptor's file still has the path's name.
bool Names(const fs::path& path, int descriptor) {
  struct stat here {};
  struct stat there {};
  return fstat(descriptor, &here) == 0 && lstat(path.c_str(), &there) == 0 &&
         here.st_dev == there.st_dev && here.st_ino == there.st_ino;
}

void RemoveIfAbandoned(const fs::path& path) {
  const int fd = open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (fd < 0) return;
  std::error_code ignored;
  if (flock(fd, LOCK_EX | LOCK_NB) == 0 && Names(path, fd)) fs::remove_all(path, ignored);
  close(fd);
}

}  // namespace

PartialSibling::PartialSibling(const fs::path& path, Kind kind) {
  const std::string prefix = "." + path.filename().string() + std::string(kMark);
  while (true) {
    path_ = path.parent_path() / (prefix + RandomDigits());
    AddLeftover(path_);  // before it is there, so that no signal comes between
    if (Make(kind) && Lock()) return;
    const int reason = errno;
    ForgetLeftover(path_);
    if (descriptor_ >= 0) close(descriptor_);
    descriptor_ = -1;
    // Taken by chance, or removed by another process before it was locked: another name.
    if (reason == EEXIST || reason == EWOULDBLOCK || reason == ENOENT) {
      if (access(path.has_parent_path() ? path.parent_path().c_str() : ".", F_OK) == 0) continue;
    }
    throw std::runtime_error(path.string() + ": cannot be written: " + std::strerror(reason));
  }
}

PartialSibling::~PartialSibling() {
  std::error_code ignored;
  if (!released_) fs::remove_all(path_, ignored);
  ForgetLeftover(path_);
  if (descriptor_ >= 0) close(descriptor_);  // the lock goes last
}

// Sets errno when it cannot.
bool PartialSibling::Make(Kind kind) {
  if (kind == Kind::kFile) {
    descriptor_ = open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644);
    return descriptor_ >= 0;
  }
  if (mkdir(path_.c_str(), 0777) != 0) return false;
  descriptor_ = open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor_ >= 0) return true;
  const int reason = errno;
  rmdir(path_.c_str());
  errno = reason;
  return false;
}

// A file system that cannot lock is none where anything is removed.
bool PartialSibling::Lock() {
  if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0) return errno != EWOULDBLOCK;
  if (Names(path_, descriptor_)) return true;
  errno = ENOENT;
  return false;
}

void RemoveAbandonedSiblings(const fs::path& folder, std::string_view name) {
  const fs::path place = folder.empty() ? "." : folder;
  if (!LocksAreKnownToAll(place)) return;
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(place, ignored)) {
    const std::string found = entry.path().filename().string();
    const std::string_view of = NameOfPartial(found);
    if (of.empty() || (!name.empty() && of != name)) continue;
    // The only copy, when the process was killed between two renames.
    if (found.ends_with(kOlder) && !fs::exists(fs::symlink_status(place / of))) continue;
    RemoveIfAbandoned(entry.path());
  }
}

}  // namespace halfstep
