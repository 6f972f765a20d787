#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <memory>
#include <string>

#include "experiments/python/walk_setting.h"
#include "smoothing/methods/named_options.h"
#include "smoothing/methods/smoother.h"

namespace halfstep::python {

/// What a smoother of the user's gets: the walk to be smoothed while the method runs. It refuses
/// everything afterwards.
class SmoothingTask {
 public:
  /// `own`: the options that the function declared. `monitor` is borrowed until End().
  SmoothingTask(const WalkProblem& problem, const MethodOptions& options, NamedOptions own,
                SmoothingMonitor* monitor);

  const std::shared_ptr<const WalkSetting>& setting() const { return setting_; }
  const MethodOptions& options() const { return options_; }
  const NamedOptions& own() const { return own_; }
  bool running() const { return monitor_ != nullptr; }
  /// Whether the method is to end: by Ctrl-C, its effort, its deadline or because it has ended.
  bool stopped() const { return monitor_ == nullptr || monitor_->stopped(); }
  double remaining() const;  ///< until the deadline [s], +∞: none; 0 when stopped
  HomotopyParameters incumbent() const;
  double duration() const;  ///< of the incumbent [s]

  /// SmoothingMonitor::Propose. Throws std::invalid_argument when the method has ended, too.
  bool Propose(const HomotopyParameters& candidate);
  void Tell(double done) const;  ///< the progress ∈ [0, 1]
  void End() { monitor_ = nullptr; }

 private:
  SmoothingMonitor& monitor() const;

  std::shared_ptr<const WalkSetting> setting_;
  MethodOptions options_;
  NamedOptions own_;
  SmoothingMonitor* monitor_;
};

/// A smoother that is a Python function of a SmoothingTask, with options of its own under its name.
/// `function` is kept for ever: methods are never removed. Needs the GIL.
std::unique_ptr<const Smoother> MakePythonSmoother(const std::string& name,
                                                   const std::string& meaning, NamedOptions options,
                                                   const pybind11::function& function);

}  // namespace halfstep::python
