#include "smoothing/margins/instant.h"

#include <algorithm>
#include <cmath>

#include "smoothing/margins/rounding.h"
#include "wpg/robot/gravity.h"

namespace halfstep {

Instant::Instant(const MarginPlace& place, const MarginLimits& limits, const SuperposedWalk& walk,
                 const LocalTime& at, MarginScratch* scratch)
    : place_(place),
      limits_(limits),
      walk_(walk),
      at_(at),
      scratch_(*scratch),
      jet_(walk.At(at)),
      step_(walk.StepInAir(at)) {}

Instant::Instant(const MarginPlace& place, const MarginLimits& limits, const SuperposedWalk& walk,
                 const LocalTime& at, const WalkJet& jet, const Posture& posture,
                 MarginScratch* scratch)
    : place_(place),
      limits_(limits),
      walk_(walk),
      at_(at),
      scratch_(*scratch),
      jet_(jet),
      step_(walk.StepInAir(at)),
      posture_(&posture),
      speeds_tried_(true),
      regular_(true) {}

const Posture& Instant::posture() {
  if (posture_ == nullptr) {
    own_ = SolvePosture(robot(), jet_.value);
    posture_ = &own_;
  }
  return *posture_;
}

bool Instant::regular() {
  if (!speeds_tried_) {
    speeds_tried_ = true;
    regular_ = reachable() && SolveJointSpeeds(robot(), jet_, &own_);
  }
  return regular_;
}

const RobotDynamics* Instant::dynamics() { return robot().masses.known() ? motion() : nullptr; }

const RobotDynamics* Instant::motion() {
  if (!motion_) {
    if (!regular()) return nullptr;
    motion_.emplace(robot(), jet_, posture(), kGravity);
  }
  return &*motion_;
}

const SupportPolygon& Instant::support() {
  if (!support_) support_ = SupportAt(walk_, at_, jet_.value, robot().sole_size);
  return *support_;
}

StandingHeights Instant::heights() const {
  if (step_ < 0) return {jet_.value, std::nullopt};
  return {jet_.value, Opposite(swing())};
}

const WalkThirds& MarginInterval::Thirds() const {
  if (!thirds_) {
    const double middle = mid.t(), h = motion.half_width;
    thirds_ = mid.walk().ThirdRanges(middle - h, middle + h);
  }
  return *thirds_;
}

double MarginInterval::SolesOff(double inside, const ZmpDrift& zmp) const {
  if (!(zmp.least_push > 0.0)) return kUnlimited;
  const WalkState &x = motion.jet.value, &off = motion.off.value;
  const StandingHeights heights = mid.heights();
  double height = 0.0;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    if (mid.step_in_air() >= 0 && mid.swing() == side) continue;
    const int z = FootIndex(side) + 2;
    height = std::max(height, std::abs(x[z] - heights.of(side)) + off[z]);
  }
  const double pull = mid.dynamics()->contact().segment<2>(3).norm() +
                      zmp.half_width * zmp.force_rate.most() + zmp.force_rest;
  return SupportRounding(x, off, mid.robot().sole_size, inside) +
         height * (1.0 + pull / zmp.least_push);
}

double MarginInterval::LeastSole(Side side) const {
  const int z = FootIndex(side) + 2, step = mid.step_in_air();
  const double least = motion.jet.value[z] - motion.Change(z);
  if (step < 0 || mid.swing() != side) return least;
  const double t = mid.t(), h = motion.half_width;
  return std::max(least, mid.walk().LeastHeight(step, t - h, t + h));
}

const RobotDrift& MarginInterval::drift() const {
  if (!drift_) {
    drift_.emplace(mid.robot(), motion, Thirds(), *mid.motion(), kGravity);
  }
  return *drift_;
}

const ZmpDrift& MarginInterval::zmp_drift() const {
  if (!zmp_drift_) {
    zmp_drift_ = ZmpDrift::Over(mid.robot(), motion, Thirds(), drift(), *mid.dynamics(), kGravity,
                                mid.heights().middle());
  }
  return *zmp_drift_;
}

const ContactRate* MarginInterval::contact_rate() const {
  if (!contact_rate_) {
    contact_rate_ = ContactRate::Over(mid.robot(), motion, Thirds(), drift(), *mid.dynamics(),
                                      kGravity, mid.heights().middle());
  }
  return *contact_rate_ ? &**contact_rate_ : nullptr;
}

}  // namespace halfstep
