#include "experiments/sweep/worker_processes.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <thread>

namespace halfstep {
namespace {

struct Worker {
  pid_t pid = -1;
  size_t index = 0;
  std::chrono::steady_clock::time_point begin;
};

// Between fork and exec only what is safe there: this process has other threads.
pid_t Start(const std::vector<std::string>& arguments) {
  std::vector<std::string> words = {"halfstep"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid < 0) throw std::runtime_error(std::string("no process: ") + std::strerror(errno));
  if (pid > 0) return pid;
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);
  const int nothing = open("/dev/null", O_RDONLY | O_CLOEXEC);
  if (nothing >= 0) dup2(nothing, STDIN_FILENO);
  execv("/proc/self/exe", argv.data());
  _exit(127);
}

}  // namespace

void RunWorkers(const std::vector<std::vector<std::string>>& arguments, int jobs,
                const std::function<bool(size_t, const WorkerEnd&)>& ended,
                const std::function<void()>& waiting, std::stop_token stop) {
  std::vector<Worker> workers;
  size_t next = 0;
  bool go_on = true, told = false;
  while (true) {
    go_on = go_on && !stop.stop_requested();
    while (go_on && next < arguments.size() && std::ssize(workers) < jobs) {
      workers.push_back({Start(arguments[next]), next, std::chrono::steady_clock::now()});
      ++next;
    }
    if (workers.empty()) return;
    if (stop.stop_requested() && !told) {
      for (const Worker& worker : workers) kill(worker.pid, SIGTERM);
      told = true;
    }
    for (auto worker = workers.begin(); worker != workers.end();) {
      int status = 0;
      if (waitpid(worker->pid, &status, WNOHANG) != worker->pid) {
        ++worker;
        continue;
      }
      const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - worker->begin;
      const size_t index = worker->index;
      worker = workers.erase(worker);
      go_on = ended(index, {.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1,
                            .signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0,
                            .wall = wall.count()}) &&
              go_on;
    }
    waiting();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

}  // namespace halfstep
