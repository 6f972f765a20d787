// Walks of a robot whose file limits joint accelerations: they keep the limits, are longer for
// them, and forged certificates of them are refused.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "experiments/commands/commands.h"
#include "experiments/verify/joint_accelerations.h"
#include "tests/verify/certificate_forgery.h"
#include "wpg/files/number_text.h"

namespace halfstep {
namespace {

using testing::HasSubstr;
using testing::Not;
using Table = TamperedRun::Table;
using Json = nlohmann::ordered_json;

constexpr double kAccelerationLimit = 12.0;  // [rad/s²], of every leg joint
const std::string kAccelerations = "joint_acceleration";

// The two half-steps of Fig. 3, lower.
TamperedWalk LimitedWalk() {
  return {.config = "fig3_two_half_steps",
          .overrides = {"half_step.via_height_m=0.1"},
          .acceleration = kAccelerationLimit};
}

// certificate.csv
enum : size_t { kFamilyCell = 2, kSubjectCell = 4, kMarginCell = 5, kBoundCell = 6 };

// The row of the family with the largest bound.
std::vector<std::string>& LoosestOf(Table& table) {
  const auto bound = [](const std::vector<std::string>& row) {
    return row[kFamilyCell] == kAccelerations ? std::stod(row[kBoundCell]) : -1.0;
  };
  return *std::ranges::max_element(table, {}, bound);
}

class ForgedAccelerations : public testing::TestWithParam<CertificateForgery> {};

TEST_P(ForgedAccelerations, AreRefused) { ExpectRefused(LimitedWalk(), GetParam()); }

std::function<void(TamperedRun&)> AccelerationRows(std::function<void(Table&)> edit) {
  return [edit](TamperedRun& run) { run.EditCertificate(edit); };
}
std::function<void(TamperedRun&)> AccelerationJson(std::function<void(Json&)> edit) {
  return [edit](TamperedRun& run) { run.EditJson(edit); };
}

INSTANTIATE_TEST_SUITE_P(
    Verify, ForgedAccelerations,
    testing::Values(
        CertificateForgery{"Unwatched",
                           AccelerationRows([](Table& t) { LoosestOf(t)[kMarginCell] = "inf"; }),
                           "the robot has limits"},
        CertificateForgery{"MarginRaised", AccelerationRows([](Table& t) {
                             std::string& margin = LoosestOf(t)[kMarginCell];
                             margin = ShortestText(std::stod(margin) + 1e-4);
                           }),
                           "by the walk"},
        CertificateForgery{"OfAnotherJoint", AccelerationRows([](Table& t) {
                             std::string& joint = LoosestOf(t)[kSubjectCell];
                             joint = joint == "LLEG_JOINT0" ? "LLEG_JOINT1" : "LLEG_JOINT0";
                           }),
                           "by the walk"},
        CertificateForgery{"OfNoJoint", AccelerationRows([](Table& t) {
                             LoosestOf(t)[kSubjectCell] = "LLEG_LINK0";
                           }),
                           "nothing is called 'LLEG_LINK0'"},
        CertificateForgery{"BoundsLowered", AccelerationRows([](Table& t) {
                             for (auto& row : t) {
                               if (row[kFamilyCell] == kAccelerations) row[kBoundCell] = "0";
                             }
                           }),
                           "beyond"},
        CertificateForgery{"DemandRaised",
                           AccelerationJson([](Json& j) { j["demanded"][kAccelerations] = 11.9; }),
                           "joint accelerations"},
        CertificateForgery{"DemandLeftOut", AccelerationJson([](Json& j) {
                             j["demanded"][kAccelerations] = nullptr;
                           }),
                           "joint_acceleration: the certificate demands -inf, config.yaml 0"},
        CertificateForgery{"FamilyLeftOut",
                           [](TamperedRun& run) {
                             run.EditJson([](Json& j) {
                               j["demanded"].erase(kAccelerations);
                               j["statements"].erase(kAccelerations);
                             });
                             run.EditCertificate([](Table& t) {
                               std::erase_if(t, [](const auto& row) {
                                 return row[kFamilyCell] == kAccelerations;
                               });
                             });
                           },
                           "joint_acceleration: certificate.json has 0 statements, the robot 12"},
        CertificateForgery{"StatementOfARobotWithoutLimits", AccelerationJson([](Json& j) {
                             std::string text = j["statement"];
                             const std::string words =
                                 "joint accelerations where the robot file limits them, ";
                             j["statement"] = text.erase(text.find(words), words.size());
                           }),
                           "the certificate's statement is not the one that is verified"},
        CertificateForgery{"ColumnRaised",
                           [](TamperedRun& run) {
                             run.EditTrajectory([](Table& t) {
                               std::string& margin = t[t.size() / 2].back();
                               margin = ShortestText(std::stod(margin) + 1e-3);
                             });
                           },
                           "joint_acceleration_margin_rad_s2 is"},
        CertificateForgery{"LimitLowered",
                           [](TamperedRun& run) {
                             TamperedRun::Replace(run.urdf().parent_path() / "hrp2.yaml",
                                                  "RLEG_JOINT3: 12.0", "RLEG_JOINT3: 2.0");
                           },
                           "joint accelerations"}),
    [](const auto& info) { return info.param.name; });

TEST(VerifyAccelerations, WhatIsUntouchedIsVerifiedAndSaysWhatWasLookedAt) {
  const TamperedRun run(LimitedWalk());
  const Outcome outcome = run.Verify();
  EXPECT_EQ(outcome.status, kSuccess) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("joint accelerations"));
  EXPECT_THAT(outcome.out, HasSubstr("joint_acceleration 12"));
  EXPECT_THAT(ReadText(run.trajectory()),
              HasSubstr(",friction_margin,joint_acceleration_margin_rad_s2\n"));
  EXPECT_THAT(ReadText(run.run() / "config.yaml"), Not(HasSubstr("joint_acceleration")));
}

// The tables, config and claims of a robot without limits have nothing of it; that nothing is
// demanded is told.
TEST(VerifyAccelerations, OfARobotWithoutLimitsNothingIsClaimed) {
  const TamperedRun run;
  for (const char* file :
       {"config.yaml", "dichotomy/trajectory.csv", "dichotomy/certificate.csv", "summary.csv"}) {
    EXPECT_THAT(ReadText(run.run() / file), Not(HasSubstr("accelerations"))) << file;
    EXPECT_THAT(ReadText(run.run() / file), Not(HasSubstr(kAccelerations))) << file;
  }
  Json json = Json::parse(ReadText(run.json()));
  const std::string told =
      kAccelerations + ": nothing is demanded: the robot file states no limits";
  EXPECT_THAT(json["not_covered"].dump(), HasSubstr(told));
  json.erase("not_covered");
  EXPECT_THAT(json.dump(), Not(HasSubstr("accelerations")));
  EXPECT_THAT(json.dump(), Not(HasSubstr(kAccelerations)));
  const Outcome outcome = run.Verify();
  EXPECT_EQ(outcome.status, kSuccess) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr(told));
}

// Nothing may be demanded, by the config; then nothing is said.
TEST(VerifyAccelerations, WithoutADemandNothingIsClaimed) {
  TamperedWalk walk = LimitedWalk();
  walk.overrides.push_back("smoothing.margins.joint_acceleration_rad_s2=none");
  const TamperedRun run(walk);
  const Outcome outcome = run.Verify();
  EXPECT_EQ(outcome.status, kSuccess) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("joint accelerations: nothing is demanded"));
  EXPECT_TRUE(Json::parse(ReadText(run.json()))["demanded"][kAccelerations].is_null());
  EXPECT_THAT(ReadText(run.run() / "config.yaml"), HasSubstr("joint_acceleration_rad_s2: none"));
}

}  // namespace
}  // namespace halfstep
