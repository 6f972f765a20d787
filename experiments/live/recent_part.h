#pragma once

#include <optional>

#include "experiments/live/proposal.h"

namespace halfstep {

/// What of a situation a replanner needs to know: the walk without most of what is past, so that
/// what it thinks costs the same however long the robot has walked. In place of the past stands one
/// step that is over, and a rest until half-steps begin as they do: at the same times, to the bit.
/// So the motion is the same from then on.
class RecentPart {
 public:
  /// None where little is past.
  static std::optional<RecentPart> Of(const Situation& s);

  const Situation& situation() const { return recent_; }  ///< half-steps count from first()
  int first() const { return first_; }                    ///< the half-step that is its 0
  /// The same proposal of the whole walk.
  Proposal Whole(Proposal proposal) const;

 private:
  Situation recent_;
  WalkPlan past_;               // the whole walk
  std::vector<bool> smoothed_;  // of it
  int first_ = 0;
};

}  // namespace halfstep
