#pragma once

#include <string>
#include <vector>

#include "smoothing/margins/instant.h"

namespace halfstep {

/// A margin of one's own, which a program adds (MarginLimits::own; Methods::AddMargin where configs
/// are read): demanded, proved and followed by optimizers as those built in are, in the family
/// `own`. What is proved is as true as Change() is. Const and thread-safe. Its first user is the
/// numbered example 07 (experiments/examples).
class OwnStatement {
 public:
  virtual ~OwnStatement() = default;
  virtual std::string name() const = 0;  ///< what a margin of it is said to belong to
  /// What counts as a clear change of the margin [its unit]; the family `own` counts in it.
  virtual double scale() const = 0;
  /// The margin at an instant [its unit], positive inside the limit; +∞ where there is none.
  virtual double Value(Instant* at) const = 0;
  /// How much the margin changes at most between the midpoint of an interval and any of its
  /// instants [its unit]. IntervalMotion has bounds of the walk's quantities; MarginInterval those
  /// of bodies and of the robot's ZMP. What rounding does to the quantities that Value is of is
  /// part of the change (IntervalMotion::off and `rounding`). Asked only where Value is finite at
  /// the midpoint.
  virtual double Change(const MarginInterval& interval) const = 0;
  /// ∂Value/∂parameter i (n), in the order of `along`. Asked only where Value is finite.
  virtual std::vector<double> Slopes(Instant* at,
                                     const std::vector<WalkSensitivity>& along) const = 0;
};

}  // namespace halfstep
