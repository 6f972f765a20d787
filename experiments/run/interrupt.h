#pragma once

#include <pthread.h>

#include <atomic>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

namespace halfstep {

/// Turns Ctrl-C (SIGINT) and SIGTERM into a stop request while it lives. The process ends soon
/// after the first signal, whatever it is doing: what does not obey the request is ended with exit
/// status 130, after a second when there is nothing to keep (files are loaded, a scene is
/// prepared), after 20 once there is. A second signal ends it at once. Whatever ends it, nothing is
/// left of what was not written whole (RemoveLeftovers). Make it before any other thread, so that
/// they inherit the blocked signals.
class InterruptGuard {
 public:
  InterruptGuard();

  /// Stop is requested at the first SIGINT or SIGTERM.
  std::stop_token token() const { return stop_.get_token(); }
  bool requested() const { return stop_.stop_requested(); }  ///< whether it was

  /// Requested a second later, for steps of a search that take longer than that.
  std::stop_token step_token() const { return step_.get_token(); }
  /// Requested 10 s later: for proofs of what was found before; the rest stays undecided.
  std::stop_token proof_token() const { return proof_.get_token(); }

  /// Says that from now on there is something to keep. `saved_by` is the command that saves it
  /// where the process is ended before it has written it; "": none does. The last call counts.
  void Keep(const std::string& saved_by = {}) {
    const std::lock_guard lock(mutex_);
    saved_by_ = saved_by;
    keep_ = true;
  }

 private:
  // `maker`: the thread that made the guard.
  void WaitForSignals(const std::stop_token& ended, pthread_t maker);

  std::stop_source stop_, step_, proof_;
  std::mutex mutex_;  // of saved_by_
  std::string saved_by_;
  std::atomic<bool> keep_ = false;
  std::jthread waiter_;  // the last: uses what is above
};

}  // namespace halfstep
