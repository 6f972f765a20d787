#include "experiments/control/contact_watch.h"

#include <cmath>

#include "wpg/motion/foot_loads.h"
#include "wpg/motion/standing_heights.h"
#include "wpg/nth.h"
#include "wpg/robot/gravity.h"

namespace halfstep::control {
namespace {

// The step whose foot is in the air at an instant, or was last before; −1: none was lifted.
int LatestStep(const SuperposedWalk& walk, const LocalTime& at) {
  const double t = walk.Absolute(at);
  int up = at.half_step / 2 * 2;
  while (up >= 0 && walk.start_of(up) + walk.tracks(up).t2() > t) up -= 2;
  return up / 2 - (up < 0 ? 1 : 0);
}

// Where the line of the walk's ZMPs crosses the plane z = `height`: that of its point mass is in
// the plane Z(z) − z_c, and goes aside with the force.
Eigen::Vector2d ZmpAt(const WalkJet& jet, double com_height, double height) {
  const double up = jet.second[kWaistZ];
  const Eigen::Vector2d tilt =
      Eigen::Vector2d(jet.second[kComX], jet.second[kComY]) / (kGravity + up);
  const double plane = jet.value[kWaistZ] - com_height / kGravity * up;
  return Eigen::Vector2d(jet.value[kZmpX], jet.value[kZmpY]) + (height - plane) * tilt;
}

// Height above where the walk has the foot at that time: where it lands [m].
double HeightOver(const SuperposedWalk& walk, double landing, Side side, double z) {
  const double level = walk.At(walk.Locate(landing)).value[FootIndex(side) + 2];
  return std::abs(level) < StandingHeights::kLevel ? z : z - level;
}

}  // namespace

ContactWatch::ContactWatch(const RobotModel& robot)
    : least_(kCarries * robot.mass * kGravity),
      early_(kEarly * robot.com_height),
      com_height_(robot.com_height),
      sole_size_(robot.sole_size) {}

// The share of the weight that the walk's ZMP asks of a foot.
double ContactWatch::ShareOf(const SuperposedWalk& walk, const LocalTime& at, Side side) const {
  if (walk.StepInAir(at) >= 0) return walk.InAir(at, side) ? 0.0 : 1.0;
  const WalkJet jet = walk.At(at);
  const WalkState& x = jet.value;
  const StandingHeights heights(x, std::nullopt);
  if (heights.level()) {
    return FootLoads::BothFeet(FootPose(x, Side::kLeft), FootPose(x, Side::kRight), sole_size_,
                               {x[kZmpX], x[kZmpY]})
        .share(side);
  }
  const auto zmp = [&](Side of) { return ZmpAt(jet, com_height_, heights.of(of)); };
  const auto loads =
      FootLoads::OnLevels(x, heights, sole_size_, {zmp(Side::kLeft), zmp(Side::kRight)});
  return loads ? loads->share(side) : 0.5;
}

std::optional<Contact> ContactWatch::Look(const MeasuredState& measured,
                                          const SuperposedWalk& walk) {
  std::optional<Contact> contact;
  const LocalTime at = walk.Locate(measured.t);
  const WalkState x = walk.At(at).value;
  const int step = LatestStep(walk, at);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    Foot& foot = Nth(feet_, Index(side));
    const bool pressed = Nth(measured.loads, Index(side)).force >= least_;
    const bool carries = pressed && foot.pressed;
    foot.pressed = pressed;
    const bool flies = walk.InAir(at, side);
    if (flies && !pressed) foot.awaited = true;
    const bool due = foot.awaited && !flies && ShareOf(walk, at, side) >= kDue;
    if (!due) foot.due.reset();
    if (due && !foot.due) foot.due = measured.t;
    const double late = due ? measured.t - *foot.due : 0.0;
    foot.misses = late > kLate && !carries;
    if (!carries || !foot.awaited) continue;
    foot.awaited = false;
    const bool known = step >= 0 && 2 * step + 1 < walk.num_half_steps() &&
                       walk.half_step(2 * step).swing() == side;
    if (!known) continue;
    const int down = 2 * step + 1;
    const double landing = walk.start_of(down) + walk.tracks(down).t1();
    const double height = HeightOver(walk, landing, side, x.segment<4>(FootIndex(side)).z());
    const bool early = flies && height >= early_;
    if (!early && late <= kLate) continue;
    contact = {.t = measured.t,
               .foot = side,
               .half_step = down,
               .late = early ? measured.t - landing : late,
               .height = height};
  }
  return contact;
}

}  // namespace halfstep::control
