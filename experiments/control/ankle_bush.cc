#include "experiments/control/ankle_bush.h"

#include "experiments/control/small_turn.h"

namespace halfstep::control {

AnkleBush::AnkleBush(const Leg& leg, const std::optional<JointSpring>& spring)
    : spring_(spring), ankle_(leg.X_BSole.inverse() * leg.joints[5].X_BLink.translation()) {}

// D φ̇ = M − K φ, implicitly.
void AnkleBush::Yield(const Eigen::Vector2d& moment, double time) {
  if (!spring_) return;
  const auto& [stiffness, damping] = *spring_;
  speed_ = (moment - stiffness * turn_) / (damping + time * stiffness);
  turn_ += time * speed_;
}

Eigen::Isometry3d AnkleBush::X_RestSole(double after) const {
  const Eigen::Vector2d turn = turn_ + after * speed_;
  return TurnedAbout(ankle_, {turn.x(), turn.y(), 0.0});
}

}  // namespace halfstep::control
