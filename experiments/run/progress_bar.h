#pragma once

#include <chrono>
#include <string>

namespace halfstep {

/// A bar with the share of the work that is done on standard error, when that is a terminal,
/// `quiet` is not asked for and the work lasts more than a second; otherwise nothing. How long the
/// rest will take is not told: searches end by counted work, which takes a different time each.
class ProgressBar {
 public:
  /// `of`: what the share is of, such as " of the effort". Nothing is drawn before the first
  /// progress is told.
  ProgressBar(std::string label, bool quiet, std::string of = {});
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// done ∈ [0, 1].
  void Update(double done);
  /// The best walk so far lasts `duration` [s]: drawn from the next Update() on.
  void Best(double duration);

 private:
  std::string label_, of_;
  std::string best_;  // in words
  bool enabled_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point begin_;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace halfstep
