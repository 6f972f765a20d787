// Legs whose axes miss each other, in the interval checker.
#include "experiments/checker/offset_leg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "experiments/checker/check_walk.h"
#include "experiments/checker/proof_file.h"
#include "tests/checker/made_run.h"
#include "tests/oracle/unequal_legs.h"
#include "tests/refusal_of.h"
#include "tests/wpg/generated_robots.h"

namespace halfstep::checker {
namespace {

using testing::HasSubstr;
using Kind = TrajectoryFinding::Kind;

// HRP-2 with legs that are drawn apart from each other, and the generated robots, of which one has
// hip pitch first and no two axes that meet.
const MadeRun& Drawn() {
  static const TemporaryFolder folder;
  static const MadeRun run(
      "robot: " +
          oracle::WriteUnequalRobot("hrp2", {.seed = 1, .offset = true}, folder.path().string()) +
          R"(
scene: scene.yaml
footsteps:
  - {foot: right, x_m: 0.2, y_m: -0.105}
  - {foot: left, x_m: 0.25, y_m: 0.11, yaw_deg: 10}
)",
      R"(obstacles:
  - name: box
    box: {size_m: [0.1, 0.1, 0.1]}
    pose: {xyz: [0.55, 0.0, 0.05]}
)");
  return run;
}
const MadeRun& Generated(size_t which) {
  static std::map<size_t, std::pair<std::unique_ptr<TemporaryRobot>, std::unique_ptr<MadeRun>>>
      runs;
  auto& [robot, run] = runs[which];
  if (run != nullptr) return *run;
  robot = std::make_unique<TemporaryRobot>(OffsetRobots()[which]);
  run = std::make_unique<MadeRun>("robot: " + robot->yaml_path() + R"(
scene: none
footsteps:
  - {foot: right, x_m: 0.15, y_m: -0.1, via_height_m: 0.09}
)");
  return *run;
}
std::vector<const MadeRun*> All() {
  return {&Drawn(), &Generated(0), &Generated(1), &Generated(2)};
}

TEST(OffsetLegs, CertifiedWalksAreProved) {
  for (const MadeRun* run : All()) {
    for (const Leg& leg : run->walk.robot.legs) ASSERT_FALSE(leg.closed_form());
    const TrajectoryCheck check = run->Check();
    EXPECT_TRUE(check.proved()) << (Missed(check).empty() ? "" : Missed(check)[0]->subject);
    EXPECT_LT(check.intervals, 4000);
    EXPECT_EQ(std::ranges::count(check.findings, Kind::kLimits, &TrajectoryFinding::kind), 12);
    EXPECT_EQ(std::ranges::count(check.findings, Kind::kReach, &TrajectoryFinding::kind), 2);
  }
}

TEST(OffsetLegs, AnglesAreThoseOfTheTrajectory) {
  for (const MadeRun* run : All()) {
    const Moving moving(run->walk);
    const Rows rows(*run);
    for (size_t i = 0; i < rows.size(); i += 11) {
      const double t = std::min(rows.At(i, "t_s"), moving.motion.end());
      WalkState state = moving.On(t, t);
      for (size_t side = 0; side < 2; ++side) {
        for (size_t j = 0; j < 6; ++j) {
          const Interval& q = state.leg(side).q[j].over[0];
          EXPECT_NEAR(q.Middle(),
                      rows.At(i, "q_" + run->walk.robot.legs[side].joints[j].name + "_rad"), 1e-9);
          EXPECT_LT(q.hi - q.lo, 1e-9);
        }
      }
    }
  }
}

TEST(OffsetLegs, IntervalsHoldWhatIsWithin) {
  std::mt19937_64 random(3);
  for (const MadeRun* run : All()) {
    const Moving moving(run->walk);
    const std::vector<double>& knots = moving.motion.knots();
    int found = 0;
    for (int i = 0; i < 40; ++i) {
      const size_t k = random() % (knots.size() - 1);
      std::uniform_real_distribution<double> in(knots[k], knots[k + 1]);
      const double a = in(random), b = std::min(knots[k + 1], a + (i % 2 == 0 ? 0.02 : 0.002));
      WalkState wide = moving.On(a, b);
      try {
        wide.leg(0), wide.leg(1);
      } catch (const NotDefined&) {
        continue;
      }
      ++found;
      for (int n = 0; n < 4; ++n) {
        const double t = std::uniform_real_distribution<double>(a, b)(random);
        WalkState at = moving.On(t, t);
        for (size_t side = 0; side < 2; ++side) {
          for (size_t j = 0; j < 6; ++j) {
            for (size_t order = 0; order < 3; ++order) {
              EXPECT_TRUE(Holds(wide.leg(side).q[j].over[order], at.leg(side).q[j].at[order]))
                  << "joint " << j << ", order " << order << ", " << a << " … " << b;
            }
          }
          EXPECT_TRUE(Holds(wide.reach(side).over[0], at.reach(side).at[0]));
        }
      }
    }
    EXPECT_GT(found, 20);
  }
}

// Derivatives are those of differences, so that a walk's enclosures are of what moves.
TEST(OffsetLegs, DerivativesAreThoseOfDifferences) {
  const Moving moving(Drawn().walk);
  constexpr double kStep = 1e-4;
  for (double t = 0.05; t < moving.motion.end() - 0.1; t += 0.13) {
    const auto at = [&](double time) { return moving.On(time, time); };
    WalkState before = at(t - kStep), here = at(t), after = at(t + kStep);
    for (size_t side = 0; side < 2; ++side) {
      for (size_t j = 0; j < 6; ++j) {
        const auto q = [&](WalkState& state) { return state.leg(side).q[j]; };
        const double a = q(before).at[0].Middle(), b = q(here).at[0].Middle(),
                     c = q(after).at[0].Middle();
        EXPECT_NEAR(q(here).at[1].Middle(), (c - a) / (2 * kStep), 1e-4);
        EXPECT_NEAR(q(here).at[2].Middle(), (c - 2 * b + a) / (kStep * kStep), 2e-2);
      }
    }
  }
}

// Continued from itself a leg has the posture of the closed form, and each of its bounds is at most
// six times as wide as the widest of the closed form's six.
TEST(OffsetLegs, WithoutOffsetIsTheClosedForm) {
  std::mt19937_64 random(5);
  for (const char* name : {"hrp2", "bison", "wren"}) {
    const double size = std::string(name) == "wren" ? 0.3 : 1.0;
    const MadeRun run(std::string("robot: ") + name + "\nscene: none\nfootsteps:\n" +
                      "  - {foot: right, x_m: " + std::to_string(0.2 * size) +
                      ", y_m: " + std::to_string(-0.11 * size) + ", yaw_deg: -10}\n");
    WalkRun continued = run.walk;
    for (Leg& leg : continued.robot.legs) leg.met = {Leg(leg)};
    const Moving closed(run.walk), newton(continued);
    const auto width = [](const Interval& x) { return x.hi - x.lo; };
    int found = 0;
    for (int i = 0; i < 30; ++i) {
      const double end = closed.motion.end();
      const double from = std::uniform_real_distribution<double>(0.0, 0.9 * end)(random);
      const double to = from + (i % 3 == 0 ? 0.0 : i % 3 == 1 ? 1e-3 : 1e-2);
      WalkState one = closed.On(from, to), other = newton.On(from, to);
      for (size_t side = 0; side < 2; ++side) {
        const LegPosture& its = one.leg(side);
        try {
          other.leg(side);
        } catch (const NotDefined&) {  // across the end of a part
          EXPECT_LT(from, to) << name << ", " << from;
          continue;
        }
        ++found;
        std::array<double, 3> widest{};
        for (const Curve& q : its.q) {
          for (size_t order = 0; order < 3; ++order) {
            widest[order] = std::max(widest[order], width(q.over[order]));
          }
        }
        for (size_t j = 0; j < 6; ++j) {
          const Curve &a = its.q[j], &b = other.leg(side).q[j];
          for (size_t order = 0; order < 3; ++order) {
            EXPECT_TRUE(Holds(a.at[order], b.at[order])) << name << ", " << from;
            EXPECT_TRUE(Holds(a.over[order], b.over[order])) << name << ", " << from;
            EXPECT_LE(width(b.over[order]), 6.0 * widest[order] + 2e-3)
                << name << ", joint " << j << ", order " << order << ", " << from << " … " << to
                << ", " << one.reach(side).over[0].lo << " m from stretched";
          }
          EXPECT_TRUE(Holds(a.over[3], b.over[3])) << name << ", " << from;
        }
        EXPECT_TRUE(Holds(one.reach(side).over[0], other.reach(side).over[0]));
      }
    }
    EXPECT_GT(found, 45);
    EXPECT_TRUE(CheckRun(continued).proved());
  }
}

TEST(OffsetLegs, ThatCannotReachAreNotProved) {
  for (const double crouch : {-0.2, -0.3}) {
    WalkRun walk = Drawn().walk;
    walk.crouch += crouch;
    const TrajectoryCheck check = CheckRun(walk);
    EXPECT_FALSE(check.proved());
    for (const TrajectoryFinding& finding : check.findings) {
      EXPECT_FALSE(finding.kind == Kind::kReach && finding.proved) << crouch;
    }
  }
}

TEST(OffsetLegs, HaveNoProofThatTravels) {
  ProofFile proof;
  proof.walk = Drawn().walk;
  proof.walk.scene.ground = std::make_shared<const FlatGround>();
  EXPECT_THAT(RefusalOf([&] { ProofText(proof, {}); }), HasSubstr("(valid here: hip axes"));
}

// Demands just above what is kept at some row are not proved, those a little below are.
TEST(OffsetLegs, LimitsAreFound) {
  for (const FoundLimit& limit : {FoundLimit{verify::kZmp, "zmp_margin_m", 2e-4},
                                  {verify::kClearance, "clearance_m", 1e-3},
                                  {verify::kJoint, "joint_margin_rad", 1e-3},
                                  {verify::kJointSpeed, "joint_speed_margin_rad_s", 2e-2},
                                  {verify::kSelfClearance, "self_clearance_m", 2e-4},
                                  {verify::kZmpRobot, "zmp_robot_margin_m", 4e-4}}) {
    ExpectFound(Drawn(), limit);
  }
}

}  // namespace
}  // namespace halfstep::checker
