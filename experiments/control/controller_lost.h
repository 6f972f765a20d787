#pragma once

#include <exception>
#include <string>
#include <utility>

namespace halfstep::control {

/// Thrown by TrackingController::Command when there will be no more commands, as by a controller in
/// a process that has gone. It ends the simulation; it is no std::runtime_error, which would be a
/// simulation that became unstable.
class ControllerLost : public std::exception {
 public:
  /// `sentence` says why.
  explicit ControllerLost(std::string sentence) : sentence_(std::move(sentence)) {}
  /// That sentence.
  const char* what() const noexcept override { return sentence_.c_str(); }

 private:
  std::string sentence_;
};

}  // namespace halfstep::control
