// What the feet carry, joint torques and friction of the whole robot: against forces of point
// masses by differences, slopes against differences, drifts over intervals against dense samples.

#include <gtest/gtest.h>

#include <optional>

#include "opt/problem/derivative_check.h"
#include "smoothing/proof/certified_feasibility.h"
#include "smoothing/walk/posture_tangent.h"
#include "tests/smoothing/drawn_motion.h"
#include "tests/smoothing/robot_truth.h"
#include "wpg/geometry/support_polygon.h"
#include "wpg/motion/contact_gradient.h"
#include "wpg/motion/foot_friction.h"
#include "wpg/motion/foot_loads.h"
#include "wpg/motion/leg_torques.h"
#include "wpg/motion/torque_drift.h"

namespace halfstep {
namespace {

constexpr double kG = 9.81;
constexpr std::array<Side, 2> kSides = {Side::kLeft, Side::kRight};

// A robot at an instant, and which foot stands alone.
struct Carried {
  Posture posture;
  std::optional<RobotDynamics> dynamics;
  std::optional<FootLoads> loads;

  // Unsolved where a leg does not reach, or comes near to stretched.
  Carried(const RobotModel& robot, const WalkJet& jet, const std::optional<Side>& support) {
    const auto moving = MovingPosture(robot, jet);
    if (!moving) return;
    posture = *moving;
    dynamics.emplace(robot, jet, posture, kG);
    const auto zmp = dynamics->Zmp();
    if (!zmp) return;
    loads = support ? FootLoads::OneFoot(*support)
                    : FootLoads::BothFeet(FootPose(jet.value, Side::kLeft),
                                          FootPose(jet.value, Side::kRight), robot.sole_size, *zmp);
  }
  bool solved() const { return loads.has_value(); }
  Eigen::VectorXd Torques() const {
    Eigen::VectorXd torques(12);
    for (const Side side : kSides) {
      torques.segment<6>(6 * Index(side)) =
          LegTorques(*dynamics, side, loads->On(side, dynamics->contact()));
    }
    return torques;
  }
};

std::optional<Side> SupportOf(const SuperposedWalk& walk, double t) {
  const int step = walk.StepInAir(walk.Locate(t));
  if (step < 0) return std::nullopt;
  return walk.half_step(2 * step).support;
}

// Soles side by side, one of them turned.
struct TwoSoles {
  Pose2 left{0.0, 0.1, 0.2}, right{0.05, -0.1, 0.0};
  Eigen::Vector2d size{0.2, 0.12};

  FootLoads At(const Eigen::Vector2d& zmp) const {
    return FootLoads::BothFeet(left, right, size, zmp);
  }
};

TEST(FootLoads, AFootWhoseSoleHasTheZmpCarriesAll) {
  const TwoSoles soles;
  const Vector6d contact = (Vector6d() << 3, -4, 5, 20, -10, 600).finished();
  EXPECT_EQ(soles.At({0.05, -0.12}).On(Side::kRight, contact), contact);
  EXPECT_EQ(soles.At({0.05, -0.12}).On(Side::kLeft, contact), Vector6d::Zero());
  EXPECT_EQ(soles.At({0.0, 0.12}).On(Side::kLeft, contact), contact);
  EXPECT_EQ(FootLoads::OneFoot(Side::kRight).On(Side::kRight, contact), contact);
}

TEST(FootLoads, AddUpAndPutBothZmpsAsFarFromTheirSoles) {
  const TwoSoles soles;
  WalkDraw draw(770);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector2d zmp(draw.Uniform(-0.1, 0.1), draw.Uniform(-0.15, 0.15));
    Vector6d contact = Vector6d::Random();
    contact[5] = 600;
    contact[0] = zmp.y() * contact[5];
    contact[1] = -zmp.x() * contact[5];
    const FootLoads loads = soles.At(zmp);
    const Vector6d left = loads.On(Side::kLeft, contact), right = loads.On(Side::kRight, contact);
    EXPECT_LT((left + right - contact).norm(), 1e-10);
    EXPECT_NEAR(left[5], loads.share(Side::kLeft) * contact[5], 1e-10);
    if (std::min(left[5], right[5]) < 1.0) continue;
    const auto zmp_of = [](const Vector6d& w) -> Eigen::Vector2d {
      return Eigen::Vector2d(-w[1], w[0]) / w[5];
    };
    EXPECT_LT(
        ((zmp_of(left) - soles.left.position()) - (zmp_of(right) - soles.right.position())).norm(),
        1e-10);
  }
}

TEST(FootLoads, SharesDriftByNoMoreThanIsSaid) {
  const TwoSoles soles;
  WalkDraw draw(771);
  double excess = -1, nearest = 0;
  for (int i = 0; i < Draws(3000); ++i) {
    const Eigen::Vector2d zmp(draw.Uniform(-0.15, 0.15), draw.Uniform(-0.2, 0.2));
    const double moved = std::pow(10.0, draw.Uniform(-4, -1)), angle = draw.Uniform(0, 6.3);
    const FootLoads here = soles.At(zmp);
    const Eigen::Vector2d there = zmp + moved * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    const double change = std::abs(soles.At(there).share(Side::kRight) - here.share(Side::kRight));
    const double drift = here.ShareDrift(moved);
    excess = std::max(excess, change - drift);
    if (change > 1e-6) nearest = std::max(nearest, change / drift);
  }
  EXPECT_LT(excess, 1e-12);
  EXPECT_GT(nearest, 0.95);
}

// The power that joints give is that by which the energy of point masses grows: with the feet's
// wrenches on soles that rest, none of it comes from the floor.
TEST(LegTorques, AreThoseOfForcesOnPointMasses) {
  constexpr double kStep = 4e-3;
  unsigned seed = 780;
  for (const WholeRobot& whole : WholeRobots()) {
    const RobotModel& robot = whole.model;
    const PointMasses points(whole);
    WalkDraw draw(seed++);
    int compared = 0;
    double worst = 0, largest = 0;
    for (int i = 0; i < Draws(100); ++i) {
      const SuperposedWalk walk = DrawnWalkOf(robot, &draw);
      const double t = draw.Uniform(0.05, walk.duration() - 0.05);
      if (NearKnot(walk, t, 5 * kStep)) continue;
      const Carried at(robot, walk.At(t), SupportOf(walk, t));
      if (!at.solved()) continue;
      ++compared;
      const Eigen::VectorXd torques = at.Torques();
      for (const Side side : kSides) {
        const size_t s = static_cast<size_t>(Index(side));
        const Vector6d foot = at.loads->On(side, at.dynamics->contact());
        for (size_t j = 0; j < 6; ++j) {
          const Eigen::Vector3d point = at.posture.X_WB * at.posture.frames[s].point_B[j];
          const Eigen::Vector3d axis = at.posture.X_WB.linear() * at.posture.frames[s].axis_B[j];
          const Eigen::Vector3d of_floor =
              foot.head<3>() - (point - at.dynamics->O()).cross(foot.tail<3>());
          const Eigen::Vector3d moment =
              points.MomentBeyond(
                  side, j, point, [&](double dt) { return walk.At(t + dt).value; }, kStep, kG) -
              of_floor;
          const double torque = torques[6 * Index(side) + static_cast<int>(j)];
          worst = std::max(worst, std::abs(torque - axis.dot(moment)));
          largest = std::max(largest, std::abs(torque));
        }
      }
    }
    EXPECT_GT(compared, Draws(100) / 3) << robot.name;
    EXPECT_LT(worst, 1e-6) << robot.name;  // of differences of 100 m/s², on some kilograms
    EXPECT_GT(largest, 0.3 * robot.mass) << robot.name;
  }
}

TEST(LegTorques, AndFrictionHaveTheSlopesOfDifferences) {
  unsigned seed = 790;
  for (const WholeRobot& whole : WholeRobots()) {
    const RobotModel& robot = whole.model;
    WalkDraw draw(seed++);
    int single = 0, both = 0, kinks = 0;
    for (int i = 0; i < Draws(100); ++i) {
      const SuperposedWalk walk = DrawnWalkOf(robot, &draw);
      const double t = draw.Uniform(0, walk.duration());
      const WalkJet jet = walk.At(t);
      const auto support = SupportOf(walk, t);
      const Carried at(robot, jet, support);
      if (!at.solved()) continue;
      WalkJet along = DrawnRates(&draw);
      // Footsteps do not move.
      for (const Side side : kSides) {
        if (!support || *support == side) along.value.segment<4>(FootIndex(side)).setZero();
      }
      const SupportPolygon polygon = SupportAt(walk, walk.Locate(t), jet.value, robot.sole_size);
      const auto friction = FootFriction::Of(*at.dynamics, polygon);
      const PostureTangent tangent = Differentiate(robot, jet, at.posture, along);
      const DynamicsTangent of{along, tangent.q, tangent.speeds};
      const DynamicsSlope slope(robot, jet, at.posture, *at.dynamics, of);
      const Eigen::Vector2d zmp = at.dynamics->ZmpSlope(slope.contact());
      // What is pulled back is the transpose of what is pushed forward.
      const Eigen::Vector2d weights(0.6, -0.8);
      const ContactGradient by(robot, jet, at.posture, *at.dynamics,
                               at.dynamics->ZmpGradient(weights));
      double pulled = Product(by.jet, along);
      for (const size_t s : {0, 1}) {
        pulled += by.q[s].dot(of.q[s]) + by.speeds[s].dot(of.speeds[s]);
      }
      EXPECT_NEAR(pulled, zmp.dot(weights), 1e-10 * (1 + zmp.norm()));
      Eigen::MatrixXd slopes(13, 1);
      const Vector6d& contact = at.dynamics->contact();
      for (const Side side : kSides) {
        slopes.block<6, 1>(6 * Index(side), 0) =
            LegTorqueSlopes(*at.dynamics, slope, side, at.loads->On(side, contact),
                            at.loads->SlopeOn(side, contact, slope.contact(), zmp));
      }
      // In units of 100 N m, as the friction coefficient is of the order of 1.
      slopes *= 0.01;
      slopes(12, 0) = friction ? friction->Slope(slope.contact()) : 0.0;
      const auto function = [&](const Eigen::VectorXd& h) -> Eigen::VectorXd {
        Eigen::VectorXd values = Eigen::VectorXd::Constant(13, std::nan(""));
        const Carried there(robot, Along(jet, h[0], along), support);
        if (!there.solved()) return values;
        values.head<12>() = 0.01 * there.Torques();
        const auto needed = FootFriction::Of(*there.dynamics, polygon);
        values[12] = friction && needed ? needed->needed() : 0.0;
        return values;
      };
      // Friction has no slope where the yaw moment or the pull is zero, or another edge is as far;
      // near there differences need short steps.
      constexpr double kStep = 1e-6;
      const Eigen::VectorXd here = Eigen::VectorXd::Zero(1);
      const DerivativeReport report = CheckJacobian(function, here, slopes, kStep);
      if (report.row == 12 && !report.Passed(1e-6)) {
        ++kinks;
        continue;
      }
      EXPECT_TRUE(report.Passed(1e-6)) << robot.name << ": " << report.Describe();
      ++(support ? single : both);
      for (const Eigen::Index broken : {0, 9, 12}) {
        Eigen::MatrixXd wrong = slopes;
        wrong(broken, 0) += 1e-3 + 0.01 * std::abs(wrong(broken, 0));
        EXPECT_FALSE(CheckJacobian(function, here, wrong, kStep).Passed(1e-6)) << broken;
      }
    }
    EXPECT_LE(kinks, 1 + Draws(100) / 30) << robot.name;
    EXPECT_GT(single, Draws(100) / 12) << robot.name;
    EXPECT_GT(both, Draws(100) / 20) << robot.name;
  }
}

TEST(TorqueDrift, AndThatOfFrictionAreNeverExceededOnRandomIntervals) {
  unsigned seed = 800;
  for (const WholeRobot& whole : WholeRobots()) {
    const RobotModel& robot = whole.model;
    WalkDraw draw(seed++);
    int intervals = 0;
    std::array<double, 2> excess = {-1, -1}, nearest = {0, 0}, friction_excess = {-1, -1},
                          friction_nearest = {0, 0};
    VisitIntervals(
        robot, Draws(100), 10, &draw,
        [&](const SuperposedWalk& walk, double begin, double length, const IntervalMotion& motion) {
          const auto support = SupportOf(walk, begin + 0.5 * length);
          if (!motion.bounded || !KnotsInside(walk, {begin, begin + length}).empty()) return;
          const Carried at(robot, motion.jet, support);
          if (!at.solved()) return;
          ++intervals;
          const WalkThirds thirds = walk.ThirdRanges(begin, begin + length);
          const RobotDrift drift(robot, motion, thirds, *at.dynamics, kG);
          const ZmpDrift zmp = ZmpDrift::Over(robot, motion, thirds, drift, *at.dynamics, kG);
          const TorqueDrift torque_drift(motion, drift, *at.dynamics, *at.loads, zmp.Most(), kG);
          const Eigen::VectorXd middle = at.Torques();
          Eigen::VectorXd drifts(12);
          for (const Side side : kSides) drifts.segment<6>(6 * Index(side)) = torque_drift.Of(side);
          const SupportPolygon polygon =
              SupportAt(walk, walk.Locate(begin + 0.5 * length), motion.jet.value, robot.sole_size);
          const auto friction = FootFriction::Of(*at.dynamics, polygon);
          const double friction_drift = friction ? friction->Drift(drift, zmp) : 0.0;
          // No bound where the ZMP may leave by an edge along the pressure's points.
          const Eigen::Vector2d p = *at.dynamics->Zmp();
          const double across = 0.5 * zmp.Along({0, 1}), ahead = 1.0 + 2.0 * zmp.Most();
          if (across > 1e-9 && std::isfinite(ahead)) {
            const SupportPolygon thin({p.x(), p.y(), 0.0}, {2.0 * ahead, 2.0 * across});
            EXPECT_TRUE(std::isinf(FootFriction::Of(*at.dynamics, thin).value().Drift(drift, zmp)));
          }
          const size_t which = support ? 0 : 1;
          for (const double part : {0.0, draw.Uniform(0, 1), draw.Uniform(0, 1), 1.0}) {
            const WalkJet jet = walk.At(begin + part * length);
            Posture posture = SolvePosture(robot, jet.value);
            ASSERT_TRUE(posture.reachable && SolveJointSpeeds(robot, jet, &posture));
            const Carried there(robot, jet, support);
            if (!there.solved()) continue;
            const Eigen::VectorXd moved = (there.Torques() - middle).cwiseAbs();
            for (int j = 0; j < 12; ++j) {
              excess[which] = std::max(excess[which], moved[j] - drifts[j]);
              if (moved[j] > 1e-3) nearest[which] = std::max(nearest[which], moved[j] / drifts[j]);
            }
            const auto needed = FootFriction::Of(*there.dynamics, polygon);
            if (!friction || !std::isfinite(friction_drift)) continue;
            ASSERT_TRUE(needed) << robot.name;
            const double grown = needed->needed() - friction->needed();
            friction_excess[which] = std::max(friction_excess[which], grown - friction_drift);
            if (grown > 1e-5) {
              friction_nearest[which] = std::max(friction_nearest[which], grown / friction_drift);
            }
          }
        });
    EXPECT_GT(intervals, Draws(100)) << robot.name;
    for (const size_t which : {0u, 1u}) {
      EXPECT_LT(excess[which], 1e-7) << robot.name;
      EXPECT_LT(friction_excess[which], 1e-9) << robot.name;
      RecordProperty(robot.name + "_nearest_percent_" + std::to_string(which),
                     static_cast<int>(100 * nearest[which]));
      RecordProperty(robot.name + "_friction_nearest_percent_" + std::to_string(which),
                     static_cast<int>(100 * friction_nearest[which]));
      // By norms, but for what weights do: half of a bound, or a term forgotten, shows.
      EXPECT_GT(nearest[which], kFewDraws ? 0.2 : 0.4) << robot.name;
      EXPECT_GT(friction_nearest[which], kFewDraws ? 0.1 : 0.15) << robot.name;
    }
  }
}

}  // namespace
}  // namespace halfstep
