#pragma once

#include <atomic>
#include <chrono>
#include <mutex>
#include <stop_token>
#include <vector>

#include "experiments/server/client_message.h"

namespace halfstep {

/// What clients want of an episode, from the thread that reads their messages to the one that runs
/// it, which takes it at its ticks. Bounded; a mutex is held for a swap only.
class ClientInbox {
 public:
  /// A frame of measurements that a client sent.
  struct Measurement {
    std::chrono::steady_clock::time_point at;  ///< when it was measured
    MeasuredFrame frame;                       ///< what was measured
  };

  /// False: there are too many that were not taken yet.
  bool Add(Measurement measurement);
  /// A carry takes the place of one of the same obstacle that came just before and was not taken
  /// yet; so do a goal and a command.
  bool Add(const Edit& edit);
  std::vector<Measurement> TakeMeasurements();  ///< all that came since the last call, in order
  std::vector<Edit> TakeEdits();                ///< all that came since the last call, in order

  /// A client has come.
  void Come() { has_come_ = true; }
  bool has_come() const { return has_come_; }  ///< whether one ever did

  /// Whether no half-step is to begin for the time being.
  void Hold(bool held) { held_ = held; }
  bool held() const { return held_; }  ///< whether Hold(true) was said last
  /// Asks for the end of the episode, when the robot has come to rest.
  void End() { end_.request_stop(); }
  bool ended() const { return end_.stop_requested(); }  ///< whether End() was called
  /// Asks for the end, and that the episode begins anew.
  void Again() {
    again_ = true;
    End();
  }
  bool again() const { return again_; }                           ///< whether Again() was called
  std::stop_token end_token() const { return end_.get_token(); }  ///< stop is requested by End()

 private:
  std::mutex mutex_;  // of the two that follow
  std::vector<Measurement> measurements_;
  std::vector<Edit> edits_;
  std::atomic<bool> held_ = false, has_come_ = false, again_ = false;
  std::stop_source end_;
};

}  // namespace halfstep
