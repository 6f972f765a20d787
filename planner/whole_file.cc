#include "planner/whole_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace halfstep {
namespace {

[[noreturn]] void FailToWrite(const std::string& path, int error) {
  throw std::runtime_error(path + ": cannot be written: " + std::generic_category().message(error));
}

void WriteAll(int fd, std::string_view bytes, const std::string& path) {
  while (!bytes.empty()) {
    const ssize_t written = write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) FailToWrite(path, errno);
    bytes.remove_prefix(static_cast<size_t>(written));
  }
}

// Closes the file, and removes it unless it was renamed.
struct Temporary {
  std::string path;
  int fd = -1;
  bool kept = false;
  ~Temporary() {
    if (fd >= 0) close(fd);
    if (!kept && fd >= 0) unlink(path.c_str());
  }
};

}  // namespace

void WriteWholeFile(const std::string& path, const std::vector<std::string_view>& parts) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(path).parent_path();
  std::error_code error;
  if (!folder.empty()) fs::create_directories(folder, error);
  if (error) FailToWrite(folder.string(), error.value());
  static std::atomic<unsigned> counter{0};
  Temporary temporary{.path = path + "." + std::to_string(getpid()) + "." +
                              std::to_string(counter++) + ".tmp"};
  temporary.fd = open(temporary.path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (temporary.fd < 0) FailToWrite(temporary.path, errno);
  for (const std::string_view part : parts) WriteAll(temporary.fd, part, temporary.path);
  if (fsync(temporary.fd) != 0) FailToWrite(temporary.path, errno);
  if (rename(temporary.path.c_str(), path.c_str()) != 0) FailToWrite(path, errno);
  temporary.kept = true;
}

}  // namespace halfstep
