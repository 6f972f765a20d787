#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <filesystem>

namespace halfstep {

/// Owns a file descriptor and closes it when destroyed.
class Descriptor {
 public:
  /// Opens the file as open(2) does, with O_CLOEXEC; a new file is readable by all. get() is −1,
  /// and errno set, when the file cannot be opened.
  Descriptor(const std::filesystem::path& path, int flags)
      : fd_(open(path.c_str(), flags | O_CLOEXEC, 0644)) {}
  ~Descriptor() {
    if (fd_ >= 0) close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int get() const { return fd_; }  ///< −1: none

 private:
  int fd_;
};

}  // namespace halfstep
