#include "experiments/run/interrupt.h"

#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <ctime>
#include <optional>
#include <string_view>

#include "experiments/run/exit_status.h"
#include "wpg/files/leftovers.h"

namespace halfstep {
namespace {

using std::chrono::seconds;

sigset_t Signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  return signals;
}

void Rest(int /*signal*/) {
  while (true) pause();
}

// Files are whole at any moment, so what is left to be done is to remove partial ones. Nothing may
// write meanwhile, so the thread that made the guard rests.
[[noreturn]] void EndAtOnce(pthread_t maker, std::string_view sentence, int status) {
  (void)!write(STDERR_FILENO, sentence.data(), sentence.size());
  struct sigaction action = {};
  action.sa_handler = Rest;
  sigaction(SIGUSR2, &action, nullptr);
  pthread_kill(maker, SIGUSR2);
  const timespec a_moment{0, 20'000'000};
  nanosleep(&a_moment, nullptr);
  RemoveLeftovers();
  _exit(status);
}

}  // namespace

InterruptGuard::InterruptGuard() {
  const sigset_t signals = Signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  waiter_ = std::jthread([this, maker = pthread_self()](const std::stop_token& ended) {
    WaitForSignals(ended, maker);
  });
}

void InterruptGuard::WaitForSignals(const std::stop_token& ended, pthread_t maker) {
  const sigset_t signals = Signals();
  const timespec patience{0, 50'000'000};  // looks that often whether the guard has ended
  std::optional<std::chrono::steady_clock::time_point> first;
  while (!ended.stop_requested()) {
    const int received = sigtimedwait(&signals, nullptr, &patience);
    if (received > 0 && first) EndAtOnce(maker, "", 128 + received);
    if (received > 0) {
      first = std::chrono::steady_clock::now();
      stop_.request_stop();
    }
    if (!first) continue;
    const std::chrono::steady_clock::duration since = std::chrono::steady_clock::now() - *first;
    if (since > seconds(1)) {
      if (!keep_) EndAtOnce(maker, "halfstep: interrupted\n", kInterrupted);
      step_.request_stop();
    }
    if (since > seconds(10)) proof_.request_stop();
    if (since > seconds(20)) {
      const std::lock_guard lock(mutex_);
      const std::string end =
          saved_by_.empty() ? ", so it is lost" : "; `" + saved_by_ + "` saves it";
      const std::string sentence =
          "halfstep: interrupted; what was found could not be proved and written within 20 s" + end;
      EndAtOnce(maker, sentence + "\n", kInterrupted);
    }
  }
}

}  // namespace halfstep
