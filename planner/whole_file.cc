#include "planner/whole_file.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>

namespace halfstep {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void Fail(const fs::path& path, int error) {
  throw std::runtime_error(path.string() + ": cannot be written: " + std::strerror(error));
}

std::string Prefix(const fs::path& path) { return "." + path.filename().string() + ".partial-"; }

}  // namespace

void WriteSynced(const fs::path& path, const std::vector<std::string_view>& parts,
                 const fs::path& shown) {
  const int fd = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (fd < 0) Fail(shown, errno);
  for (std::string_view content : parts) {
    while (!content.empty()) {
      const ssize_t n = write(fd, content.data(), content.size());
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) {
        const int reason = errno;
        close(fd);
        Fail(shown, reason);
      }
      content.remove_prefix(static_cast<size_t>(n));
    }
  }
  const int synced = fsync(fd);
  const int reason = errno;
  if (close(fd) != 0 || synced != 0) Fail(shown, synced != 0 ? reason : errno);
}

void WriteWhole(const fs::path& path, const std::vector<std::string_view>& parts) {
  static std::atomic<unsigned> counter{0};
  std::error_code error;
  if (path.has_parent_path()) fs::create_directories(path.parent_path(), error);
  if (error) Fail(path.parent_path(), error.value());
  RemoveAbandonedSiblings(path);
  const fs::path partial = PartialSibling(path).string() + "-" + std::to_string(counter++);
  try {
    WriteSynced(partial, parts, path);
  } catch (...) {
    unlink(partial.c_str());
    throw;
  }
  if (rename(partial.c_str(), path.c_str()) != 0) {
    const int reason = errno;
    unlink(partial.c_str());
    Fail(path, reason);
  }
}

fs::path PartialSibling(const fs::path& path) {
  return path.parent_path() / (Prefix(path) + std::to_string(getpid()));
}

void RemoveAbandonedSiblings(const fs::path& path) {
  const std::string prefix = Prefix(path);
  const fs::path folder = path.has_parent_path() ? path.parent_path() : ".";
  std::error_code ignored;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(prefix)) continue;
    pid_t pid = 0;
    std::from_chars(name.data() + prefix.size(), name.data() + name.size(), pid);
    if (pid > 0 && kill(pid, 0) != 0 && errno == ESRCH) fs::remove_all(entry.path(), ignored);
  }
}

}  // namespace halfstep
