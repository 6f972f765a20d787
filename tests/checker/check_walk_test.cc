// What is proved of a walk of a run holds, and what is not true is not proved.
#include "experiments/checker/check_walk.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "experiments/checker/proof_file.h"
#include "experiments/checker/walk_run.h"
#include "experiments/checker/walk_statements.h"
#include "tests/checker/made_run.h"
#include "tests/refusal_of.h"
#include "tests/verify/tampered_episode.h"

namespace halfstep::checker {
namespace {

using testing::HasSubstr;
using Kind = TrajectoryFinding::Kind;

const MadeRun& Box() {
  static const MadeRun run(R"(robot: hrp2
scene: )" + InSources() + R"(/experiments/scenes/box.yaml
footsteps:
  - {foot: right, x_m: 0.274, y_m: -0.105}
half_step: {foot_delay: 0.19}
)");
  return run;
}
const MadeRun& Wren() {
  static const MadeRun run(R"(robot: wren
scene: scene.yaml
footsteps:
  - {foot: right, x_m: 0.06, y_m: -0.04, yaw_deg: 10}
  - {foot: left, x_m: 0.09, y_m: 0.06, yaw_deg: 20}
)",
                           R"(obstacles:
  - name: ball
    box: {size_m: [0.05, 0.1, 0.05]}
    pose: {xyz: [0.16, -0.6, 0.1]}
    motion:
      waypoints:
        - {t_s: 1.1, xyz: [0.2, 0.1, 0.15], yaw_deg: 70}
        - {t_s: 2.5, xyz: [0.2, 0.9, 0.15], yaw_deg: 30}
      error_m: 0.003
      speed_m_s: 0.004
)");
  return run;
}

// Up onto a tread, one foot after the other, and over another one of its height beside a gap of 1
// nm.
constexpr char kTreads[] = R"(surfaces:
  - name: tread
    polygon_m: [[0.14, -1], [0.3, -1], [0.3, 1], [0.14, 1]]
    height_m: 0.08
  - name: more
    polygon_m: [[0.300000001, -1], [0.6, -1], [0.6, 1], [0.300000001, 1]]
    height_m: 0.08
)";
const MadeRun& Stairs() {
  static const MadeRun run(R"(robot: hrp2
scene: scene.yaml
footsteps:
  - {foot: right, x_m: 0.28, y_m: -0.085}
  - {foot: left, x_m: 0.28, y_m: 0.085}
half_step: {duration_s: 2, via_height_m: 0.18, foot_delay: 0.15, crouch_m: 0.01}
)",
                           kTreads);
  return run;
}

// Down under nothing, and up again.
const MadeRun& Lower() {
  static const MadeRun run(R"(robot: hrp2
scene: none
footsteps:
  - {foot: right, x_m: 0.1, y_m: -0.105, via_height_m: 0.12, crouch_m: 0.08}
  - {foot: left, x_m: 0.2, y_m: 0.105, crouch_m: 0.03}
)");
  return run;
}

TEST(CheckWalk, CertifiedWalksAreProved) {
  for (const MadeRun* run : {&Box(), &Wren(), &Stairs(), &Lower()}) {
    const TrajectoryCheck check = run->Check();
    EXPECT_TRUE(check.proved()) << (Missed(check).empty() ? "" : Missed(check)[0]->subject);
    EXPECT_LT(check.intervals, 2000);
    // As many statements as the certificate has.
    const auto count = [&](Kind kind) {
      return std::ranges::count(check.findings, kind, &TrajectoryFinding::kind);
    };
    const auto& stated = run->walk.certificate.statements;
    EXPECT_EQ(count(Kind::kSelfClearance), stated[verify::kSelfClearance]);
    EXPECT_EQ(count(Kind::kLimits), stated[verify::kJoint]);
    EXPECT_EQ(count(Kind::kGround), stated[verify::kGround]);
    EXPECT_EQ(count(Kind::kFoothold), run == &Stairs() ? 4 : 0);
    EXPECT_EQ(count(Kind::kZmpRobot), 1);
    EXPECT_EQ(count(Kind::kTorque), run == &Wren() ? 12 : 0);
  }
}

// Regression: corners of soles that are equally far ahead up to rounding were left out of the hull.
TEST(CheckWalk, SolesSideBySideUpToRoundingAreOneSupport) {
  const MadeRun run(R"(robot: wren
scene: none
footsteps:
  - {foot: right, x_m: 0.060000000000000005, y_m: -0.0475}
  - {foot: left, x_m: 0.06, y_m: 0.0475}
)");
  const TrajectoryCheck check = run.Check();
  EXPECT_TRUE(check.proved()) << (Missed(check).empty() ? "" : Missed(check)[0]->subject);
}

TEST(Pendulum, GoesFromRestToRest) {
  for (const double ramp : {1.0, 0.7, 0.3}) {
    const Pendulum pendulum = Pendulum::Of(Interval(36.0), Interval(0.05), ramp);
    const auto expect = [](const Interval& x, double exact) {
      EXPECT_LE(x.lo, exact);
      EXPECT_GE(x.hi, exact);
      EXPECT_LT(x.hi - x.lo, 1e-9);
    };
    for (const double end : {0.0, 1.0}) {
      const auto c = pendulum.ComAt(end), p = pendulum.zmp.At(end);
      expect(c[0], end);
      expect(c[1], 0.0);
      expect(c[2], 0.0);
      expect(p[0], end);
    }
    expect(pendulum.ComAt(0.5)[0], 0.5);
    // Pieces meet with two derivatives: both sides hold one number.
    for (const double sigma : {0.3 * 0.475, 0.475, 0.5, 0.525}) {
      const auto before = pendulum.ComAt(sigma - 1e-9), after = pendulum.ComAt(sigma + 1e-9);
      for (size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(before[k].Middle(), after[k].Middle(), 1e-5) << sigma << ", " << k;
      }
    }
  }
}

TEST(CheckWalk, MotionIsThatOfTheTrajectory) {
  for (const MadeRun* run : {&Box(), &Wren(), &Stairs(), &Lower()}) {
    const Moving moving(run->walk);
    const Rows rows(*run);
    for (size_t i = 0; i < rows.size(); i += 7) {
      WalkState state = moving.On(rows.At(i, "t_s"), rows.At(i, "t_s"));
      const auto expect = [&](const Interval& x, const std::string& column) {
        EXPECT_NEAR(x.Middle(), rows.At(i, column), 1e-9) << column << ", row " << i;
        EXPECT_LT(x.hi - x.lo, 1e-9) << column << ", row " << i;
      };
      const WalkNumbers& x = state.numbers();
      expect(x[kCom].over[0], "com_x_m");
      expect(x[kCom + 1].at[1], "com_vy_m_s");
      expect(x[kCom + 1].at[2], "com_ay_m_s2");
      expect(x[kZmp + 1].over[0], "zmp_y_m");
      expect(x[kYaw].over[0], "waist_yaw_rad");
      EXPECT_NEAR(x[kWaistZ].over[0].Middle() + run->walk.robot.waist_height - run->walk.crouch,
                  rows.At(i, "waist_z_m"), 1e-9);
      for (size_t side = 0; side < 2; ++side) {
        const std::string foot = side == 0 ? "left_foot_" : "right_foot_";
        expect(x[kSole + 4 * side].over[0], foot + "x_m");
        expect(x[kSole + 4 * side + 2].over[0], foot + "z_m");
        expect(x[kSole + 4 * side + 3].over[0], foot + "yaw_rad");
        for (size_t j = 0; j < 6; ++j) {
          expect(state.leg(side).q[j].over[0],
                 "q_" + run->walk.robot.legs[side].joints[j].name + "_rad");
        }
      }
    }
  }
}

TEST(CheckWalk, MarginsAtInstantsAreThoseOfTheTrajectory) {
  const std::pair<verify::Family, const char*> columns[] = {
      {verify::kZmp, "zmp_margin_m"},
      {verify::kJoint, "joint_margin_rad"},
      {verify::kJointSpeed, "joint_speed_margin_rad_s"},
      {verify::kFootSpeed, "foot_speed_margin_m_s"},
      {verify::kClearance, "clearance_m"},
      {verify::kSelfClearance, "self_clearance_m"},
      {verify::kZmpRobot, "zmp_robot_margin_m"},
      {verify::kTorque, "torque_margin_n_m"},
      {verify::kFriction, "friction_margin"}};
  for (const MadeRun* run : {&Box(), &Wren(), &Stairs(), &Lower()}) {
    const Moving moving(run->walk);
    verify::CertificateText certificate = run->walk.certificate;
    for (double& demanded : certificate.demanded) {
      if (demanded != verify::kNotDemanded) demanded = 1e9;  // so that distances are measured
    }
    WalkStatements statements(run->walk.robot, run->walk.scene, certificate);
    const Rows rows(*run);
    for (size_t i = 0; i < rows.size(); i += 23) {
      WalkState state = moving.On(rows.At(i, "t_s"), rows.At(i, "t_s"));
      for (const auto& [family, column] : columns) {
        double value = std::numeric_limits<double>::infinity(), bound = value;
        for (WalkStatement& statement : statements.all()) {
          if (statement.family != family) continue;
          const Kept kept = statements.Look(&statement, &state);
          value = std::min(value, kept.value);
          bound = std::min(bound, kept.bound);
        }
        const double told = rows.At(i, column);
        // No limit, both feet stand, no obstacle.
        if (std::isinf(told) || std::isinf(value)) continue;
        const bool far = family == verify::kClearance && value > 0.3;
        EXPECT_NEAR(far ? 0.3 : value, told, 1e-6) << column << ", row " << i;
        EXPECT_NEAR(bound, value, 1e-6) << column << ", row " << i;
      }
    }
  }
}

TEST(CheckWalk, IntervalsHoldWhatIsWithin) {
  std::mt19937_64 random(3);
  for (const MadeRun* run : {&Box(), &Wren(), &Stairs(), &Lower()}) {
    const Moving moving(run->walk);
    const std::vector<double>& knots = moving.motion.knots();
    for (int i = 0; i < 60; ++i) {
      const size_t k = random() % (knots.size() - 1);
      std::uniform_real_distribution<double> in(knots[k], knots[k + 1]);
      double a = in(random), b = in(random);
      if (a > b) std::swap(a, b);
      b = std::min(b, a + (i % 2 == 0 ? 0.02 : 0.002));
      WalkState wide = moving.On(a, b);
      try {
        wide.dynamics();
      } catch (const NotDefined&) {
        continue;
      }
      for (int n = 0; n < 4; ++n) {
        const double t = std::uniform_real_distribution<double>(a, b)(random);
        WalkState at = moving.On(t, t);
        for (size_t order = 0; order < 3; ++order) {
          for (size_t q = 0; q < kNumWalkNumbers; ++q) {
            EXPECT_TRUE(Holds(wide.numbers()[q].over[order], at.numbers()[q].at[order]));
          }
          for (size_t side = 0; side < 2; ++side) {
            for (size_t j = 0; j < 6; ++j) {
              EXPECT_TRUE(Holds(wide.leg(side).q[j].over[order], at.leg(side).q[j].at[order]))
                  << "joint " << j << ", order " << order << ", " << a << " … " << b;
              for (size_t n = 0; n < 3; ++n) {
                EXPECT_TRUE(Holds(wide.leg(side).X_WLink[j].p[n].over[order],
                                  at.leg(side).X_WLink[j].p[n].at[order]));
              }
            }
          }
        }
        const Interval z = wide.HeightOf(wide.Stands(0) ? 0 : 1);
        const Seen<1> zmp = wide.dynamics().At(z), there = at.dynamics().At(z);
        for (size_t k = 0; k < 2; ++k) EXPECT_TRUE(Holds(zmp[k].over[0], there[k].at[0]));
      }
    }
  }
}

// Demands just above what is kept at some row are not proved, those a little below are.
TEST(CheckWalk, LimitsAreFound) {
  for (const FoundLimit& limit : {FoundLimit{verify::kZmp, "zmp_margin_m", 2e-4},
                                  {verify::kClearance, "clearance_m", 1e-3},
                                  {verify::kJointSpeed, "joint_speed_margin_rad_s", 2e-2},
                                  {verify::kSelfClearance, "self_clearance_m", 2e-4},
                                  {verify::kZmpRobot, "zmp_robot_margin_m", 4e-4},
                                  {verify::kTorque, "torque_margin_n_m", 0.1},
                                  {verify::kFriction, "friction_margin", 1e-2}}) {
    ExpectFound(Wren(), limit);
  }
}

TEST(CheckWalk, TheWaistIsAsLowAsTheFootstepsSay) {
  WalkRun walk = Lower().walk;
  ASSERT_EQ(walk.tables.footsteps.size(), 4u);
  EXPECT_EQ(walk.tables.footsteps[1].crouch, 0.0);
  EXPECT_EQ(walk.tables.footsteps[2].crouch, 0.08);
  EXPECT_TRUE(CheckRun(walk).proved());
  const double end = Moving(walk).motion.end();
  EXPECT_NEAR(Moving(walk).On(0.0, 0.0).numbers()[kWaistZ].over[0].Middle(), 0.0, 1e-12);
  EXPECT_NEAR(Moving(walk).On(end, end).numbers()[kWaistZ].over[0].Middle(), -0.03, 1e-12);
  // Legs that are asked to stretch, or to fold, as they cannot.
  walk.tables.footsteps[2].crouch = 0.45;
  EXPECT_FALSE(CheckRun(walk).proved());
  walk.tables.footsteps[2].crouch = -0.08;
  EXPECT_THROW(CheckRun(walk), InputError);
  walk.tables.footsteps[2].crouch = 0.08;
  walk.tables.footsteps[0].crouch = 0.02;
  EXPECT_THROW(CheckRun(walk), InputError);
}

TEST(CheckWalk, NudgedWalksAreNotProved) {
  const auto missed = [](const WalkRun& walk) {
    const TrajectoryCheck check =
        CheckWalk(WalkMotion(walk.tables), walk.robot, walk.scene, walk.certificate, walk.crouch);
    std::string told;
    for (const TrajectoryFinding* finding : Missed(check)) told += finding->subject + "; ";
    return told;
  };
  const auto only = [](const MadeRun& run, verify::Family family) {
    WalkRun walk = run.walk;
    walk.certificate.demanded.fill(verify::kNotDemanded);
    walk.certificate.demanded[static_cast<size_t>(family)] =
        run.walk.certificate.demanded[static_cast<size_t>(family)];
    return walk;
  };
  WalkRun walk = only(Box(), verify::kClearance);
  walk.tables.starts[1] =
      walk.tables.starts[1] - Interval(0.002);  // the dichotomy ends within a millisecond
  EXPECT_THAT(missed(walk), HasSubstr("RLEG_LINK5 - box"));

  walk = only(Box(), verify::kClearance);
  walk.scene.obstacles[0].motion.error = 1e-4;
  EXPECT_THAT(missed(walk), HasSubstr("RLEG_LINK5 - box"));
  walk = only(Box(), verify::kClearance);
  walk.scene.obstacles[0].X_WO.translation().x() -= 2e-4;
  EXPECT_THAT(missed(walk), HasSubstr("RLEG_LINK5 - box"));

  // It comes nearer by 0.1 mm until it is passed; a cart meets the foot on its way.
  walk = only(Box(), verify::kClearance);
  walk.scene.obstacles[0].motion.speed = 1e-4;
  EXPECT_THAT(missed(walk), HasSubstr("RLEG_LINK5 - box"));
  walk = only(Wren(), verify::kClearance);
  walk.scene.obstacles[0].motion.waypoints[0].translation.x() = 0.12;
  EXPECT_THAT(missed(walk), HasSubstr(" - ball"));

  walk = only(Box(), verify::kNoStep);
  walk.scene.no_step.push_back(
      (Eigen::Matrix2Xd(2, 4) << 0.38, 0.5, 0.5, 0.38, -0.2, -0.2, 0.0, 0.0).finished());
  EXPECT_THAT(missed(walk), HasSubstr("area 1"));
  walk.scene.no_step[0].row(0).array() += 0.2;
  EXPECT_EQ(missed(walk), "");

  walk = only(Box(), verify::kFloor);
  for (verify::HalfStepRow& row : walk.tables.half_steps) row.height_scale = 0.01;
  EXPECT_THAT(missed(walk), HasSubstr("swing foot"));
  walk = only(Box(), verify::kDoubleSupport);
  walk.certificate.demanded[verify::kDoubleSupport] = 0.1 + 1e-9;
  EXPECT_EQ(missed(walk), "half-step 1; half-step 2; ");
}

// The ground is moved under a walk that was certified on it.
TEST(CheckWalk, WalksOverOtherGroundAreNotProved) {
  struct Ground {
    const char *was, *is;
    const char* missed;  // of what is not proved
  };
  for (const auto& [was, is, missed] :
       {Ground{"", "", ""}, Ground{"[0.300000001, -1]", "[0.300000004, -1]", "sole at"},
        Ground{"[0.300000001, -1]", "[0.299, -1]", ""},
        Ground{"[0.6, -1], [0.6, 1]", "[0.39, -1], [0.39, 1]", "sole at"},
        Ground{"0.14, -1", "0.135, -1", "LINK"},
        Ground{"height_m: 0.08", "height_m: 0.081", "LINK"},
        Ground{"height_m: 0.08", "height_m: 0.079", "sole at"}}) {
    std::string text = kTreads;
    for (size_t at = 0; was[0] != 0 && (at = text.find(was, at)) != std::string::npos; ++at) {
      text.replace(at, std::string(was).size(), is);
    }
    WalkRun walk = Stairs().walk;
    walk.scene = ParseScene("scene.yaml", text);
    const TrajectoryCheck check = CheckRun(walk);
    std::string told;
    for (const TrajectoryFinding* finding : Missed(check)) told += finding->subject + "; ";
    EXPECT_THAT(told, HasSubstr(missed)) << was << " → " << is;
    EXPECT_EQ(told.empty(), missed[0] == 0) << was << " → " << is << ": " << told;
  }
}

TEST(CheckWalk, StopBranchesAreProved) {
  const MadeRun run(R"(robot: hrp2
scene: )" + InSources() +
                        R"(/experiments/scenes/box.yaml
footsteps:
  - {foot: right, x_m: 0.274, y_m: -0.105}
half_step: {foot_delay: 0.19}
)",
                    "", "  stop_branches: all\n");
  ASSERT_EQ(run.walk.branches.size(), 1u);
  const TrajectoryCheck check = run.Check();
  EXPECT_TRUE(check.proved()) << (Missed(check).empty() ? "" : Missed(check)[0]->subject);
  EXPECT_GT(check.intervals, Box().Check().intervals);
}

TEST(CheckEpisode, WhatBeganIsProved) {
  const TamperedEpisode episode;
  const std::string folder = episode.folder().string();
  ASSERT_EQ(CertifiedMethods(folder, std::nullopt), std::vector<std::string>{""});
  WalkRun run = ReadWalkRun(folder, "");
  ASSERT_GE(run.branches.size(), 2u);
  const TrajectoryCheck check = CheckRun(run);
  EXPECT_TRUE(check.proved()) << (Missed(check).empty() ? "" : Missed(check)[0]->subject);
  EXPECT_FALSE(check.findings.empty());
}

TEST(CheckWalk, WhatItDoesNotKnowIsRefused) {
  const auto refused = [](const WalkRun& walk) {
    return RefusalOf([&] {
      CheckWalk(WalkMotion(walk.tables), walk.robot, walk.scene, walk.certificate, walk.crouch);
    });
  };
  WalkRun walk = Stairs().walk;
  walk.certificate.tube.emplace();
  EXPECT_THAT(refused(walk), HasSubstr("a tube over solid ground"));
  walk = Wren().walk;
  walk.tables.starts[2] = walk.tables.starts[1] - Interval(1e-6);
  EXPECT_THAT(refused(walk), HasSubstr("half-step 3: begins or ends before the one before it"));
  walk = Box().walk;
  walk.tables.half_steps.pop_back();
  EXPECT_THAT(refused(walk), HasSubstr("two half-steps for each row"));
  walk = Box().walk;
  walk.tables.half_steps[1].height_scale = 0.5;
  EXPECT_THAT(refused(walk), HasSubstr("half-step 1: the other one of its step is elsewhere"));
}

TEST(ProofFile, IsReadBackToTheBit) {
  for (const MadeRun* run : {&Box(), &Wren()}) {
    ProofFile proof;
    proof.walk = run->walk;
    proof.run = "made";
    proof.method = "dichotomy";
    const auto check = [](ProofFile* of) {
      const WalkRun& walk = of->walk;
      return CheckWalk(WalkMotion(walk.tables), walk.robot, walk.scene, walk.certificate,
                       walk.crouch, {}, &of->hints);
    };
    const TrajectoryCheck first = check(&proof);
    const std::string text = ProofText(proof, {"a sentence"});
    ProofFile again = ReadProof("walk.json", text);
    EXPECT_EQ(ProofText(again, again.walk.not_covered), text);
    const TrajectoryCheck second = check(&again);
    EXPECT_TRUE(second.proved());
    EXPECT_EQ(second.findings.size(), first.findings.size());

    again.hints.directions.clear();
    const TrajectoryCheck without = check(&again);
    EXPECT_FALSE(without.proved());
    for (const TrajectoryFinding* finding : Missed(without)) EXPECT_TRUE(finding->hint_missing);
  }
}

TEST(CheckCommand, ChecksRuns) {
  const MadeRun& run = Box();
  const Outcome proved = Halfstep(run.place.path(), {"check", "made", "--method", "dichotomy"});
  EXPECT_EQ(proved.status, kSuccess) << proved.err;
  EXPECT_THAT(proved.out, HasSubstr("2 half-steps of hrp2 in box"));
  EXPECT_THAT(proved.out, HasSubstr("clearance            proved for all t: 23, each by 5"));
  EXPECT_THAT(proved.out, HasSubstr("torque: nothing is demanded"));

  EXPECT_THAT(Halfstep(run.place.path(), {"check", "made", "--proof", "a.json"}).err,
              HasSubstr("--proof: is of one walk (valid with --method: raw, dichotomy)"));
  EXPECT_THAT(Halfstep(run.place.path(), {"check", "made/manifest.json"}).err,
              HasSubstr("made/manifest.json: format: is not a text"));

  const TemporaryFolder forged;
  std::filesystem::copy(run.place / "made", forged / "run",
                        std::filesystem::copy_options::recursive);
  const auto certificate = forged / "run/dichotomy/certificate.json";
  std::string text = ReadText(certificate);
  text.replace(text.find("\"clearance\": 0.005"), 18, "\"clearance\": 0.006");
  WriteText(certificate, text);
  const Outcome missed = Halfstep(forged.path(), {"check", "run", "--method", "dichotomy"});
  EXPECT_EQ(missed.status, kFailed);
  EXPECT_THAT(missed.out, HasSubstr("not proved: 1 of 23\n  RLEG_LINK5 - box at "));
  EXPECT_THAT(Halfstep(forged.path(), {"check", "run", "--method", "sqp"}).err,
              HasSubstr("--method: 'sqp' (valid: raw, dichotomy)"));
  EXPECT_THAT(Halfstep(forged.path(), {"check", "."}).err, HasSubstr("no such run folder"));
  EXPECT_THAT(Halfstep(forged.path(), {"check", "walk"}).err, HasSubstr("walk: does not exist"));
  EXPECT_THAT(Halfstep(forged.path(), {"check", "run", "--clearance", "0.1"}).err,
              HasSubstr("--clearance: is of trajectories (valid for a run: --method,"));
  const auto overlaps = forged / "run/dichotomy/overlaps.csv";
  text = ReadText(overlaps);
  text.replace(text.find("1,up_down,0.6"), 13, "1,up_down,0.5");
  WriteText(overlaps, text);
  EXPECT_THAT(Halfstep(forged.path(), {"check", "run", "--method", "dichotomy"}).err,
              HasSubstr("half_steps.csv: half-step 2 does not begin where overlaps.csv has it"));
  std::filesystem::remove(forged / "run/dichotomy/half_steps.csv");
  EXPECT_EQ(Halfstep(forged.path(), {"check", "run", "--method", "dichotomy"}).status, kBadInput);
}

}  // namespace
}  // namespace halfstep::checker
