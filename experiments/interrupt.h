#pragma once

#include <stop_token>
#include <thread>

namespace halfstep {

/// Turns Ctrl-C (SIGINT) and SIGTERM into a stop request while it lives; a second one ends the
/// process at once. Make it before any other thread, so that they inherit the blocked signals.
class InterruptGuard {
 public:
  InterruptGuard();

  std::stop_token token() const { return source_.get_token(); }
  bool requested() const { return source_.stop_requested(); }

 private:
  std::stop_source source_;
  std::jthread waiter_;
};

}  // namespace halfstep
