// Whole walks over footholds of different height: what balance, friction and torque claim of
// intervals against what happens in them, and that a walk that is raised or mirrored is the same.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "opt/problem/derivative_check.h"
#include "smoothing/margins/slack_evaluator.h"
#include "smoothing/proof/certified_feasibility.h"
#include "smoothing/proof/interval_statements.h"
#include "tests/smoothing/certificate_draws.h"
#include "tests/smoothing/drawn_motion.h"
#include "wpg/motion/sole_shadows.h"
#include "wpg/robot/gravity.h"

namespace halfstep {
namespace {

constexpr std::array<MarginFamily, 3> kOfContact = {MarginFamily::kZmpRobot,
                                                    MarginFamily::kFriction, MarginFamily::kTorque};

// A plan in which a footstep is up to 15 cm (of HRP-2) higher or lower than the one before.
HalfStepSequence DrawOnLevels(const RobotModel& robot, WalkDraw* draw) {
  const double size = LegScale(robot), width = robot.standing_width;
  std::array<Foothold, 2> feet = {Foothold::Level({0, 0.5 * width, 0}),
                                  Foothold::Level({0, -0.5 * width, 0})};
  const std::array<Foothold, 2> start = feet;
  Side side = draw->Uniform(0, 1) < 0.5 ? Side::kLeft : Side::kRight;
  std::vector<Footstep> footsteps;
  for (int i = 0; i < 2; ++i, side = Opposite(side)) {
    Foothold& foot = feet[static_cast<size_t>(Index(side))];
    const Foothold& support = feet[static_cast<size_t>(Index(Opposite(side)))];
    const Pose2 X_SF{size * draw->Uniform(-0.05, 0.2),
                     Sign(side) * (width + size * draw->Uniform(0.0, 0.05)),
                     draw->Uniform(-0.2, 0.2)};
    const double from = foot.height - support.height, to = size * draw->Uniform(-0.15, 0.15);
    foot = support * Foothold(X_SF, to);
    footsteps.push_back({.side = side,
                         .X_WF = foot,
                         .via_height = std::max({0.0, from, to}) + size * draw->Uniform(0.03, 0.1),
                         .duration = std::sqrt(size) * draw->Uniform(1.2, 2.2)});
  }
  const HalfStepShape shape{.shift = draw->Uniform(0.05, 0.2),
                            .foot_delay = draw->Uniform(0.02, 0.2),
                            .crouch = 0.03 * size};
  return Moved(draw->Pose(1.0, 3.0), MakeSequence(start, footsteps, 1.1 * width, shape,
                                                  std::make_shared<Lipm>(robot.com_height)));
}

// The same walk on ground that is higher.
HalfStepSequence Raised(HalfStepSequence sequence, double by) {
  for (Foothold& foot : sequence.start) foot.height += by;
  for (PlacedHalfStep& placed : sequence.half_steps) placed.X_WS.height += by;
  return sequence;
}

// Nothing is demanded, so that bounds are told of all intervals.
MarginLimits NothingDemanded() {
  MarginLimits limits;
  limits.demanded.fill(-1e4);
  return limits;
}

// What a family claims of an interval; nothing where no bound is told.
std::optional<TightestStatement> ClaimOf(const MarginEvaluator& evaluator, MarginFamily family,
                                         const SuperposedWalk& walk, double begin, double length,
                                         const IntervalMotion& motion) {
  MarginScratch scratch = evaluator.MakeScratch();
  Instant mid(evaluator.place(), evaluator.limits(), walk, walk.Locate(begin + 0.5 * length),
              &scratch);
  std::vector<uint16_t> open = {0};
  const FamilyProof proof =
      evaluator.statements(family).Prove(MarginInterval(&mid, motion, true), &open);
  if (!open.empty() || !std::isfinite(proof.held.margin.value)) return std::nullopt;
  return proof.held;
}

double LeastAt(const MarginEvaluator& evaluator, MarginFamily family, const SuperposedWalk& walk,
               double t) {
  MarginScratch scratch = evaluator.MakeScratch();
  Instant at(evaluator.place(), evaluator.limits(), walk, walk.Locate(t), &scratch);
  return evaluator.statements(family).Least(&at, std::numeric_limits<double>::infinity()).value;
}

// Calls visit(sequence, walk, begin, length, motion) of intervals between knots; every other time
// both feet stand on different heights.
template <typename Visit>
void VisitOnLevels(const RobotModel& robot, int count, WalkDraw* draw, const Visit& visit) {
  const MotionBounds bounds(robot);
  int of_two = 0, of_one = 0;
  for (int i = 0; i < 20 * count && of_two + of_one < 6 * count; ++i) {
    const HalfStepSequence sequence = DrawOnLevels(robot, draw);
    const SuperposedWalk walk(sequence, Overlapped(sequence, draw->Uniform(0.0, 0.7)));
    for (int k = 0; k < 12; ++k) {
      const double length = 1e-4 * std::pow(200.0, draw->Uniform(0, 1));
      const double begin = draw->Uniform(0.0, walk.duration() - length);
      int& seen = walk.StepInAir(walk.Locate(begin + 0.5 * length)) < 0 ? of_two : of_one;
      if (seen >= 3 * count || !KnotsInside(walk, {begin, begin + length}).empty()) continue;
      IntervalMotion motion;
      BoundMotion(bounds, walk, begin, begin + length, &motion);
      if (!motion.bounded) continue;
      ++seen;
      visit(sequence, walk, begin, length, motion);
    }
  }
  EXPECT_GT(of_two, 2 * count) << robot.name;
  EXPECT_GT(of_one, 2 * count) << robot.name;
}

TEST(WalksOnLevels, KeepWhatIsClaimedOfIntervals) {
  for (const char* name : {"hrp2", "wren"}) {
    const MarginEvaluator evaluator(ShippedRobot(name), {}, NothingDemanded());
    const RobotModel& robot = evaluator.robot();
    WalkDraw draw(920);
    std::map<MarginFamily, int> claims;
    std::map<MarginFamily, double> share;
    double without_heights = 0.0;
    VisitOnLevels(robot, Draws(40), &draw,
                  [&](const HalfStepSequence&, const SuperposedWalk& walk, double begin,
                      double length, const IntervalMotion& motion) {
                    for (const MarginFamily family : kOfContact) {
                      const auto claim = ClaimOf(evaluator, family, walk, begin, length, motion);
                      if (!claim) continue;
                      ++claims[family];
                      for (const double part : {1e-9, 0.25, 0.7, 1.0 - 1e-9}) {
                        const double truth =
                            LeastAt(evaluator, family, walk, begin + part * length);
                        ASSERT_GE(truth, claim->margin.value - claim->bound)
                            << name << ": " << Name(family) << " at " << begin << " + " << length;
                        if (claim->bound > 1e-5) {
                          share[family] =
                              std::max(share[family], (claim->margin.value - truth) / claim->bound);
                        }
                      }
                    }
                    // Control: with heights ignored, on the third of three such steps.
                    const WalkState& x = motion.jet.value;
                    const RobotDynamics at(robot, motion.jet, motion.posture, kGravity);
                    if (!at.Zmp() || walk.StepInAir(walk.Locate(begin + 0.5 * length)) >= 0) return;
                    const SupportPolygon polygon(FootPose(x, Side::kLeft),
                                                 FootPose(x, Side::kRight), robot.sole_size);
                    const SoleShadows shadows(x, {x, std::nullopt}, robot.sole_size, at);
                    const Eigen::Vector2d zmp = *at.Zmp(-0.45 * LegScale(robot));
                    without_heights =
                        std::max(without_heights, std::abs(polygon.Margin(zmp) - shadows.Margin()));
                  });
    for (const MarginFamily family : kOfContact) {
      if (family == MarginFamily::kTorque && std::string(name) == "hrp2") continue;  // no limits
      EXPECT_GT(claims[family], Draws(40)) << name << ": " << Name(family);
      EXPECT_GT(share[family], kFewDraws ? 0.2 : 0.4) << name << ": " << Name(family);
      EXPECT_LE(share[family], 1.0) << name << ": " << Name(family);
    }
    EXPECT_GT(without_heights, 0.01 * LegScale(robot)) << name;
  }
}

TEST(WalksOnLevels, AreTheSameRaisedOrMirrored) {
  const MarginEvaluator evaluator(ShippedRobot("wren"), {}, NothingDemanded());
  const RobotModel& robot = evaluator.robot();
  const MotionBounds bounds(robot);
  WalkDraw draw(930);
  int compared = 0;
  VisitOnLevels(
      robot, Draws(15), &draw,
      [&](const HalfStepSequence& sequence, const SuperposedWalk& walk, double begin, double length,
          const IntervalMotion& motion) {
        for (const bool mirrored : {false, true}) {
          const SuperposedWalk other(mirrored ? Mirrored(sequence) : Raised(sequence, 0.7),
                                     walk.parameters());
          IntervalMotion of_other;
          BoundMotion(bounds, other, begin, begin + length, &of_other);
          for (const MarginFamily family : kOfContact) {
            const auto claim = ClaimOf(evaluator, family, walk, begin, length, motion),
                       there = ClaimOf(evaluator, family, other, begin, length, of_other);
            ASSERT_EQ(claim.has_value(), there.has_value()) << Name(family);
            if (!claim) continue;
            ++compared;
            const double size = 1.0 + std::abs(claim->margin.value);
            EXPECT_NEAR(claim->margin.value, there->margin.value, 1e-8 * size) << Name(family);
            // What rounding does goes by how high the floor is.
            EXPECT_NEAR(claim->bound, there->bound, 1e-7 * (size + claim->bound)) << Name(family);
          }
        }
      });
  EXPECT_GT(compared, Draws(15) * 4);
}

TEST(WalksOnLevels, RowsOfTheirBalanceHaveTheSlopesOfDifferences) {
  const MarginEvaluator evaluator(ShippedRobot("hrp2"), {}, {});
  WalkDraw draw(940);
  int compared = 0, kinks = 0;
  for (int i = 0; i < Draws(20); ++i) {
    const HalfStepSequence sequence = DrawOnLevels(evaluator.robot(), &draw);
    const HomotopyParameters parameters = Overlapped(sequence, draw.Uniform(0.1, 0.6));
    const SuperposedWalk walk(sequence, parameters);
    const LocalTime at = walk.Locate(draw.Uniform(0.05, walk.duration() - 0.05));
    if (walk.StepInAir(at) >= 0 || NearKnot(walk, walk.Absolute(at), 1e-3)) continue;
    if (!MovingPosture(evaluator.robot(), walk.At(at))) continue;
    const auto slacks_at = [&](const SuperposedWalk& of, InstantSlacks* slacks) {
      SlackEvaluator rows(evaluator, 1e9, {}, true);
      rows.At(of, at, {}, true, slacks);
    };
    const auto balance = [](const InstantSlacks& slacks) {
      std::vector<Eigen::Index> rows;
      for (size_t r = 0; r < slacks.rows.size(); ++r) {
        if (slacks.rows[r].family == MarginFamily::kZmpRobot) {
          rows.push_back(static_cast<Eigen::Index>(r));
        }
      }
      return rows;
    };
    InstantSlacks here;
    slacks_at(walk, &here);
    const auto rows = balance(here);
    if (rows.empty()) continue;
    for (size_t p = 0; p < here.parameters.size(); ++p) {
      const HomotopyParameter& parameter = here.parameters[p];
      const auto function = [&](const Eigen::VectorXd& h) -> Eigen::VectorXd {
        Eigen::VectorXd values =
            Eigen::VectorXd::Constant(static_cast<Eigen::Index>(rows.size()), std::nan(""));
        HomotopyParameters there = parameters;
        parameter.in(there) += h[0];
        InstantSlacks slacks;
        slacks_at(SuperposedWalk(sequence, there), &slacks);
        const auto same = balance(slacks);
        if (same.size() != rows.size()) return values;
        for (size_t r = 0; r < rows.size(); ++r) {
          values[static_cast<Eigen::Index>(r)] = slacks.rows[static_cast<size_t>(same[r])].slack;
        }
        return values;
      };
      const Eigen::MatrixXd slopes = here.gradient(rows, {static_cast<Eigen::Index>(p)});
      // At the ends of their ranges parameters go one way only.
      try {
        const DerivativeReport report =
            CheckJacobian(function, Eigen::VectorXd::Zero(1), slopes, 1e-6);
        ++compared;
        if (!report.Passed(1e-5)) ++kinks;
      } catch (const std::logic_error&) {
      }
    }
  }
  EXPECT_GT(compared, Draws(20) * 3);
  EXPECT_LE(kinks, compared / 30);
}

}  // namespace
}  // namespace halfstep
