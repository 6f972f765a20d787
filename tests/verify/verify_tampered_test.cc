// A run whose files were tampered with, one thing at a time, with the reason that must be given.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/verify/verify_mutation.h"
#include "wpg/files/number_text.h"

namespace halfstep {
namespace {

using testing::HasSubstr;
using Table = TamperedRun::Table;
using Json = nlohmann::ordered_json;

double Number(const std::string& text) { return std::stod(text); }
size_t Column(const Table& table, const std::string& name) {
  const auto& header = table.front();
  return static_cast<size_t>(std::find(header.begin(), header.end(), name) - header.begin());
}
void Add(std::string* cell, double change) { *cell = ShortestText(Number(*cell) + change); }

// certificate.csv
enum : size_t { kBegin, kEnd, kFamily, kStatements, kSubject, kMargin, kBound, kDemanded };

// The row of a family with the largest bound and a finite margin.
std::vector<std::string>& Loosest(Table& table, const std::string& family) {
  std::vector<std::string>* found = nullptr;
  for (auto& row : table) {
    if (row[kFamily] != family || row[kMargin] == "inf") continue;
    if (found == nullptr || Number(row[kBound]) > Number((*found)[kBound])) found = &row;
  }
  return *found;
}

struct Mutation {
  std::string name;
  std::function<void(TamperedRun&)> tamper;
  std::string reason;    ///< part of what must be said
  bool rehashed = true;  ///< the hashes follow the change
  int status = kNotVerified;
};
void PrintTo(const Mutation& mutation, std::ostream* out) { *out << mutation.name; }

std::function<void(TamperedRun&)> Certificate(std::function<void(Table&)> edit) {
  return [edit](TamperedRun& run) { run.EditCertificate(edit); };
}
std::function<void(TamperedRun&)> Trajectory(std::function<void(Table&)> edit) {
  return [edit](TamperedRun& run) { run.EditTrajectory(edit); };
}
std::function<void(TamperedRun&)> InJson(std::function<void(Json&)> edit) {
  return [edit](TamperedRun& run) { run.EditJson(edit); };
}
// Adds to a column of trajectory.csv at a row (1: the first).
std::function<void(TamperedRun&)> Nudge(const std::string& column, size_t row, double change) {
  return Trajectory([=](Table& table) { Add(&table[row][Column(table, column)], change); });
}
std::function<void(TamperedRun&)> InScene(const std::string& old, const std::string& by) {
  return [=](TamperedRun& run) { TamperedRun::Replace(run.scene(), old, by); };
}

void Widen(Table& table) { Add(&table[100][kEnd], 0.01); }
void DropRow(Table& table) { table.erase(table.begin() + 200); }
void RaiseClearance(Table& table) { Add(&Loosest(table, "clearance")[kMargin], 0.05); }
void LowerBoundsOf(Table& table, const std::string& family) {
  for (auto& row : table) {
    if (row[kFamily] == family) row[kBound] = "0";
  }
}

// Everything twice as fast: speeds, accelerations and times fit each other no longer.
void PlayTwiceAsFast(TamperedRun& run) {
  run.EditTrajectory([](Table& table) {
    for (size_t i = 1; i < table.size(); ++i) table[i][0] = ShortestText(0.5 * Number(table[i][0]));
  });
  run.EditCertificate([](Table& table) {
    for (size_t i = 1; i < table.size(); ++i) {
      for (size_t c : {kBegin, kEnd}) table[i][c] = ShortestText(0.5 * Number(table[i][c]));
    }
  });
  run.EditJson([](Json& json) { json["duration_s"] = 0.5 * json["duration_s"].get<double>(); });
}

// One body fewer everywhere in the certificate.
void LeaveOutABody(TamperedRun& run) {
  run.EditJson([](Json& json) { json["statements"]["clearance"] = 22; });
  run.EditCertificate([](Table& table) {
    double covered = -1;
    for (auto& row : table) {
      if (row[kFamily] != "clearance" || Number(row[kBegin]) < covered) continue;
      covered = Number(row[kEnd]);
      if (row[kStatements] == "23") row[kStatements] = "22";
    }
  });
}

// Leaves out the first thing of a kind that is not covered.
void LeaveOut(const std::string& kind, Json& json) {
  Json& list = json["not_covered"];
  for (size_t i = 0; i < list.size(); ++i) {
    if (list[i]["kind"] != kind) continue;
    list.erase(i);
    return;
  }
  ADD_FAILURE() << "there is none";
}

void LowerDemand(TamperedRun& run) {
  run.EditJson([](Json& json) { json["demanded"]["clearance"] = 0.001; });
  run.EditCertificate([](Table& table) {
    for (auto& row : table) {
      if (row[kFamily] == "clearance") row[kDemanded] = "0.001";
    }
  });
}

// The ZMP a centimetre aside for an instant, and the CoM's acceleration with it.
void MoveZmp(Table& table) {
  Add(&table[300][Column(table, "zmp_x_m")], 0.01);
  Add(&table[300][Column(table, "com_ax_m_s2")], -0.01 * 9.81 / 0.814);
}

const char kCertificateRow[] = "certificate.csv:";
const char kDiffers[] = "SHA-256 differs";

std::vector<Mutation> Mutations() {
  return {
      {"IntervalWidenedAfterTheRun", Certificate(Widen), kDiffers, false},
      {"IntervalWidened", Certificate(Widen), "statements instead of"},
      {"IntervalTurnedAround",
       Certificate([](Table& t) { std::swap(t[100][kBegin], t[100][kEnd]); }), "is empty"},
      {"ClearanceRaisedAfterTheRun", Certificate(RaiseClearance), kDiffers, false},
      {"ClearanceRaised", Certificate(RaiseClearance), "by the walk"},
      {"ZmpMarginRaised", Certificate([](Table& t) { Add(&Loosest(t, "zmp")[kMargin], 0.01); }),
       kCertificateRow},
      {"ReachRaised", Certificate([](Table& t) { Add(&Loosest(t, "reach")[kMargin], 0.01); }),
       kCertificateRow},
      {"JointSpeedMarginRaised",
       Certificate([](Table& t) { Add(&Loosest(t, "joint_speed")[kMargin], 2); }), kCertificateRow},
      {"FootSpeedUnwatched",
       Certificate([](Table& t) { Loosest(t, "foot_speed")[kMargin] = "inf"; }), "a foot moves"},
      {"FloorUnwatched", Certificate([](Table& t) { Loosest(t, "floor")[kMargin] = "inf"; }),
       "a foot moves"},
      {"ClearanceUnwatched",
       Certificate([](Table& t) { Loosest(t, "clearance")[kMargin] = "inf"; }), "not finite"},
      {"ClearanceBoundLowered", Certificate([](Table& t) { LowerBoundsOf(t, "clearance"); }),
       kCertificateRow},
      {"ZmpBoundLowered", Certificate([](Table& t) { LowerBoundsOf(t, "zmp"); }), "beyond"},
      {"JointBoundLowered", Certificate([](Table& t) { LowerBoundsOf(t, "joint"); }), "beyond"},
      {"BoundNegative", Certificate([](Table& t) { t[100][kBound] = "-1"; }), "negative"},
      {"BoundTooLarge", Certificate([](Table& t) { t[100][kMargin] = "1", t[100][kBound] = "2"; }),
       "margin − bound"},
      {"SubjectUnknown", Certificate([](Table& t) { t[100][kSubject] = "tail"; }),
       "nothing is called"},
      {"NotANumberInTheCertificate", Certificate([](Table& t) { t[100][kMargin] = "nan"; }),
       "not finite"},
      {"RowDroppedAfterTheRun", Certificate(DropRow), kDiffers, false},
      {"RowDropped", Certificate(DropRow), "statements instead of"},
      {"RowTwice", Certificate([](Table& t) { t.push_back(t.back()); }), "statements instead of"},
      {"StatementsOfARowChanged", Certificate([](Table& t) { Add(&t[9][kStatements], 1); }),
       "statements instead of"},
      {"AllRowsDropped", Certificate([](Table& t) { t.resize(1); }), "statements instead of"},
      {"BodyLeftOut", LeaveOutABody, "the robot 23"},
      {"BodyGoneFromTheUrdf",
       [](TamperedRun& run) {
         TamperedRun::Replace(run.urdf(),
                              "<collision><geometry><mesh filename=\"package://hrp2_bodies/"
                              "chest.obj\"/></geometry></collision>",
                              "");
       },
       "the robot 22"},
      {"JointLimitTightened",
       [](TamperedRun& run) {
         TamperedRun::Replace(run.urdf().parent_path() / "hrp2.yaml", "RLEG_JOINT3: [2, 150]",
                              "RLEG_JOINT3: [2, 60]");
         TamperedRun::Replace(run.urdf().parent_path() / "hrp2.yaml", "LLEG_JOINT3: [2, 150]",
                              "LLEG_JOINT3: [2, 60]");
       },
       "joint limits"},
      {"RobotEditedAfterTheRun",
       [](TamperedRun& run) { TamperedRun::Replace(run.urdf(), "<robot", " <robot"); },
       "robot: not the one", false},
      {"ObstacleMovedAfterTheRun", InScene("0.137, -0.13", "0.147, -0.13"), "scene: not the one",
       false},
      {"ObstacleMoved", InScene("0.137, -0.13", "0.147, -0.13"), "clearance: RLEG_LINK5 - box"},
      {"ObstacleBesideTheBodies", InScene("0.137, -0.13, 0.04", "0, 0, 1.2"), "CHEST_LINK1 - box"},
      {"PlateInTheWay",
       [](TamperedRun& run) {
         WriteText(run.scene(), ReadText(run.scene()) +
                                    "  - name: plate\n    box: {size_m: [0.0001, 1, 1]}\n"
                                    "    pose: {xyz: [0.05, -0.7, 0.6]}\n");
       },
       "clearance: "},
      {"FootprintForbidden",
       [](TamperedRun& run) {
         TamperedRun::Replace(run.scene(), "no_step:\n",
                              "no_step:\n  - name: area\n    polygon_m: [[0.25, -0.12], [0.3, "
                              "-0.12], [0.3, -0.08]]\n");
       },
       "no-step areas: right sole"},
      {"JointNudgedIntoTheObstacle", Nudge("q_RLEG_JOINT4_rad", 288, -0.3),
       "off the walk of half_steps.csv"},
      {"JointNudgedAfterTheRun", Nudge("q_RLEG_JOINT4_rad", 288, -0.3), kDiffers, false},
      {"JointNudgedByAMilliradian", Nudge("q_LLEG_JOINT2_rad", 50, 0.001),
       "soles by forward kinematics"},
      {"WaistLowered", Nudge("waist_z_m", 50, -0.001), "waist under the CoM"},
      {"FootColumnMoved", Nudge("left_foot_x_m", 50, 0.001), "soles by forward kinematics"},
      {"ZmpMovedAlone", Nudge("zmp_x_m", 300, 0.01), "pendulum"},
      {"ZmpAndAccelerationMoved", Trajectory(MoveZmp), "CoM acceleration"},
      {"FootInTheAirCalledSupport",
       Trajectory([](Table& t) { t[288][Column(t, "support")] = "both"; }), "standing feet"},
      {"PlayedTwiceAsFast", PlayTwiceAsFast, "CoM velocity"},
      {"RowsSwapped", Trajectory([](Table& t) { std::swap(t[40], t[41]); }),
       "the times do not increase"},
      {"RowRemoved", Trajectory([](Table& t) { t.erase(t.begin() + 300, t.begin() + 320); }),
       "CoM velocity"},
      {"LastRowCut", Trajectory([](Table& t) { t.pop_back(); }), "the certificate ends at"},
      {"LastRowCutEverywhere",
       [](TamperedRun& run) {
         double end = 0;
         run.EditTrajectory([&](Table& t) {
           t.pop_back();
           end = Number(t.back()[0]);
         });
         run.EditJson([&](Json& json) { json["duration_s"] = end; });
       },
       "outside [0, D]"},
      {"NotANumberInserted", Trajectory([](Table& t) { t[20][30] = "nan"; }), "not finite"},
      {"InfinityInserted", Trajectory([](Table& t) { t[20][4] = "inf"; }), "not finite"},
      {"NumberOfNoSense", Trajectory([](Table& t) { t[20][30] = "1e300"; }), "beyond"},
      {"NoRows", Trajectory([](Table& t) { t.resize(1); }), "fewer than two"},
      {"HeaderChanged", Trajectory([](Table& t) { t[0][5] = "com_z"; }), "com_z_m", true,
       kBadInput},
      {"HeaderOfTheCertificateChanged", Certificate([](Table& t) { t[0][5] = "m"; }), "margin",
       true, kBadInput},
      {"CellMissing", Trajectory([](Table& t) { t[77].pop_back(); }), "trajectory.csv:78: ", true,
       kBadInput},
      {"TextForANumber", Trajectory([](Table& t) { t[77][4] = "1.2x"; }),
       "trajectory.csv:78: ", true, kBadInput},
      {"GroundMarginRaised",
       Certificate([](Table& t) { Add(&Loosest(t, "ground")[kMargin], 0.01); }), kCertificateRow},
      {"GroundBoundLowered", Certificate([](Table& t) { LowerBoundsOf(t, "ground"); }), "beyond"},
      {"GroundUnwatched", Certificate([](Table& t) { Loosest(t, "ground")[kMargin] = "inf"; }),
       "bodies have a height"},
      {"GroundOfAFoot",
       Certificate([](Table& t) { Loosest(t, "ground")[kSubject] = "LLEG_LINK5"; }),
       "a foot may touch the floor"},
      {"GroundOfNoBody", Certificate([](Table& t) { Loosest(t, "ground")[kSubject] = "robot"; }),
       "no body is named"},
      {"BodyBelowTheFloor",
       [](TamperedRun& run) {
         TamperedRun::Replace(run.urdf(),
                              "<collision><geometry><mesh filename=\"package://hrp2_bodies/"
                              "chest.obj\"/></geometry></collision>",
                              "<collision><origin xyz=\"0 0 -1.2\"/><geometry><mesh "
                              "filename=\"package://hrp2_bodies/chest.obj\"/></geometry>"
                              "</collision>");
       },
       "bodies above the floor: CHEST_LINK1"},
      {"NoStepUnwatched", Certificate([](Table& t) { Loosest(t, "no_step")[kMargin] = "inf"; }),
       "there are areas"},
      {"NoStepMarginRaised",
       Certificate([](Table& t) { Add(&Loosest(t, "no_step")[kMargin], 0.001); }), kCertificateRow},
      {"NoStepOfTheOtherFoot", Certificate([](Table& t) {
         for (auto& row : t) {
           if (row[kFamily] != "no_step") continue;
           row[kSubject] = (row[kSubject].front() == 'l' ? "right" : "left") +
                           std::string(" foot - no_step[0]");
         }
       }),
       "no_step: "},
      {"NoStepDemandRaised", InJson([](Json& j) { j["demanded"]["no_step"] = 0.2; }),
       "no-step areas"},
      {"RobotZmpUnwatched", Certificate([](Table& t) { Loosest(t, "zmp_robot")[kMargin] = "inf"; }),
       "the robot has a ZMP"},
      {"RobotZmpMarginRaised",
       Certificate([](Table& t) { Add(&Loosest(t, "zmp_robot")[kMargin], 1e-6); }), "by the walk"},
      {"RobotZmpDemandRaised", InJson([](Json& j) { j["demanded"]["zmp_robot"] = 0.1; }),
       "ZMP of the whole robot"},
      {"RobotZmpDemandLeftOut", InJson([](Json& j) { j["demanded"]["zmp_robot"] = nullptr; }),
       "zmp_robot: the certificate demands -inf, config.yaml 0.0274"},
      {"TorqueUnwatched", Certificate([](Table& t) { Loosest(t, "torque")[kMargin] = "inf"; }),
       "the robot has a ZMP"},
      {"TorqueMarginRaised",
       Certificate([](Table& t) { Add(&Loosest(t, "torque")[kMargin], 0.01); }), "by the walk"},
      {"TorqueOfAnotherJoint", Certificate([](Table& t) {
         std::string& joint = Loosest(t, "torque")[kSubject];
         joint = joint == "LLEG_JOINT0" ? "LLEG_JOINT1" : "LLEG_JOINT0";
       }),
       "by the walk"},
      {"TorqueBoundsLowered", Certificate([](Table& t) { LowerBoundsOf(t, "torque"); }),
       kCertificateRow},
      {"TorqueDemandRaised", InJson([](Json& j) { j["demanded"]["torque"] = 190; }),
       "joint torques"},
      {"TorqueDemandLeftOut", InJson([](Json& j) { j["demanded"]["torque"] = nullptr; }),
       "torque: the certificate demands -inf, config.yaml 0"},
      {"EffortLimitLowered",
       [](TamperedRun& run) {
         TamperedRun::Replace(run.urdf().parent_path() / "hrp2.yaml", "LLEG_JOINT3: 200",
                              "LLEG_JOINT3: 20");
       },
       "joint torques"},
      {"FrictionUnwatched", Certificate([](Table& t) { Loosest(t, "friction")[kMargin] = "inf"; }),
       "the robot has a ZMP"},
      {"FrictionMarginRaised",
       Certificate([](Table& t) { Add(&Loosest(t, "friction")[kMargin], 1e-4); }), "by the walk"},
      {"FrictionDemandRaised", InJson([](Json& j) { j["demanded"]["friction"] = 0.69; }),
       "friction"},
      {"FrictionDemandLeftOut", InJson([](Json& j) { j["demanded"]["friction"] = nullptr; }),
       "friction: the certificate demands -inf, config.yaml 0"},
      {"FloorMadeSlippery",
       [](TamperedRun& run) {
         TamperedRun::Replace(run.scene(), "no_step:", "friction: 0.05\nno_step:");
       },
       "friction"},
      {"PairLeftOutOfNotCovered", InJson([](Json& j) { LeaveOut("pair", j); }),
       "not_covered: certificate.json has "},
      {"FamilyLeftOutOfNotCovered", InJson([](Json& j) { LeaveOut("family", j); }),
       "found was family 'joint_acceleration: "},
      {"AssumptionLeftOutOfNotCovered", InJson([](Json& j) { LeaveOut("assumed", j); }),
       "found was assumed 'friction: "},
      {"PairAddedToNotCovered", InJson([](Json& j) {
         j["not_covered"].push_back(
             {{"kind", "pair"}, {"subject", "LLEG_LINK5 - RLEG_LINK5"}, {"sentence", "far"}});
       }),
       "found was nothing more"},
      {"ReasonOfNotCoveredChanged",
       InJson([](Json& j) { j["not_covered"].back()["sentence"] = "never near"; }), "never near"},
      {"NotCoveredEmptied", InJson([](Json& j) { j["not_covered"] = Json::array(); }),
       "not_covered: certificate.json has nothing more"},
      {"NotCoveredMissing", InJson([](Json& j) { j.erase("not_covered"); }), "not_covered", false,
       kBadInput},
      {"NotCoveredOfTheManifestShortened",
       [](TamperedRun& run) { run.EditManifest([](Json& j) { LeaveOut("pair", j); }); },
       "not_covered: manifest.json has "},
      {"DemandLowered", LowerDemand, "config.yaml 0.005"},
      {"FootSpeedLimitRaised", InJson([](Json& j) { j["limits"]["foot_speed_m_s"] = 2.0; }),
       "foot_speed_m_s"},
      {"FootSpeedLimitRemoved", InJson([](Json& j) { j["limits"]["foot_speed_m_s"] = nullptr; }),
       "foot_speed_m_s"},
      {"JointSpeedScaleRaised", InJson([](Json& j) { j["limits"]["joint_speed_scale"] = 3.0; }),
       "joint_speed_scale"},
      {"StatementPromisesMore",
       InJson([](Json& j) { j["statement"] = j["statement"].get<std::string>() + " And speed."; }),
       "the certificate's statement is not the one that is verified"},
      {"VerdictUndecided", InJson([](Json& j) { j["verdict"] = "undecided"; }), "undecided"},
      {"MemberMissing", InJson([](Json& j) { j["demanded"].erase("zmp"); }), "demanded.zmp", false,
       kBadInput},
  };
}

class Tampered : public testing::TestWithParam<Mutation> {};

TEST_P(Tampered, IsRejected) {
  TamperedRun run;
  GetParam().tamper(run);
  if (GetParam().rehashed) run.Rehash();
  const Outcome outcome = run.Verify();
  EXPECT_EQ(outcome.status, GetParam().status) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out + outcome.err, HasSubstr(GetParam().reason));
}

INSTANTIATE_TEST_SUITE_P(Verify, Tampered, testing::ValuesIn(Mutations()),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace halfstep
