#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "smoothing/certificate.h"
#include "smoothing/margin_evaluator.h"
#include "wpg/motion_bounds.h"

namespace halfstep {

/// The statements about an interval of time that are not yet proved there.
struct Pending {
  std::vector<MarginFamily> families;  ///< all but the clearances, which go body by body
  std::vector<uint16_t> bodies;        ///< against the obstacles
  std::vector<uint16_t> pairs;         ///< of the robot's own bodies

  bool empty() const { return families.empty() && bodies.empty() && pairs.empty(); }
};

/// Proves statements about one interval from its midpoint and a bound on the motion around it.
class IntervalStatements {
 public:
  /// `evaluator` is borrowed and must outlive this.
  explicit IntervalStatements(const MarginEvaluator& evaluator);

  Pending All() const;
  /// How many statements a family has at every instant: joints, bodies, pairs …
  int CountOf(MarginFamily family) const;

  /// Removes from `pending` what holds for all t of [begin, end], and adds it to `rows` unless null
  /// (with margins instead of mere verdicts: slower). Returns a margin that is violated at the
  /// midpoint, if any. Precondition: no foot touches down or lifts off, and no foot starts or stops
  /// moving horizontally, strictly inside the interval.
  std::optional<Margin> Prove(const SuperposedWalk& walk, double begin, double end,
                              Pending* pending, MarginEvaluator::Scratch* scratch,
                              Certificate* rows) const;

 private:
  // The statement with the least to spare of a family, and how many there are.
  struct Tightest {
    Margin margin;
    double bound = 0.0;
    int count = 0;
    void Add(const Margin& added, double change);
    // One with at least `spare`, unless it may be the tightest: false.
    bool Pass(double spare);
  };
  Tightest Scalar(MarginFamily family, const SuperposedWalk& walk, const LocalTime& mid,
                  const IntervalMotion& motion) const;
  Tightest NoStep(const SuperposedWalk& walk, const LocalTime& mid, const IntervalMotion& motion,
                  MarginEvaluator::Scratch* scratch) const;
  Tightest Ground(const SuperposedWalk& walk, const LocalTime& mid,
                  const IntervalMotion& motion) const;

  const MarginEvaluator& evaluator_;
  MotionBounds bounds_;
};

/// The motion of a walk over the absolute times [begin, end] [s].
void BoundMotion(const MotionBounds& bounds, const SuperposedWalk& walk, double begin, double end,
                 IntervalMotion* motion);

}  // namespace halfstep
