// Walks of which more is asked: how long both feet stand between steps, how fast a foot lands,
// joint accelerations that no file limits. They are verified, and forged certificates of them are
// refused.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/commands/commands.h"
#include "tests/verify/certificate_forgery.h"
#include "wpg/files/number_text.h"

namespace halfstep {
namespace {

using testing::HasSubstr;
using testing::Not;
using Table = TamperedRun::Table;
using Json = nlohmann::ordered_json;

// The two half-steps of Fig. 3, lower; their ZMPs shift in 0.1 s.
TamperedWalk AskedWalk() {
  return {.config = "fig3_two_half_steps",
          .overrides = {"half_step.via_height_m=0.1", "smoothing.margins.double_support_s=0.1",
                        "smoothing.limits.landing_speed_m_s=0.5",
                        "smoothing.limits.joint_acceleration_rad_s2=12"}};
}

// certificate.csv
enum : size_t { kFamilyAt = 2, kSubjectAt = 4, kMarginAt = 5, kBoundAt = 6 };

// The first row of a family that has a margin.
std::vector<std::string>& RowOf(Table& table, const std::string& family) {
  return *std::ranges::find_if(table, [&](const std::vector<std::string>& row) {
    return row[kFamilyAt] == family && row[kMarginAt] != "inf";
  });
}

class ForgedRequests : public testing::TestWithParam<CertificateForgery> {};

TEST_P(ForgedRequests, AreRefused) { ExpectRefused(AskedWalk(), GetParam()); }

// Changes cells of the first row of a family.
std::function<void(TamperedRun&)> Row(const std::string& family,
                                      const std::function<void(std::vector<std::string>&)>& edit) {
  return [=](TamperedRun& run) {
    run.EditCertificate([&](Table& table) { edit(RowOf(table, family)); });
  };
}
std::function<void(TamperedRun&)> Document(const std::function<void(Json&)>& edit) {
  return [edit](TamperedRun& run) { run.EditJson(edit); };
}
// A margin that is a little larger.
void Raise(std::vector<std::string>& row) {
  row[kMarginAt] = ShortestText(std::stod(row[kMarginAt]) + 1e-4);
}

INSTANTIATE_TEST_SUITE_P(
    Verify, ForgedRequests,
    testing::Values(
        CertificateForgery{"ShiftRaised", Row("double_support", Raise), "by the walk"},
        CertificateForgery{"OfAnotherHalfStep",
                           Row("double_support",
                               [](auto& row) {
                                 row[kSubjectAt] = row[kSubjectAt] == "half-step 1" ? "half-step 2"
                                                                                    : "half-step 1";
                               }),
                           "changes no support there"},
        CertificateForgery{
            "OfNoHalfStep",
            Row("double_support", [](auto& row) { row[kSubjectAt] = "half-step 9"; }),
            "the walk has no half-step 9"},
        CertificateForgery{"OfNothing",
                           Row("double_support", [](auto& row) { row[kSubjectAt] = "half-step"; }),
                           "nothing is called 'half-step'"},
        CertificateForgery{"ShiftUnwatched",
                           Row("double_support",
                               [](auto& row) {
                                 row[kSubjectAt] = "no half-step";
                                 row[kMarginAt] = "inf";
                               }),
                           "changes support in 0.1 s"},
        CertificateForgery{"ShiftDemandRaised",
                           Document([](Json& j) { j["demanded"]["double_support"] = 0.2; }),
                           "ZMPs from foot to foot"},
        CertificateForgery{"ShiftsLeftOut",
                           [](TamperedRun& run) {
                             run.EditJson([](Json& j) {
                               j["demanded"].erase("double_support");
                               j["statements"].erase("double_support");
                             });
                             run.EditCertificate([](Table& t) {
                               std::erase_if(t, [](const auto& row) {
                                 return row[kFamilyAt] == "double_support";
                               });
                             });
                           },
                           "double_support: the certificate demands -inf, config.yaml 0.1"},
        CertificateForgery{"NotInTheStatement", Document([](Json& j) {
                             std::string text = j["statement"];
                             const std::string words =
                                 ", how long the ZMP of each half-step goes from foot to foot";
                             j["statement"] = text.erase(text.find(words), words.size());
                           }),
                           "the certificate's statement is not the one that is verified"},
        CertificateForgery{"LandingRaised", Row("landing_speed", Raise), "by the walk"},
        CertificateForgery{"LandingBoundLowered",
                           [](TamperedRun& run) {
                             run.EditCertificate([](Table& t) {
                               for (auto& row : t) {
                                 if (row[kFamilyAt] == "landing_speed") row[kBoundAt] = "0";
                               }
                             });
                           },
                           "beyond"},
        CertificateForgery{"LandingLimitLooser",
                           Document([](Json& j) { j["limits"]["landing_speed_m_s"] = 2.0; }),
                           "landing_speed_m_s: the certificate's limit is looser"},
        CertificateForgery{"LandingLimitLower",
                           Document([](Json& j) { j["limits"]["landing_speed_m_s"] = 0.02; }),
                           "landing speed"},
        CertificateForgery{"AccelerationLooser", Document([](Json& j) {
                             j["limits"]["joint_acceleration_rad_s2"] = 100.0;
                           }),
                           "joint_acceleration_rad_s2: the certificate's limit is looser"},
        CertificateForgery{"AssumptionUntold", Document([](Json& j) {
                             auto& list = j["not_covered"];
                             for (size_t i = 0; i < list.size(); ++i) {
                               if (list[i]["subject"] == "joint_acceleration") list.erase(i);
                             }
                           }),
                           "limits of joint accelerations are assumed (12 rad/s²)"}),
    [](const auto& info) { return info.param.name; });

TEST(VerifyAsked, WhatIsUntouchedIsVerifiedAndSaysWhatWasLookedAt) {
  const TamperedRun run(AskedWalk());
  const Outcome outcome = run.Verify();
  EXPECT_EQ(outcome.status, kSuccess) << outcome.out << outcome.err;
  for (const char* said :
       {"ZMPs from foot to foot", "landing speed", "joint accelerations", "double_support 1",
        "landing_speed 1", "joint_acceleration 12",
        "limits of joint accelerations are assumed (12 rad/s²): the robot file states none"}) {
    EXPECT_THAT(outcome.out, HasSubstr(said));
  }
  const std::string config = ReadText(run.run() / "config.yaml");
  EXPECT_THAT(config, HasSubstr("double_support_s: 0.1"));
  EXPECT_THAT(config, HasSubstr("landing_speed_m_s: 0.5"));
  EXPECT_THAT(config, HasSubstr("joint_acceleration_rad_s2: 12"));
  EXPECT_THAT(ReadText(run.trajectory()), HasSubstr("joint_acceleration_margin_rad_s2"));
}

// Where nothing is asked no file of a run says anything of it.
TEST(VerifyAsked, WithoutARequestNothingIsClaimed) {
  const TamperedRun run({.overrides = {"smoothing.profile=limit"}});
  for (const char* file : {"config.yaml", "dichotomy/trajectory.csv", "dichotomy/certificate.csv",
                           "dichotomy/certificate.json", "summary.csv", "manifest.json"}) {
    const std::string text = ReadText(run.run() / file);
    for (const char* word :
         {"double_support", "landing_speed", "assumed (", "joint_acceleration_rad_s2"}) {
      EXPECT_THAT(text, Not(HasSubstr(word))) << file;
    }
  }
}

}  // namespace
}  // namespace halfstep
