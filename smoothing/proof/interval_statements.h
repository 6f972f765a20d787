#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "smoothing/margins/margin_evaluator.h"
#include "smoothing/proof/certificate.h"
#include "wpg/motion/motion_bounds.h"

namespace halfstep {

/// A group of a family's statements that is not yet proved over an interval of time: all of the
/// family, or those of one body or pair of bodies (MarginStatements::groups).
struct OpenGroup {
  MarginFamily family;  ///< to which the group belongs
  uint16_t group = 0;   ///< 0 when all statements of the family are one group
};

/// The groups that are not yet proved over one interval; those of one family are adjacent.
using OpenGroups = std::vector<OpenGroup>;

/// Proves statements about one interval from its midpoint and a bound on the motion around it.
class IntervalStatements {
 public:
  /// Copies the evaluator, which shares robot and scene.
  explicit IntervalStatements(MarginEvaluator evaluator);

  /// All groups of all families.
  OpenGroups All() const;

  /// Removes from `open` the groups that hold for all t in the absolute times [begin, end] [s].
  /// Unless `rows` is null, it gets their rows, which is slower: rows need margins, not only
  /// verdicts. Returns a margin that is violated at the midpoint, if any. Precondition: no foot
  /// touches down or lifts off, and no foot starts or stops moving horizontally, strictly inside
  /// the interval.
  std::optional<Margin> Prove(const SuperposedWalk& walk, double begin, double end,
                              OpenGroups* open, MarginEvaluator::Scratch* scratch,
                              Certificate* rows) const;

 private:
  MarginEvaluator evaluator_;
  MotionBounds bounds_;
  OpenGroups all_;
};

/// Bounds the motion of a walk over the absolute times [begin, end] [s].
void BoundMotion(const MotionBounds& bounds, const SuperposedWalk& walk, double begin, double end,
                 IntervalMotion* motion);

}  // namespace halfstep
