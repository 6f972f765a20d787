#include "tests/experiments/child_process.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <stdexcept>

namespace halfstep {

Child::Child(const std::vector<std::string>& arguments, const Options& options)
    : out_(memfd_create("out", MFD_CLOEXEC)), err_(memfd_create("err", MFD_CLOEXEC)) {
  // Another build of the command takes its place in the mutation table (tests/mutation).
  const char* const instead = std::getenv("HALFSTEP_COMMAND");
  std::vector<std::string> words = {instead != nullptr ? instead : CommandFile()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  pid_ = fork();
  if (pid_ < 0) throw std::runtime_error("cannot fork");
  if (pid_ > 0) return;
  dup2(options.standard_output >= 0 ? options.standard_output : out_, STDOUT_FILENO);
  dup2(options.standard_error >= 0 ? options.standard_error : err_, STDERR_FILENO);
  if (!options.working_directory.empty() && chdir(options.working_directory.c_str()) != 0) {
    _exit(kNotPossible);
  }
  for (const auto& [name, value] : options.environment) setenv(name.c_str(), value.c_str(), 1);
  if (options.before_exec && !options.before_exec()) _exit(kNotPossible);
  execv(argv[0], argv.data());
  _exit(kNotPossible);
}

Child::~Child() {
  if (pid_ > 0) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  close(out_);
  close(err_);
}

Outcome Child::Wait() {
  int status = 0;
  while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  return {.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1,
          .signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0,
          .out = Content(out_),
          .err = Content(err_)};
}

std::string Child::Content(int fd) {
  std::string text(static_cast<size_t>(lseek(fd, 0, SEEK_END)), '\0');
  lseek(fd, 0, SEEK_SET);
  const ssize_t n = read(fd, text.data(), text.size());
  text.resize(n < 0 ? 0 : static_cast<size_t>(n));
  return text;
}

Outcome Halfstep(const std::filesystem::path& working_directory,
                 const std::vector<std::string>& arguments) {
  return Child(arguments, {.working_directory = working_directory}).Wait();
}

std::string ShippedConfig(const std::string& name) {
  return InSources("experiments/configs/") + name + ".yaml";
}

}  // namespace halfstep
