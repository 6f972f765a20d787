#pragma once

#include <array>
#include <optional>

#include "experiments/verify/described_walk.h"

namespace halfstep::verify {

/// What a walk says at the instants that were asked last: the statements of one interval ask the
/// same instants one after the other, and each is computed once. Borrows the walk.
class RecentInstants {
 public:
  explicit RecentInstants(const DescribedWalk& walk) : walk_(walk) {}  ///< borrowed

  const PlayedRow& Row(double t);                        ///< DescribedWalk::Row
  const WalkDynamics& Dynamics(double t);                ///< DescribedWalk::DynamicsAt
  const std::array<Vector6d, 2>& JointSpeeds(double t);  ///< DescribedWalk::JointSpeeds

 private:
  struct Instant {
    double t = -1.0;  // no time of a walk
    std::optional<PlayedRow> row;
    std::optional<WalkDynamics> dynamics;
    std::optional<std::array<Vector6d, 2>> speeds;
  };
  // That of t, in place of the oldest where it is new.
  Instant& Of(double t);

  const DescribedWalk& walk_;
  std::array<Instant, 8> instants_;
  size_t oldest_ = 0;
};

}  // namespace halfstep::verify
