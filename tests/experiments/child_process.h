#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/places.h"

namespace halfstep {

/// How a process ended: `status` when it exited, else −1 and the signal that killed it.
struct Outcome {
  int status = -1;
  int signal = 0;
  std::string out, err;
};

/// The command `halfstep` as a child of its own.
class Child {
 public:
  struct Options {
    std::filesystem::path working_directory;
    int standard_output = -1;                ///< a file descriptor; −1: captured
    int standard_error = -1;                 ///< the same
    std::function<bool()> before_exec = {};  ///< in the child; false: exits with 77
    std::vector<std::pair<std::string, std::string>> environment = {};
  };
  static constexpr int kNotPossible = 77;

  Child(const std::vector<std::string>& arguments, const Options& options);
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  void Signal(int number) const { kill(pid_, number); }

  Outcome Wait();

 private:
  static std::string Content(int fd);

  pid_t pid_ = -1;
  int out_, err_;
};

/// Runs `halfstep` to its end in a working directory.
Outcome Halfstep(const std::filesystem::path& working_directory,
                 const std::vector<std::string>& arguments);

/// Path of a shipped config.
std::string ShippedConfig(const std::string& name);

}  // namespace halfstep
