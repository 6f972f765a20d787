#include "experiments/control/dcm_controller.h"

#include <algorithm>
#include <cmath>

#include "experiments/control/contact_watch.h"
#include "experiments/control/small_turn.h"
#include "experiments/control/sole_loads.h"
#include "wpg/nth.h"
#include "wpg/robot/gravity.h"
#include "wpg/robot/leg_ik.h"

namespace halfstep::control {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kPeriod = kControlPeriod;
// Moment of a foot on the floor for each radian, of m g z_c, when the servos' stiffness is not
// known: that of 30 000 N m/rad at HRP-2's size.
constexpr double kStiffFoot = 70.0;
constexpr double kLegLever = 0.14;   // of the knee about the line from hip to ankle, of z_c
constexpr double kCarries = 0.02;    // of the weight: the least that a sole carries
constexpr double kMostTilt = 0.2;    // of a sole [rad]
constexpr double kForget = 0.1;      // of what a foot no longer needs [s]
constexpr double kFollow = 0.03;     // of a foot in the air [s]
constexpr double kReach = 0.08;      // of a foot that misses the floor, of z_c [1/s]
constexpr double kMostReach = 0.03;  // of z_c
constexpr double kMostShift = 0.1;   // of the waist, of z_c
constexpr double kShiftLeak = 0.5;   // [s]

// First-order, with the time constant `time`.
template <typename Value>
void Approach(const Value& goal, double time, Value* value) {
  *value += kPeriod / (time + kPeriod) * (goal - *value);
}

// Of the feet when servos are as stiff as stiff ones are.
double StiffFoot(const RobotModel& robot) {
  return kStiffFoot * robot.mass * kGravity * robot.com_height;
}

// Of the legs' servos; where it is not known, that of stiff ones.
double ServoStiffness(const RobotModel& robot, const DcmOptions& options) {
  return std::isfinite(options.stiffness) ? options.stiffness : StiffFoot(robot);
}

// Of servo and bush, one behind the other.
double FootStiffness(const RobotModel& robot, const DcmOptions& options) {
  const double servo = ServoStiffness(robot, options);
  return options.ankle ? 1.0 / (1.0 / servo + 1.0 / options.ankle->stiffness) : servo;
}

// The sole's turn (roll, pitch) that moves its pressure the way of a moment f·centre.
Vector2d TiltFor(const Vector2d& moment) { return {-moment.y(), moment.x()}; }
Vector2d MomentOf(const SoleLoad& load) { return load.force * load.centre; }

}  // namespace

DcmController::DcmController(const RobotModel& robot, const DcmOptions& options)
    : robot_(robot),
      options_(options),
      leg_stiffness_(ServoStiffness(robot, options)),
      foot_stiffness_(FootStiffness(robot, options)),
      dcm_(robot, options.ankle, options.filter),
      planned_bushes_{AnkleBush(robot.legs[0], options.ankle),
                      AnkleBush(robot.legs[1], options.ankle)},
      errors_(options.stiffen * StiffFoot(robot) / options.stiffness - 1.0, options.servo_time) {}

std::unique_ptr<TrackingController> DcmController::Clone() const {
  return std::make_unique<DcmController>(*this);
}

void DcmController::MeetFloor(const MeasuredState& measured, const PlannedState& next,
                              PlannedState* then) {
  const double weight = robot_.mass * kGravity, high = ContactWatch::kEarly * robot_.com_height;
  const std::array<SoleLoad, 2> due = SharedLoads(*then, robot_.sole_size, then->zmp);
  for (size_t s = 0; s < 2; ++s) {
    FootOffset& foot = feet_[s];
    const bool pressed = measured.loads[s].force >= ContactWatch::kCarries * weight;
    const bool carries = pressed && foot.pressed;
    foot.pressed = pressed;
    if (then->stands[s]) {
      foot.met = 0.0;
      foot.from = then->levels[s];
      foot.lifted = false;
      foot.landed = foot.landed || carries;
      const bool awaited = !foot.landed && due[s].force >= ContactWatch::kDue * weight;
      foot.missing = awaited ? foot.missing + kPeriod : 0.0;
    } else {
      foot.landed = foot.landed && pressed;
      foot.missing = 0.0;
      const double z_W = then->X_WSole[s].translation().z(), z = z_W - then->levels[s];
      foot.lifted = foot.lifted || z_W - foot.from >= high;
      const bool meets = foot.lifted && carries && !foot.landed && foot.met == 0.0;
      if (meets && z >= high) foot.met = z;
    }
    const double z = next.X_WSole[s].translation().z() - next.levels[s];
    if (foot.met > 0.0) {
      foot.floor = std::max(0.0, foot.met - z);
    } else if (foot.missing > ContactWatch::kLate) {
      const double most = kMostReach * robot_.com_height;
      foot.floor = std::max(-most, foot.floor - kPeriod * kReach * robot_.com_height);
      if (then->stands[1 - s]) then->stands[s] = false;
    } else if (!then->stands[s]) {
      Approach(0.0, options_.leak, &foot.floor);
    }
  }
}

void DcmController::TurnSoles(const MeasuredState& measured, const PlannedState& then,
                              const std::array<SoleLoad, 2>& wanted,
                              const std::array<SoleLoad, 2>& planned) {
  const std::array<bool, 2> down = SolesOnFloor(then);
  const double least = kCarries * robot_.mass * kGravity;
  for (size_t s = 0; s < 2; ++s) {
    FootOffset& foot = feet_[s];
    const SoleLoad& has = measured.loads[s];
    const bool carries = down[s] && has.force > least;
    Vector2d missing(0, 0), asked(0, 0);
    if (carries) {
      missing = TiltFor(MomentOf(wanted[s]) - MomentOf(has)) / foot_stiffness_;
      asked = TiltFor(MomentOf(wanted[s]) - MomentOf(planned[s])) / foot_stiffness_;
    }
    foot.tilt +=
        kPeriod * (missing / options_.ankle_time - foot.tilt / (carries ? options_.leak : kForget));
    foot.tilt = foot.tilt.cwiseMax(-kMostTilt).cwiseMin(kMostTilt);
    Approach<Vector2d>(options_.at_once * asked, options_.filter, &foot.at_once);
  }
  if (!down[0] || !down[1]) return Approach(0.0, kForget, &difference_);
  const double lever = kLegLever * robot_.com_height;
  const double missing =
      (wanted[0].force - wanted[1].force) - (measured.loads[0].force - measured.loads[1].force);
  difference_ += kPeriod * (missing * lever * lever / (leg_stiffness_ * options_.force_time) -
                            difference_ / options_.leak);
}

void DcmController::HoldFeet(const EstimatedState& state, const PlannedState& then,
                             const PlannedState& next) {
  const Isometry3d X_PlanIs = then.X_WB * state.X_WB.inverse();  // from where it is to the plan
  for (size_t s = 0; s < 2; ++s) {
    const bool flies = !then.stands[s] && !next.stands[s];
    Vector3d turn(0, 0, 0), shift(0, 0, 0);
    if (flies) {
      const Vector3d place = then.X_WSole[s].translation();
      turn = options_.level * SmallTurnOf(X_PlanIs.linear());
      shift = options_.level * (X_PlanIs * place - place);
    }
    Approach<Vector3d>(turn, flies ? options_.follow : kForget, &feet_[s].turn);
    Approach<Vector3d>(shift, flies ? options_.follow : kForget, &feet_[s].shift);
  }
}

void DcmController::ShiftWaist(const MeasuredState& measured, const PlannedState& then,
                               const Vector2d& zmp) {
  Vector2d moment(0, 0);
  double force = 0.0;
  for (size_t s = 0; s < 2; ++s) {
    const SoleLoad& load = measured.loads[s];
    const Vector3d place = then.X_WSole[s] * Vector3d(load.centre.x(), load.centre.y(), 0.0);
    moment += load.force * (place.head<2>() + (then.zmp_height - place.z()) * then.tilt);
    force += load.force;
  }
  const bool carried = force > kCarries * robot_.mass * kGravity;
  const Vector2d off = carried ? Vector2d(moment / force - zmp) : Vector2d(0, 0);
  const double most = kMostShift * robot_.com_height;
  shift_ += kPeriod * (options_.waist_rate * off - shift_ / kShiftLeak);
  shift_ = shift_.cwiseMax(-most).cwiseMin(most);
}

std::array<Vector6d, 2> DcmController::Bent(const PlannedState& next) const {
  std::array<Vector6d, 2> bent = bent_;
  Isometry3d X_WB = next.X_WB;
  X_WB.translation().head<2>() += shift_;
  for (size_t s = 0; s < 2; ++s) {
    const FootOffset& foot = feet_[s];
    Vector3d tilt(0, 0, 0);
    tilt.head<2>() = foot.tilt + foot.at_once;
    Isometry3d X_WSole = next.X_WSole[s];
    X_WSole.translation() += foot.shift;
    X_WSole.translation().z() += foot.floor + (s == 0 ? -0.5 : 0.5) * difference_;
    X_WSole.linear() = Turned(foot.turn) * X_WSole.linear();
    X_WSole = X_WSole * TurnedAbout(planned_bushes_[s].ankle(), tilt) *
              planned_bushes_[s].X_RestSole().inverse();
    const Leg& leg = robot_.legs[s];
    const LegIkSolution plain = SolveLegIk(leg, next.X_WB.inverse() * next.X_WSole[s]);
    const LegIkSolution moved = SolveLegIk(leg, X_WB.inverse() * X_WSole);
    if (plain.status != LegIkStatus::kSolved || moved.status != LegIkStatus::kSolved) continue;
    bent[s] = moved.q - plain.q;
  }
  return bent;
}

JointCommand DcmController::Command(const MeasuredState& measured, const PlannedState& planned,
                                    const PlannedState& next) {
  PlannedState then = planned;
  MeetFloor(measured, next, &then);
  const EstimatedState state = dcm_.Sense(measured, then, kPeriod);
  const auto nearest = [&](const Vector2d& p) {
    return NearestInSupport(then, robot_.sole_size, options_.inset, p);
  };
  const Vector2d without = nearest(then.zmp);
  const Vector2d zmp = nearest(then.zmp + (1.0 + options_.gain) * dcm_.value());
  TurnSoles(measured, then, SharedLoads(then, robot_.sole_size, zmp),
            SharedLoads(then, robot_.sole_size, without));
  HoldFeet(state, then, next);
  ShiftWaist(measured, then, zmp);
  return Bend(measured, next);
}

JointCommand DcmController::Bend(const MeasuredState& measured, const PlannedState& next) {
  for (size_t s = 0; s < 2; ++s) {
    const Vector3d moment = next.X_WSole[s].linear().transpose() * next.ankle_moments[s];
    planned_bushes_[s].Yield(moment.head<2>(), kPeriod);
    // K x + D ẋ is the torque.
    Approach<Vector6d>(next.torques[s] / options_.stiffness, options_.damping / options_.stiffness,
                       &sag_[s]);
  }
  bent_ = Bent(next);
  const std::array<Vector6d, 2>& errors = errors_.Integrated(measured, next.t);
  errors_.Note(next.t, {next.q[0] + bent_[0], next.q[1] + bent_[1]});
  JointCommand command{next.q, next.speeds};
  for (size_t s = 0; s < 2; ++s) {
    const Vector6d added = bent_[s] + sag_[s] + errors[s];
    command.q[s] += added;
    if (begun_) command.speeds[s] += (added - added_[s]) / kPeriod;
    added_[s] = added;
  }
  begun_ = true;
  return command;
}

}  // namespace halfstep::control
