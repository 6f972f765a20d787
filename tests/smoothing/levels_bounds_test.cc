// Two soles at different heights: slopes of what families say there against differences, and bounds
// of margins, friction and torques against what happens, on motions in which few things move.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>

#include "opt/problem/derivative_check.h"
#include "smoothing/margins/margin_evaluator.h"
#include "tests/smoothing/drawn_motion.h"
#include "tests/smoothing/excess_tally.h"
#include "tests/smoothing/hand_made_motion.h"
#include "tests/smoothing/robot_truth.h"
#include "wpg/motion/contact_rate.h"
#include "wpg/motion/foot_friction.h"
#include "wpg/motion/foot_loads.h"
#include "wpg/motion/leg_torques.h"
#include "wpg/motion/sole_shadows.h"
#include "wpg/motion/torque_drift.h"
#include "wpg/motion/zmp_drift.h"

namespace halfstep {
namespace {

constexpr double kPullDown = HandMadeInterval::kGravity;

// Soles that rest under a motion, where the line of the ZMPs is between them at its midpoint: as
// with DrawnFloor, where the robot's feet are has no part in it.
struct DrawnLevels {
  WalkState x = WalkState::Zero();
  Eigen::Vector2d sole_size{0, 0};
  StandingHeights heights{x, std::nullopt};

  static DrawnLevels Draw(const RobotDynamics& now, double size, WalkDraw* draw) {
    DrawnLevels levels;
    levels.sole_size = {0.25 * size, 0.15 * size};
    WalkState& x = levels.x;
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const int foot = FootIndex(side);
      x[foot] = size * draw->Uniform(-0.15, 0.15);
      x[foot + 1] = size * (0.12 * Sign(side) + draw->Uniform(-0.05, 0.05));
      x[foot + 2] = size * draw->Uniform(-0.2, 0.2);
      x[foot + 3] = draw->Uniform(-1, 1);
    }
    levels.heights = {x, std::nullopt};
    const double share = draw->Uniform(-0.2, 1.2);
    const Eigen::Vector3d point =
        (1.0 - share) * x.segment<3>(kLeftX) + share * x.segment<3>(kRightX);
    const Eigen::Vector2d away = *now.Zmp(point.z()) - point.head<2>();
    for (const Side side : {Side::kLeft, Side::kRight}) x.segment<2>(FootIndex(side)) += away;
    return levels;
  }
  SoleShadows Shadows(const RobotDynamics& at) const { return {x, heights, sole_size, at}; }
  std::optional<FootLoads> Loads(const RobotDynamics& at) const {
    return FootLoads::OnLevels(
        x, heights, sole_size,
        {*at.Zmp(heights.of(Side::kLeft)), *at.Zmp(heights.of(Side::kRight))});
  }
};

void CompareOnLevels(const RobotModel& robot, const HandMadeMotion& motion,
                     const HandMadeInterval& made, double t, double size, WalkDraw* draw,
                     ExcessTally* tally) {
  const RobotDynamics& now = *made.at_m;
  if (!now.Zmp() || !(now.contact()[5] > 1e-3)) return;
  const RobotDynamics then = made.At(t);
  if (!then.Zmp()) return;
  const DrawnLevels levels = DrawnLevels::Draw(now, size, draw);
  const double middle = levels.heights.middle(), half_rise = 0.5 * levels.heights.rise();
  const RobotDrift drift(robot, made.interval, motion.Thirds(), now, kPullDown);
  const ZmpDrift by_norms =
      ZmpDrift::Over(robot, made.interval, motion.Thirds(), drift, now, kPullDown, middle);
  const auto rate =
      ContactRate::Over(robot, made.interval, motion.Thirds(), drift, now, kPullDown, middle);
  const double wrench = now.contact().norm() + then.contact().norm() + robot.masses.waist.mass;
  const double relative = wrench / then.contact()[5] + wrench / now.contact()[5];
  const double angle = draw->Uniform(0, 6.3);
  const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
  const SoleShadows here = levels.Shadows(now), there = levels.Shadows(then);
  const auto friction = FootFriction::OnLevels(now, levels.x, levels.heights, levels.sole_size);
  const auto by_way = [&](std::string_view of_margin, std::string_view of_zmp,
                          std::string_view control, std::string_view of_friction,
                          const ZmpDrift& zmp, double grows) {
    if (!(zmp.least_push > 0.0)) return;
    for (const double up : {-half_rise, half_rise}) {
      const double moved = std::abs(along.dot(*then.Zmp(middle + up) - *now.Zmp(middle + up)));
      tally->Compare(of_zmp, moved, zmp.Raised(up).Along(along), relative);
      tally->Compare(control, moved, zmp.Along(along), relative);
    }
    if (here.Margin() > 0.0) {
      tally->Compare(of_margin, here.Margin() - there.Margin(), here.Margin() - here.LeastOver(zmp),
                     relative);
    }
    if (!friction || !std::isfinite(grows)) return;
    const auto needed = FootFriction::OnLevels(then, levels.x, levels.heights, levels.sole_size);
    ASSERT_TRUE(needed);
    tally->Compare(of_friction, needed->needed() - friction->needed(), grows,
                   100.0 * relative / size + needed->needed() * relative);
  };
  const double up = friction ? friction->height() - middle : 0.0;
  by_way("margin by norms", "ZMP by norms", "control by norms", "friction by norms", by_norms,
         friction ? friction->Drift(drift, by_norms.Raised(up)) : 0.0);
  if (rate) {
    by_way("margin by rates", "ZMP by rates", "control by rates", "friction by rates",
           ZmpDrift::At(*rate, now.contact()[5]),
           friction ? friction->Drift(rate->Raised(up)) : 0.0);
  }
  const auto loads = levels.Loads(now);
  if (!loads) return;
  const double zmp_moved =
      std::max(by_norms.Raised(-half_rise).Most(), by_norms.Raised(half_rise).Most());
  const TorqueDrift of(made.interval, drift, now, *loads, zmp_moved, kPullDown);
  const auto loads_then = levels.Loads(then);
  if (!std::isfinite(loads->ShareDrift(zmp_moved))) return;
  ASSERT_TRUE(loads_then);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const Vector6d bound = of.Of(side);
    const Vector6d moved = LegTorques(then, side, loads_then->On(side, then.contact())) -
                           LegTorques(now, side, loads->On(side, now.contact()));
    for (Eigen::Index j = 0; j < 6; ++j) {
      tally->Compare("torque", std::abs(moved[j]), bound[j], 10 * wrench);
    }
  }
}

TEST(OnLevels, SparseMotionsKeepEveryBound) {
  unsigned seed = 900;
  for (WholeRobot& whole : WholeRobots()) {
    RobotModel& robot = whole.model;
    const double size = std::min(1.0, LegScale(robot));
    WalkDraw draw(seed++);
    ExcessTally tally;
    for (int i = 0; i < Draws(800); ++i) {
      DrawSparseMasses(&robot, &draw);
      const HandMadeMotion motion = DrawSparseMotion(robot, size, &draw);
      const double h = 5e-5 * std::pow(300, draw.Uniform(0, 1));
      const HandMadeInterval made(robot, motion, h);
      if (!made.bounded()) continue;
      for (const double t : {-h, h}) {
        CompareOnLevels(robot, motion, made, t, size, &draw, &tally);
      }
    }
    EXPECT_EQ(tally.parts.size(), 9u);
    for (const auto& [what, part] : tally.parts) {
      EXPECT_GT(part.compared, Draws(800) / 8) << robot.name << ": " << what;
      if (what.starts_with("control")) {
        if (!kFewDraws) {
          EXPECT_GT(part.excess, 1.0) << robot.name << ": " << what;
        }
        continue;
      }
      EXPECT_LT(part.excess, 1.0) << robot.name << ": " << what;
      if (kFewDraws) continue;  // few draws come near to nothing
      EXPECT_GT(part.nearest, 0.8) << robot.name << ": " << what;
    }
  }
}

// A robot with both feet on different heights, in a walk that says no more than that both stand.
struct OnTwoLevels {
  MarginEvaluator evaluator;
  SuperposedWalk walk;
  WalkJet jet;

  static OnTwoLevels Draw(const RobotModel& robot, WalkDraw* draw) {
    MarginLimits limits;
    const HalfStepSequence sequence = DrawSequence(robot, 1, {.stride = 0.5}, draw);
    OnTwoLevels drawn{
        MarginEvaluator(robot, {}, limits), SuperposedWalk(sequence, PlannedMotion(sequence)), {}};
    const double size = LegScale(robot);
    drawn.jet = drawn.walk.At(0.0);
    for (const Side side : {Side::kLeft, Side::kRight}) {
      drawn.jet.value[FootIndex(side) + 2] = size * draw->Uniform(0.0, 0.15);
      drawn.jet.value[FootIndex(side)] += size * draw->Uniform(-0.1, 0.1);
    }
    for (const int q : {static_cast<int>(kComX), static_cast<int>(kComY)}) {
      drawn.jet.value[q] += size * draw->Uniform(-0.03, 0.03);
      drawn.jet.first[q] = draw->Uniform(-0.3, 0.3);
      drawn.jet.second[q] = draw->Uniform(-0.5, 0.5);
    }
    drawn.jet.second[kWaistYaw] = draw->Uniform(-3, 3);
    return drawn;
  }
  // The slacks of a family there, and their slopes along `rates` where these are given.
  struct Rows {
    Eigen::VectorXd slacks;
    Eigen::MatrixXd slopes;
  };
  std::optional<Rows> RowsOf(MarginFamily family, const WalkJet& at, const WalkJet* rates) const {
    const auto posture = MovingPosture(evaluator.robot(), at);
    if (!posture) return std::nullopt;
    MarginScratch scratch = evaluator.MakeScratch();
    Instant instant(evaluator.place(), evaluator.limits(), walk, {0, 0.0}, at, *posture, &scratch);
    SlackSink sink(1e9);
    if (rates != nullptr) {
      sink.sensitivities.push_back({{ParameterFamily::kOverlap, 0}, *rates});
    }
    sink.Begin(family, 0.0);
    evaluator.statements(family).AddRows(&instant, &sink);
    Rows rows;
    rows.slacks.resize(static_cast<Eigen::Index>(sink.rows().size()));
    for (size_t i = 0; i < sink.rows().size(); ++i) {
      rows.slacks[static_cast<Eigen::Index>(i)] = sink.rows()[i].slack;
    }
    if (rates != nullptr) rows.slopes = sink.Gradient();
    return rows;
  }
};

TEST(OnLevels, FamiliesHaveTheSlopesOfDifferences) {
  for (const char* name : {"hrp2", "wren"}) {
    const RobotModel robot = ShippedRobot(name);
    WalkDraw draw(910);
    std::map<MarginFamily, int> compared, kinks;
    for (int i = 0; i < Draws(60); ++i) {
      const OnTwoLevels drawn = OnTwoLevels::Draw(robot, &draw);
      for (const MarginFamily family :
           {MarginFamily::kZmpRobot, MarginFamily::kFriction, MarginFamily::kTorque}) {
        WalkJet rates = DrawnRates(&draw);
        for (const Side side : {Side::kLeft, Side::kRight}) {
          const int foot = FootIndex(side);
          rates.first.segment<4>(foot).setZero();
          rates.second.segment<4>(foot).setZero();
          // Of footsteps that move, the ZMP's polygon alone has slopes.
          if (family != MarginFamily::kZmpRobot) rates.value.segment<4>(foot).setZero();
        }
        const auto here = drawn.RowsOf(family, drawn.jet, &rates);
        if (!here || here->slacks.size() == 0) continue;
        const auto function = [&](const Eigen::VectorXd& h) -> Eigen::VectorXd {
          const auto there = drawn.RowsOf(family, Along(drawn.jet, h[0], rates), nullptr);
          if (!there || there->slacks.size() != here->slacks.size()) {
            return Eigen::VectorXd::Constant(here->slacks.size(), std::nan(""));
          }
          return there->slacks;
        };
        const Eigen::VectorXd zero = Eigen::VectorXd::Zero(1);
        const DerivativeReport report = CheckJacobian(function, zero, here->slopes, 1e-6);
        ++compared[family];
        if (!report.Passed(1e-5)) {
          // A sole's edge or another direction takes over, or the yaw moment is zero.
          ++kinks[family];
          continue;
        }
        Eigen::MatrixXd wrong = here->slopes;
        wrong(0, 0) += 1e-3 + 0.01 * std::abs(wrong(0, 0));
        EXPECT_FALSE(CheckJacobian(function, zero, wrong, 1e-6).Passed(1e-5));
      }
    }
    EXPECT_EQ(compared.size(), name == std::string("hrp2") ? 2u : 3u) << name;
    for (const auto& [family, count] : compared) {
      EXPECT_GT(count, Draws(60) / 3) << name << ": " << Name(family);
      EXPECT_LE(kinks[family], 1 + count / 15) << name << ": " << Name(family);
    }
  }
}

}  // namespace
}  // namespace halfstep
