#pragma once

#include <memory>
#include <string_view>

#include "smoothing/margins/margin.h"
#include "smoothing/margins/margin_evaluator.h"
#include "smoothing/walk/stop_branches.h"
#include "smoothing/walk/superposed_walk.h"

namespace halfstep {

/// How an answer about a stretch of time was found.
enum class Evidence {
  kSampled,    ///< at finitely many instants; says nothing about the motion between them
  kCertified,  ///< for every instant
};
std::string_view Name(Evidence evidence);  ///< "sampled" or "certified".

/// Undecided: neither proved nor refuted.
enum class Verdict { kFeasible, kViolated, kUndecided };

/// Absolute times [s] of a walk, begin ≤ end.
struct TimeSpan {
  double begin = 0.0;  ///< [s]
  double end = 0.0;    ///< [s]
};

/// The answer about a stretch of time.
struct Feasibility {
  Verdict verdict = Verdict::kUndecided;   ///< what was found
  Evidence evidence = Evidence::kSampled;  ///< how it was found
  /// Violated: a margin below what is demanded. Undecided: the one that could not be decided.
  Margin witness;
  bool stopped = false;  ///< undecided because the check was told to stop
};

/// Whether a walk meets every demanded margin on a span of time. The scratch's stop token is
/// polled; a check that is stopped is undecided.
class FeasibilityTest {
 public:
  virtual ~FeasibilityTest() = default;
  virtual Evidence evidence() const = 0;  ///< what its answers rest on
  /// How the test decides: "sampled every 5 ms".
  virtual std::string Description() const = 0;
  /// Limits, demanded margins, robot and scene.
  virtual const MarginEvaluator& evaluator() const = 0;
  /// Which stop branches must keep the margins, too.
  virtual StopBranches stop_branches() const { return StopBranches::kNone; }
  /// The same kind of test with the demands of another evaluator.
  virtual std::unique_ptr<FeasibilityTest> Over(const MarginEvaluator& evaluator) const = 0;
  /// Decides the absolute times of `span`.
  virtual Feasibility Check(const SuperposedWalk& walk, const TimeSpan& span,
                            MarginEvaluator::Scratch* scratch) const = 0;
};

}  // namespace halfstep
