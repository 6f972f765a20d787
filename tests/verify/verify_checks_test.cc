// One wrong thing and one expected reason for each check of verify that tampering with files
// cannot reach alone, because another check refuses first: the checks are called themselves.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "experiments/checker/prove_walk.h"
#include "experiments/config/experiment.h"
#include "experiments/verify/certificate_text.h"
#include "experiments/verify/check_certificate.h"
#include "experiments/verify/check_claims.h"
#include "experiments/verify/check_clearance.h"
#include "experiments/verify/check_margin_columns.h"
#include "experiments/verify/check_overlaps.h"
#include "experiments/verify/check_rows.h"
#include "experiments/verify/check_walk.h"
#include "tests/verify/plan_of.h"
#include "tests/verify/verify_mutation.h"
#include "tests/verify/wrong_material.h"

namespace halfstep::verify {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

const Material& Original() {
  static const Material material = [] {
    const TamperedRun run;
    const auto read = [&](const std::string& name) { return ReadText(run.run() / name); };
    Material m;
    const Experiment experiment = Prepare(LoadConfig((run.run() / "config.yaml").string(), {}));
    m.robot = experiment.robot;
    m.scene = experiment.scene;
    m.planned = PlanOf(experiment.sequence);
    m.certificate = ReadCertificateJson("json", read("dichotomy/certificate.json"));
    m.claims = ReadCertificateCsv("csv", read("dichotomy/certificate.csv"));
    m.rows = ReadTrajectory("csv", read("dichotomy/trajectory.csv"), m.robot);
    m.half_steps = ReadHalfSteps("csv", read("dichotomy/half_steps.csv"));
    m.overlaps = ReadOverlaps("csv", read("dichotomy/overlaps.csv"));
    m.footsteps = ReadFootsteps("csv", read("footsteps.csv"));
    return m;
  }();
  return material;
}

Findings FindingsOf(Of check, const Material& m) {
  Findings findings;
  if (check == Of::kOverlaps) {
    CheckOverlaps(m.half_steps, m.overlaps, m.planned, &findings);
    CheckFootsteps(m.footsteps, m.planned, &findings);
    return findings;
  }
  if (check == Of::kMotion) {
    CheckIsMotion(m.rows, &findings);
    return findings;
  }
  const DescribedWalk walk(m.robot, m.planned, m.half_steps);
  Distances distances(m.robot, m.scene);
  const PlayedMotion motion(m.robot, m.rows);
  switch (check) {
    case Of::kProved: {
      const std::string no_branches = "none";
      const auto prove = [&] {
        return checker::ProverOfWalks().of_run({.robot = m.robot,
                                                .scene = m.scene,
                                                .certificate = m.certificate,
                                                .form = m.planned.half_steps[0].half_step,
                                                .footsteps = m.footsteps,
                                                .half_steps = m.half_steps,
                                                .overlaps = m.overlaps,
                                                .stop_branches = no_branches});
      };
      TellProved(prove, &findings);
      break;
    }
    case Of::kFloor:
      CheckFloor(motion, walk.floor(), m.certificate, 0.001, &findings);
      break;
    case Of::kConsistency:
      CheckConsistency(motion, walk, &findings);
      break;
    case Of::kClearances:
      CheckClearances(motion, m.certificate, 0.001, &distances, &findings);
      break;
    case Of::kClaims:
      CheckClaims(walk, m.certificate, m.claims, &distances, &findings);
      break;
    case Of::kColumns:
      CheckMarginColumns(m.rows, walk, m.certificate, &distances, &findings);
      break;
    case Of::kWalk:
      CheckRowsOnWalk(m.rows, walk, 0.005, walk.end(), &findings);
      break;
    case Of::kArithmetic:
      CheckArithmetic(m.certificate, m.claims, m.robot, Scene{}, m.rows.back().t, &findings);
      break;
    case Of::kMotion:
    case Of::kOverlaps:
      break;
  }
  return findings;
}

Change Demand(Family family, double margin) {
  return [=](Material& m) { m.certificate.demanded[family] = margin; };
}
// The certificate's row of a family with the largest bound and a finite margin.
Change Claim(Family family, std::function<void(ClaimRow&)> edit) {
  return [=](Material& m) {
    ClaimRow* loosest = nullptr;
    for (ClaimRow& row : m.claims) {
      if (row.family != family || !std::isfinite(row.margin)) continue;
      if (loosest == nullptr || row.bound > loosest->bound) loosest = &row;
    }
    ASSERT_NE(loosest, nullptr);
    edit(*loosest);
  };
}
Change RaiseMargin(Family family, double by) {
  return Claim(family, [=](ClaimRow& row) { row.margin += by; });
}
Change NoBound(Family family) {
  return [=](Material& m) {
    for (ClaimRow& row : m.claims) {
      if (row.family == family) row.bound = 0;
    }
  };
}
// The row in the middle of a foot's flight.
PlayedRow& Flying(Material& m) {
  size_t first = 0;
  while (m.rows[first].support == Support::kBoth) ++first;
  size_t last = first;
  while (m.rows[last].support != Support::kBoth) ++last;
  return m.rows[(first + last) / 2];
}
Change InFlight(std::function<void(PlayedRow&)> edit) {
  return [=](Material& m) { edit(Flying(m)); };
}
size_t Swing(const PlayedRow& row) { return row.support == Support::kLeft ? 1 : 0; }

std::vector<Wrong> Rows() {
  const Of proved = Of::kProved;
  return {
      {"JointLimit", proved, Demand(kJoint, 1), "joint limits: "},
      {"JointSpeed", proved, Demand(kJointSpeed, 3.6), "joint speeds: "},
      {"Reach", proved, Demand(kReach, 1), "leg reach: "},
      {"HeightWhileMoving", proved, Demand(kFloor, 0.3), "height of a moving sole: "},
      {"FootSpeed", proved, Demand(kFootSpeed, 0.99), "foot speed: "},
      {"FootYawRate", proved, Demand(kFootYawRate, 2.01), "foot yaw rate: "},
      {"Zmp", proved, Demand(kZmp, 0.2), "ZMP: "},
      {"ZmpWhereTheSupportChanges", Of::kWalk,
       [](Material& m) {
         // Both feet are said to stand until the ZMP is far from the one sole that is left.
         for (size_t i = 0; i + 1 < m.rows.size(); ++i) {
           if (m.rows[i].support != Support::kBoth) continue;
           m.rows[i + 1].support = Support::kRight;
           m.rows[i].zmp = {0, 0.09};
           return;
         }
       },
       "trajectory.csv:"},
      {"SoleBelowTheFloor", Of::kWalk,
       InFlight([](PlayedRow& row) { row.soles[Swing(row)][2] = -1e-3; }), "trajectory.csv:"},
  };
}

std::vector<Wrong> Consistency() {
  const Of check = Of::kConsistency;
  return {
      {"SoleElsewhere", check, InFlight([](PlayedRow& row) { row.soles[Swing(row)][0] += 1e-5; }),
       "soles by forward kinematics: "},
      {"SoleTurned", check, InFlight([](PlayedRow& row) { row.soles[Swing(row)][3] += 1e-5; }),
       "soles by forward kinematics: "},
      {"WaistAside", check, InFlight([](PlayedRow& row) { row.waist[1] += 1e-5; }),
       "soles by forward kinematics: "},
      {"CoMHeight", check, InFlight([](PlayedRow& row) { row.com.z() += 1e-5; }),
       "waist under the CoM: "},
      {"ZmpAlone", check, InFlight([](PlayedRow& row) { row.zmp.x() += 1e-6; }), "pendulum: "},
      {"Velocity", check, InFlight([](PlayedRow& row) { row.com_velocity.x() += 1e-3; }),
       "CoM velocity: "},
      {"ZmpAndAcceleration", check, InFlight([](PlayedRow& row) {
         row.zmp.x() += 0.002;
         row.com_acceleration.x() -= 0.002 * 9.81 / 0.814;
       }),
       "CoM acceleration: "},
      {"StandingFootSlides", check,
       InFlight([](PlayedRow& row) { row.soles[1 - Swing(row)][0] += 5e-7; }), "standing feet: "},
      {"StandingFootAboveTheFloor", check,
       InFlight([](PlayedRow& row) { row.soles[1 - Swing(row)][2] += 5e-7; }), "standing feet: "},
      {"FeetStandAboveTheFloor", check,
       [](Material& m) {
         for (PlayedRow& row : m.rows) {
           for (Eigen::Vector4d& sole : row.soles) sole[2] += 5e-7;
         }
       },
       "standing feet: "},
      {"FootprintOnNoStepArea", Of::kProved,
       [](Material& m) {
         Eigen::Matrix2Xd area(2, 3);
         area << 0.25, 0.3, 0.3, -0.12, -0.12, -0.08;
         m.scene.no_step.push_back(area);
       },
       "no-step areas: "},
  };
}

std::vector<Wrong> Claims() {
  const Of check = Of::kClaims;
  return {
      {"ScalarMarginAtTheMidpoint", check, RaiseMargin(kZmp, 1e-5), "certificate.csv:"},
      {"FloorMargin", check, RaiseMargin(kFloor, 1e-6), "certificate.csv:"},
      {"FootSpeedMargin", check, RaiseMargin(kFootSpeed, 1e-5), "certificate.csv:"},
      {"FootYawRateMargin", check, RaiseMargin(kFootYawRate, 1e-5), "certificate.csv:"},
      {"ReachMargin", check, RaiseMargin(kReach, 1e-6), "certificate.csv:"},
      {"JointMargin", check, RaiseMargin(kJoint, 1e-6), "certificate.csv:"},
      {"JointSpeedMargin", check, RaiseMargin(kJointSpeed, 1e-4), "certificate.csv:"},
      {"ClearanceMargin", check, RaiseMargin(kClearance, 0.001), "certificate.csv:"},
      {"SelfClearanceMargin", check, RaiseMargin(kSelfClearance, 0.001), "certificate.csv:"},
      {"ZmpBound", check, NoBound(kZmp), "certificate.csv:"},
      {"JointBound", check, NoBound(kJoint), "certificate.csv:"},
      {"JointSpeedBound", check, NoBound(kJointSpeed), "certificate.csv:"},
      {"ClearanceBound", check, NoBound(kClearance), "certificate.csv:"},
      {"SelfClearanceBound", check, NoBound(kSelfClearance), "certificate.csv:"},
      {"ClearanceBoundTakenOffTheMargin", check,
       [](Material& m) {
         for (ClaimRow& row : m.claims) {
           if (row.family == kClearance) row.margin -= std::exchange(row.bound, 0);
         }
       },
       "certificate.csv:"},
      {"BodyNearAnotherObstacle", check,
       Claim(kClearance,
             [](ClaimRow& row) {
               row.subject = "RLEG_LINK5";
               row.margin += 0.05;
             }),
       "certificate.csv:"},
      {"NoAreaNamed", check, Claim(kNoStep, [](ClaimRow& row) { row.subject = "left foot"; }),
       "certificate.csv:"},
      {"BodyOfTheWaistNamed", check,
       Claim(kGround, [](ClaimRow& row) { row.subject = "CHEST_LINK1"; }), "certificate.csv:"},
      {"FloorUnwatched", check,
       Claim(kFloor, [](ClaimRow& row) { row.margin = std::numeric_limits<double>::infinity(); }),
       "certificate.csv:"},
      {"NoFootNamed", check, Claim(kFootSpeed, [](ClaimRow& row) { row.subject = "both feet"; }),
       "certificate.csv:"},
      {"AnotherFootNamed", check,
       Claim(kFloor,
             [](ClaimRow& row) {
               row.subject = row.subject == "left foot" ? "right foot" : "left foot";
             }),
       "certificate.csv:"},
      {"NothingOfThisName", check, Claim(kReach, [](ClaimRow& row) { row.subject = "tail"; }),
       "certificate.csv:"},
  };
}

std::vector<Wrong> Others() {
  return {
      {"SelfClearance", Of::kProved, Demand(kSelfClearance, 0.1), "self clearance: "},
      {"Clearance", Of::kProved, Demand(kClearance, 0.1), "clearance: "},
      {"PlayedSelfClearance", Of::kClearances, Demand(kSelfClearance, 0.1),
       "played, self clearance: "},
      {"PlayedClearance", Of::kClearances, Demand(kClearance, 0.1), "played, clearance: "},
      {"ThinBodyInTheWay", Of::kProved,
       [](Material& m) {
         m.scene.obstacles.push_back({"plate", MakeBox({1e-4, 1, 1}),
                                      Eigen::Isometry3d(Eigen::Translation3d(0.05, -0.7, 0.6))});
       },
       "clearance: "},
      {"BodyBetweenTwoRows", Of::kClearances,
       [](Material& m) {
         m.scene.obstacles.push_back({"plate", MakeBox({1e-4, 1, 1}),
                                      Eigen::Isometry3d(Eigen::Translation3d(0.05, -0.7, 0.6))});
       },
       "played, clearance: "},
      {"ZmpColumn", Of::kColumns, InFlight([](PlayedRow& row) { row.margins[0] += 1e-6; }),
       "trajectory.csv:"},
      {"JointColumn", Of::kColumns, InFlight([](PlayedRow& row) { row.margins[1] += 1e-6; }),
       "trajectory.csv:"},
      {"JointSpeedColumn", Of::kColumns, InFlight([](PlayedRow& row) { row.margins[2] += 1e-4; }),
       "trajectory.csv:"},
      {"FootSpeedColumn", Of::kColumns, InFlight([](PlayedRow& row) { row.margins[3] += 1e-6; }),
       "trajectory.csv:"},
      {"ClearanceColumn", Of::kColumns, InFlight([](PlayedRow& row) { row.margins[4] += 1e-3; }),
       "trajectory.csv:"},
      {"SelfClearanceColumn", Of::kColumns,
       InFlight([](PlayedRow& row) { row.margins[5] += 1e-3; }), "trajectory.csv:"},
      {"NumberOfNoSense", Of::kMotion, InFlight([](PlayedRow& row) { row.q[1][3] = 1e5; }),
       "trajectory.csv:"},
      {"BeginsLater", Of::kMotion, [](Material& m) { m.rows[0].t = 1e-4; },
       "trajectory.csv:2: the times"},
      {"TimeTwice", Of::kMotion, [](Material& m) { m.rows[7].t = m.rows[6].t; },
       "trajectory.csv:9: the times"},
      {"HalfStepsTurned", Of::kMotion, [](Material& m) { m.rows[7].half_step = 0; },
       "trajectory.csv:9: the half-steps"},
      {"ClearanceColumnsTooSmall", Of::kColumns, InFlight([](PlayedRow& row) {
         for (const size_t k : {4u, 5u}) row.margins[k] -= 1e-3;
       }),
       "trajectory.csv:"},
      {"LargerClearanceColumnTooSmall", Of::kColumns,
       [](Material& m) {
         const auto row = std::ranges::find_if(m.rows, [](const PlayedRow& r) {
           return r.margins[4] < 0.29 && r.margins[4] > r.margins[5] + 0.002;
         });
         row->margins[4] -= 1e-3;
       },
       "trajectory.csv:"},
      {"RowFewer", Of::kWalk, [](Material& m) { m.rows.erase(m.rows.end() - 2); },
       "trajectory.csv: "},
      {"CoMOffTheWalk", Of::kWalk, InFlight([](PlayedRow& row) { row.com.x() += 1e-7; }),
       "trajectory.csv:"},
      {"AccelerationOffTheWalk", Of::kWalk,
       InFlight([](PlayedRow& row) { row.com_acceleration.x() += 1e-7; }), "trajectory.csv:"},
      {"ZmpOffTheWalk", Of::kWalk, InFlight([](PlayedRow& row) { row.zmp.x() += 1e-7; }),
       "trajectory.csv:"},
      {"RightFootOffTheWalk", Of::kWalk, InFlight([](PlayedRow& row) { row.soles[1][0] += 1e-7; }),
       "trajectory.csv:"},
      {"LeftFootOffTheWalk", Of::kWalk, InFlight([](PlayedRow& row) { row.soles[0][0] += 1e-7; }),
       "trajectory.csv:"},
      {"NotANumberOffTheWalk", Of::kWalk, InFlight([](PlayedRow& row) { row.q[0][2] = NAN; }),
       "trajectory.csv:"},
      {"FootBelowTheFloor", Of::kConsistency,
       [](Material& m) {
         m.robot.com_height -= 0.1;
         m.robot.waist_height -= 0.1;
         for (PlayedRow& row : m.rows) row.waist[2] -= 0.1;
       },
       "soles by forward kinematics: "},
      {"BodiesHigherDemanded", Of::kProved, Demand(kGround, 0.9), "bodies above the floor: "},
      {"PlayedBodiesHigherDemanded", Of::kFloor, Demand(kGround, 0.9),
       "played, bodies above the floor: "},
      {"RowOffTheWalk", Of::kWalk, InFlight([](PlayedRow& row) { row.q[0][2] += 1e-7; }),
       "trajectory.csv:"},
      {"RowBetweenTwoInstants", Of::kWalk,
       [](Material& m) {
         PlayedRow& row = Flying(m);
         row = DescribedWalk(m.robot, m.planned, m.half_steps).Row(row.t + 1e-6);
       },
       "trajectory.csv:"},
      {"TimeOffTheGrid", Of::kWalk, InFlight([](PlayedRow& row) { row.t += 1e-6; }),
       "trajectory.csv:"},
      {"SupportOfAnother", Of::kWalk,
       InFlight([](PlayedRow& row) { row.support = Support::kBoth; }), "trajectory.csv:"},
      {"HalfStepOfAnother", Of::kWalk, InFlight([](PlayedRow& row) { ++row.half_step; }),
       "trajectory.csv:"},
      {"FormThatWasNotWalked", Of::kWalk,
       [](Material& m) { m.half_steps[0].form = FormColumns{0.24, 0.3, 0.1, 1, 0, 0.05, 1}; },
       "trajectory.csv:"},
      {"DemandOfARowLower", Of::kArithmetic, Claim(kZmp, [](ClaimRow& row) { row.demanded -= 1; }),
       "certificate.csv:"},
      {"EndsElsewhere", Of::kArithmetic, [](Material& m) { m.certificate.duration += 1; },
       "the certificate ends at"},
      {"JointSpeedScaleAboveOne", Of::kArithmetic,
       [](Material& m) { m.certificate.joint_speed_scale = 3; }, "joint_speed_scale is 3"},
      {"FootSpeedLimitZero", Of::kArithmetic, [](Material& m) { m.certificate.foot_speed = 0; },
       "a foot's limit is 0"},
      {"DemandNegative", Of::kArithmetic, Demand(kZmp, -0.1), "a demanded margin is -0.1"},
  };
}

std::vector<Wrong> All() {
  std::vector<Wrong> all;
  for (const auto& some : {Rows(), Consistency(), Claims(), WrongSteps(), Others()}) {
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

class Checks : public testing::TestWithParam<Wrong> {};

TEST_P(Checks, SayWhatIsWrong) {
  const Wrong& wrong = GetParam();
  Material material = Original();
  EXPECT_THAT(FindingsOf(wrong.check, material).reasons(), IsEmpty());
  wrong.tamper(material);
  const Findings findings = FindingsOf(wrong.check, material);
  EXPECT_THAT(findings.reasons(), testing::Contains(testing::StartsWith(wrong.reason)))
      << testing::PrintToString(findings.reasons());
}

INSTANTIATE_TEST_SUITE_P(Verify, Checks, testing::ValuesIn(All()),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace halfstep::verify
