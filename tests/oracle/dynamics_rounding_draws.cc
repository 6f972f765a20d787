#include <algorithm>
#include <cmath>

#include "smoothing/margins/rounding.h"
#include "tests/oracle/exact_dynamics.h"
#include "tests/oracle/rounding_draws.h"
#include "wpg/motion/contact_rate.h"
#include "wpg/motion/foot_friction.h"
#include "wpg/motion/foot_loads.h"
#include "wpg/motion/leg_torques.h"
#include "wpg/motion/motion_bounds.h"
#include "wpg/motion/torque_drift.h"
#include "wpg/motion/zmp_drift.h"
#include "wpg/nth.h"
#include "wpg/robot/gravity.h"

namespace halfstep::oracle {
namespace {

double Apart(Real exact, double computed) {
  return static_cast<double>(Absolute(exact - Real(computed)));
}

double Apart(const Real3& exact, const Eigen::Vector3d& computed) {
  return static_cast<double>(Norm(exact - From(computed)));
}

double Norm2(Real x, Real y) { return static_cast<double>(Sqrt(x * x + y * y)); }

// One instant, computed and exact, as an interval of no width.
class DrawnDynamics {
 public:
  DrawnDynamics(const RobotModel& robot, const IntervalMotion& motion, const RobotDynamics& at_m,
                const ExactDynamics& exact, const ClosedFormWalk::Quantities& value,
                RoundingTally* tally, double of_bound)
      : robot_(robot),
        motion_(motion),
        at_m_(at_m),
        exact_(exact),
        value_(value),
        tally_(*tally),
        of_bound_(of_bound),
        drift_(robot, motion, {}, at_m, halfstep::kGravity) {}

  void Compare() {
    for (size_t s = 0; s < 2; ++s) {
      const Side side = s == 0 ? Side::kLeft : Side::kRight;
      for (int j = 0; j < 6; ++j) {
        Add("acceleration", Apart(Nth(exact_.accelerations[s], j), at_m_.accelerations(side)[j]),
            drift_.rounding.accelerations[s][j]);
        Link(side, static_cast<size_t>(j));
      }
    }
    if (!at_m_.Zmp()) return;
    Wrench();
    for (const Side side : {Side::kLeft, Side::kRight}) OnOneFoot(side);
    OnBothFeet();
  }

 private:
  void Add(const std::string& part, double error, double bound) {
    tally_.Add(part, error, of_bound_ * (drift_.rounding.known ? bound : HUGE_VAL));
  }
  // With the point of its joint's axis.
  void Link(Side side, size_t link) {
    const size_t s = static_cast<size_t>(Index(side));
    const ExactDynamics::Joint& exact = exact_.joints[s][link];
    const RobotDynamics::Body& body = at_m_.leg(side)[link];
    const BodyRounding& off = drift_.rounding.legs[s][link];
    const Posture& posture = motion_.posture;
    const Eigen::Vector3d point = posture.X_WB * posture.frames[s].point_B[link] - at_m_.O();
    const Eigen::Vector3d turn = body.velocity.head<3>(), turn1 = body.acceleration.head<3>();
    const Eigen::Vector3d velocity = body.velocity.tail<3>() + turn.cross(point);
    const Eigen::Vector3d acceleration = body.acceleration.tail<3>() + turn1.cross(point) +
                                         turn.cross(velocity) -
                                         halfstep::kGravity * Eigen::Vector3d::UnitZ();
    const PointRounding of_point = off.Of(body, point);
    Add("link axis", Apart(exact.axis, body.screw.head<3>()), off.turn);
    Add("link place", Apart(exact_.pole + exact.point - From(at_m_.O()), point), off.place);
    Add("link turn'", Apart(exact.turn, turn), off.spin);
    Add("link turn''", Apart(exact.turn1, turn1), off.spin1);
    Add("link place'", Apart(exact.velocity, velocity), of_point.speed);
    Add("link place''", Apart(exact.acceleration, acceleration), of_point.acceleration);
  }
  // About the computed ZMP of the floor.
  void Wrench() {
    Eigen::Vector3d zmp(0, 0, 0);
    zmp.head<2>() = *at_m_.Zmp();
    const WrenchRounding off = drift_.rounding.OfContact(at_m_, zmp - at_m_.O());
    const Vector6d& contact = at_m_.contact();
    const Real3 O = From(at_m_.O()), arm = From(zmp) - O;
    // Both wrenches about the same point: of the exact one that is from its pole.
    const Real3 force = exact_.force - From(Eigen::Vector3d(contact.tail<3>()));
    const Real3 about_O = exact_.moment - Cross(O - exact_.pole, exact_.force);
    const Real3 moment = about_O - From(Eigen::Vector3d(contact.head<3>())) - Cross(arm, force);
    Add("floor force", static_cast<double>(Norm(force)), off.force);
    Add("floor moment", static_cast<double>(Norm(moment)), off.moment);
  }
  ZmpDrift ZmpAt(double height) const {
    return ZmpDrift::Over(robot_, motion_, {}, drift_, at_m_, halfstep::kGravity, height);
  }
  double SolesOff(const std::optional<Side>& only, double inside, const ZmpDrift& zmp) const {
    const halfstep::WalkState &x = motion_.jet.value, &off = motion_.off.value;
    const StandingHeights heights(x, only);
    double height = 0.0;
    for (const Side side : {Side::kLeft, Side::kRight}) {
      if (only && side != *only) continue;
      const int z = FootIndex(side) + 2;
      height = std::max(height, std::abs(x[z] - heights.of(side)) + off[z]);
    }
    const double pull = at_m_.contact().segment<2>(3).norm() + zmp.force_rest;
    return SupportRounding(x, off, robot_.sole_size, inside) +
           height * (1.0 + pull / zmp.least_push);
  }
  void Torques(const char* part, const FootLoads& loads, double zmp_moved, double soles_off,
               const std::array<Real3, 2>& on_right) {
    const TorqueDrift drift(motion_, drift_, at_m_, loads, zmp_moved, halfstep::kGravity,
                            soles_off);
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const size_t s = static_cast<size_t>(Index(side));
      const Vector6d torques = LegTorques(at_m_, side, loads.On(side, at_m_.contact()));
      const Vector6d bounds = drift.Of(side);
      const bool right = side == Side::kRight;
      const Real3 force = right ? on_right[0] : exact_.force - on_right[0];
      const Real3 moment = right ? on_right[1] : exact_.moment - on_right[1];
      for (size_t j = 0; j < 6; ++j) {
        const Eigen::Index i = static_cast<Eigen::Index>(j);
        Add(part, Apart(exact_.Torque(s, j, force, moment), torques[i]), bounds[i]);
      }
    }
  }
  void OnOneFoot(Side support) {
    const StandingHeights heights(motion_.jet.value, support);
    const double height = heights.middle();
    const Eigen::Vector2d zmp = *at_m_.Zmp(height);
    const ZmpDrift drift = ZmpAt(height);
    // In the plane of the exact sole, which need not be there.
    const auto there = exact_.Zmp(value_[static_cast<size_t>(FootIndex(support)) + 2]);
    Add("zmp", Norm2(there[0] - Real(zmp.x()), there[1] - Real(zmp.y())),
        drift.Most() + SolesOff(support, HUGE_VAL, drift));
    const auto higher = exact_.Zmp(Real(height) + Real(robot_.waist_height));
    const Eigen::Vector2d above = *at_m_.Zmp(height + robot_.waist_height);
    Add("zmp above", Norm2(higher[0] - Real(above.x()), higher[1] - Real(above.y())),
        drift.Raised(robot_.waist_height).Most());
    const bool right = support == Side::kRight;
    Torques("torque", FootLoads::OneFoot(support), 0.0, 0.0,
            right ? std::array{exact_.force, exact_.moment} : std::array<Real3, 2>{});
    const SupportPolygon polygon(FootPose(motion_.jet.value, support), robot_.sole_size);
    const auto friction = FootFriction::Of(at_m_, polygon, height);
    const Real needed = NeededFriction(exact_, value_, support, robot_.sole_size);
    if (!friction || needed < 0) return;
    const double off = SolesOff(support, friction->inside(), drift);
    const double more = std::max(0.0, static_cast<double>(needed - Real(friction->needed())));
    const double bound = friction->Drift(drift_, drift, off);
    Add("friction", more, std::isfinite(bound) ? bound : HUGE_VAL);
    const auto rate =
        ContactRate::Over(robot_, motion_, {}, drift_, at_m_, halfstep::kGravity, height);
    if (rate) Add("friction by rates", more, friction->Drift(*rate, off));
  }
  void OnBothFeet() {
    const halfstep::WalkState& x = motion_.jet.value;
    const StandingHeights heights(x, std::nullopt);
    const double left = heights.of(Side::kLeft), right = heights.of(Side::kRight);
    const std::array<Eigen::Vector2d, 2> zmps = {*at_m_.Zmp(left), *at_m_.Zmp(right)};
    const ZmpDrift drift = ZmpAt(heights.middle());
    const double half = 0.5 * heights.rise();
    const double moved = std::max(drift.Raised(half).Most(), drift.Raised(-half).Most());
    std::optional<FootLoads> loads;
    if (heights.level()) {
      loads = FootLoads::BothFeet(FootPose(x, Side::kLeft), FootPose(x, Side::kRight),
                                  robot_.sole_size, zmps[0]);
    } else {
      loads = FootLoads::OnLevels(x, heights, robot_.sole_size, zmps);
    }
    if (!loads) return;
    const auto on_right = OnRightFoot(exact_, value_, robot_.sole_size);
    Torques("torque shared", *loads, moved, SolesOff(std::nullopt, HUGE_VAL, drift), on_right);
  }

  const RobotModel& robot_;
  const IntervalMotion& motion_;
  const RobotDynamics& at_m_;
  const ExactDynamics& exact_;
  const ClosedFormWalk::Quantities& value_;
  RoundingTally& tally_;
  double of_bound_;
  RobotDrift drift_;
};

// The feet go with the waist, but for what leaves the joints of nearly stretched legs slow.
void SlowTheFeet(const RobotModel& robot, const Posture& posture, WalkJet* jet) {
  const double rate = jet->first[kWaistYaw], rate1 = jet->second[kWaistYaw];
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const Leg& leg = Nth(robot.legs, Index(side));
    const double reach = Nth(posture.ik, Index(side)).reach_margin;
    const double share = std::sqrt(std::max(reach, 0.0) / (leg.ankle_B - leg.hip_B).norm());
    const int f = FootIndex(side);
    const Eigen::Vector2d d = jet->value.segment<2>(f) - jet->value.segment<2>(kComX);
    const Eigen::Vector2d across(-d.y(), d.x());
    Eigen::Vector4d carried, carried1;
    carried << jet->first.segment<2>(kComX) + rate * across, jet->first[kWaistZ], rate;
    carried1 << jet->second.segment<2>(kComX) + rate1 * across - rate * rate * d,
        jet->second[kWaistZ], rate1;
    jet->first.segment<4>(f) = carried + share * (jet->first.segment<4>(f) - carried);
    jet->second.segment<4>(f) = carried1 + share * (jet->second.segment<4>(f) - carried1);
  }
}

}  // namespace

void DrawDynamics(const RobotModel& of, double scale, long draws, unsigned seed,
                  RoundingTally* tally, double of_bound) {
  const RobotModel robot = ScaledRobot(of, scale);
  const MotionBounds bounds(robot);
  Draw draw(seed);
  for (; draws > 0; --draws) {
    WalkJet jet = DrawPose(robot, scale, &draw), off;
    if (draw.Chance(0.3)) jet.value[kRightZ] = jet.value[kLeftZ];
    for (int q = 0; q < kNumQuantities; ++q) {
      const bool yaw = Nth(kQuantities, q).component == Component::kYaw;
      jet.second[q] = draw.Uniform(-5, 5) * (yaw ? 1.0 : scale);
    }
    const bool moved = draw.Chance(0.5);
    std::array<ClosedFormWalk::Quantities, 3> exact_walk{};
    const auto solve = [&](Posture* posture) {
      *posture = SolvePosture(robot, jet.value);
      return posture->reachable && SolveJointSpeeds(robot, jet, posture);
    };
    // The ZMP mostly comes to be about one foot, or between both.
    Posture posture;
    if (!solve(&posture)) continue;
    const bool slow = draw.Chance(0.5);
    if (slow) SlowTheFeet(robot, posture, &jet);
    if (!solve(&posture)) continue;
    const Side about = draw.Chance(0.5) ? Side::kLeft : Side::kRight;
    const double far = draw.Chance(0.3) ? draw.Uniform(-1, 1) : 0.3 * draw.Uniform(-1, 1);
    for (int round = 0; round < 3; ++round) {
      const RobotDynamics dynamics(robot, jet, posture, halfstep::kGravity);
      const int f = FootIndex(about);
      const auto zmp = dynamics.Zmp(jet.value[f + 2]);
      if (!zmp) break;
      const Eigen::Vector2d aim =
          jet.value.segment<2>(f) + far * robot.sole_size.norm() * Eigen::Vector2d(0.8, 0.6);
      const Eigen::Vector2d push = halfstep::kGravity / robot.waist_height * (*zmp - aim);
      for (const int q : {int{kComX}, int{kLeftX}, int{kRightX}}) {
        if (slow || q == kComX) jet.second.segment<2>(q) += push;
      }
    }
    for (int q = 0; q < kNumQuantities; ++q) {
      const size_t k = static_cast<size_t>(q);
      if (moved) off.value[q] = 1e-15 * std::abs(jet.value[q]);
      if (moved) off.first[q] = 1e-15 * scale;
      if (moved) off.second[q] = 1e-14 * scale;
      exact_walk[0][k] = Real(jet.value[q]) + Real(off.value[q]) * draw.Uniform(-1, 1);
      exact_walk[1][k] = Real(jet.first[q]) + Real(off.first[q]) * draw.Uniform(-1, 1);
      exact_walk[2][k] = Real(jet.second[q]) + Real(off.second[q]) * draw.Uniform(-1, 1);
    }
    IntervalMotion motion;
    bounds.Bound(jet, jet.second.cwiseAbs(), 0.0, &motion, &off);
    if (!motion.bounded) {
      tally->Add("zmp", 0.0, HUGE_VAL);
      continue;
    }
    const RobotDynamics at_m(robot, jet, motion.posture, halfstep::kGravity);
    std::array<ExactLeg, 2> legs;
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const size_t s = static_cast<size_t>(Index(side));
      legs[s] = SolveExactLeg(robot, side, exact_walk[0], exact_walk[1], motion.posture.ik[s].q);
    }
    if (!legs[0].found || !legs[1].found) continue;
    const ExactDynamics exact(robot, legs, exact_walk);
    DrawnDynamics(robot, motion, at_m, exact, exact_walk[0], tally, of_bound).Compare();
  }
}

}  // namespace halfstep::oracle
