#include "experiments/interrupt.h"

#include <signal.h>
#include <unistd.h>

namespace halfstep {

InterruptGuard::InterruptGuard() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  waiter_ = std::jthread([source = source_, signals](std::stop_token ended) mutable {
    const timespec patience{0, 50'000'000};  // looks that often whether the guard has ended
    while (!ended.stop_requested()) {
      const int received = sigtimedwait(&signals, nullptr, &patience);
      if (received < 0) continue;
      if (source.stop_requested()) _exit(128 + received);
      source.request_stop();
    }
  });
}

}  // namespace halfstep
