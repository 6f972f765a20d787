#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "opt/solvers/solver.h"
#include "smoothing/methods/incumbent.h"
#include "smoothing/methods/search_ending.h"
#include "smoothing/methods/search_tuning.h"
#include "smoothing/methods/smoothing_monitor.h"
#include "smoothing/methods/walk_window.h"
#include "smoothing/program/overlap_program.h"

namespace halfstep {

/// How a range of half-steps is searched.
struct RangeOptions {
  std::shared_ptr<const opt::Solver> solver;  ///< not null
  ProgramOptions program;                     ///< what is solved, and over which parameters
  double duration_limit = 0.0;                ///< of `safest` [s]
  int iterations = 3;                         ///< of the solver in a round, at most
  int rounds = 40;                            ///< from a start, at most
  bool first_proof = false;  ///< rounds end with the first end of which nearly all is proved
  bool from_proved = true;   ///< whether the range's own parameters are proved
  SearchTuning tuning;       ///< its constants
};

/// Called with every new point of a range's part that was proved, its cost and what that is less
/// than the range's own parameters cost.
using RangeGain = std::function<void(const HomotopyParameters& part, double cost, double gain)>;

/// Lowers the cost of a walk by a program over a range of its half-steps: a window of it, or all.
/// The one loop of all searches by solvers: in each round the solver takes a few steps, where it
/// ends is a candidate for the Incumbent, an end that few stretches refuse is repaired, and the
/// program learns where to look and how much to keep in reserve. Source: smoothing/README.md, "The
/// search".
class RangeSearch {
 public:
  /// `range.parameters` are proved on the stretches that the range may change, or else
  /// `options.from_proved` is false: then they cost +∞. All but the options is borrowed; `ending`
  /// notes how solves ended.
  RangeSearch(const WalkWindow& range, RangeOptions options, SmoothingMonitor& monitor,
              RangeGain gained, SearchEnding* ending);

  /// Whether anything may be moved.
  bool moves() const { return program_.variables().size() > 0; }
  const OverlapProgram& program() const { return program_; }  ///< over the range
  const Incumbent& path() const { return path_; }             ///< the best that was proved

  /// Rounds from `start`, feasible or not, with `more` times the usual reserve, until they gain
  /// next to nothing or `effort` of the monitor is used. False: there is to be no further start.
  bool From(const HomotopyParameters& start, double more, double effort);

 private:
  bool Safest() const { return options_.program.kind == ProgramKind::kSafest; }
  // A round of the solver from x to where it ends. False: there is no such point.
  bool Solve(Eigen::VectorXd* x, bool repair);
  // Moves the incumbent towards x; the program learns where to look. False: not worth a proof.
  bool Try(const Eigen::VectorXd& x);
  bool Few(const std::vector<Margin>& refusals) const;
  void Record(const HomotopyParameters& candidate, double violation, double lambda);

  const WalkWindow& range_;
  const RangeOptions options_;
  SmoothingMonitor& monitor_;
  const RangeGain gained_;
  SearchEnding& end_;
  OverlapProgram program_;
  const double sharpness_ = program_.watched().sharpness();  // of rows at first
  StretchProofs proofs_;
  double begun_;  // what the range's own parameters cost
  Incumbent path_;
  opt::Solution solution_;                       // of the last round
  double end_cost_ = 0.0, end_violation_ = 0.0;  // where it ended
  std::vector<bool> held_;  // half-steps at whose last end samples are violated
  double moved_ = 0.0;      // how far the incumbent went to the last end
  int violated_ = 0;        // rounds in a row whose ends were violated
  double dearer_ = 1.0;     // how much more violations cost
  double until_ = 0.0;      // effort of the monitor
};

/// The same program, with support points on which the robot could rest, so that slower half-steps
/// are feasible where faster ones are refused.
ProgramOptions Resting(ProgramOptions program, const WalkProblem& problem);

/// The whole walk of `at` as a range.
WalkWindow WholeRange(const WalkProblem& problem, const HomotopyParameters& at);

}  // namespace halfstep
