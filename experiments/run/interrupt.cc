#include "experiments/run/interrupt.h"

#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <optional>
#include <string_view>

#include "experiments/run/exit_status.h"

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

// Files are whole at any moment, so nothing is left to be done.
[[noreturn]] void EndAtOnce(std::string_view sentence) {
  (void)!write(STDERR_FILENO, sentence.data(), sentence.size());
  _exit(kInterrupted);
}

}  // namespace

InterruptGuard::InterruptGuard() {
  const sigset_t signals = Signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  waiter_ = std::jthread([this](const std::stop_token& ended) { WaitForSignals(ended); });
}

void InterruptGuard::WaitForSignals(const std::stop_token& ended) {
  const sigset_t signals = Signals();
  const timespec patience{0, 50'000'000};  // looks that often whether the guard has ended
  std::optional<std::chrono::steady_clock::time_point> first;
  while (!ended.stop_requested()) {
    const int received = sigtimedwait(&signals, nullptr, &patience);
    if (received > 0 && first) _exit(128 + received);
    if (received > 0) {
      first = std::chrono::steady_clock::now();
      stop_.request_stop();
    }
    if (!first) continue;
    const std::chrono::steady_clock::duration since = std::chrono::steady_clock::now() - *first;
    if (since > seconds(1)) {
      if (!keep_) EndAtOnce("halfstep: interrupted\n");
      step_.request_stop();
    }
    if (since > seconds(10)) proof_.request_stop();
    if (since > seconds(20)) {
      EndAtOnce(
          "halfstep: interrupted; what was found could not be proved and written within 20 s, so "
          "it is lost\n");
    }
  }
}

}  // namespace halfstep
