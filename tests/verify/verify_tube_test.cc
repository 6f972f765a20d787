// Certificates of motions within a tube: accepted as the program writes them, and refused where
// their demands do not carry the tube.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/tables/certificate_statement.h"
#include "experiments/verify/tube_raise.h"
#include "smoothing/margins/demandable.h"
#include "smoothing/margins/family_traits.h"
#include "tests/patterns.h"
#include "tests/smoothing/certificate_draws.h"
#include "tests/verify/certificate_forgery.h"
#include "wpg/files/number_text.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using testing::HasSubstr;
using Table = TamperedRun::Table;
using Json = nlohmann::ordered_json;

TamperedWalk WalkInATube() {
  return {.config = "fig3_two_half_steps",
          .overrides = {"smoothing.profile=limit",
                        "smoothing.tube={foot_m: 0.005, foot_deg: 0.5, waist_m: 0.005, waist_deg: "
                        "0.5, joint_rad: 0.005, joint_speed_rad_s: 0.1, zmp_m: 0.01}"}};
}

// Demands so much of the margins of a family, everywhere in the certificate.
void Demand(const std::string& family, double demanded, TamperedRun* run) {
  run->EditJson([&](Json& json) { json["demanded"][family] = demanded; });
  run->EditCertificate([&](Table& table) {
    for (auto& row : table) {
      if (row[2] == family) row[7] = ShortestText(demanded);
    }
  });
}

class ForgedTubes : public testing::TestWithParam<CertificateForgery> {};

TEST_P(ForgedTubes, AreRefused) { ExpectRefused(WalkInATube(), GetParam()); }

std::function<void(TamperedRun&)> TubeJson(std::function<void(Json&)> edit) {
  return [edit](TamperedRun& run) { run.EditJson(edit); };
}

INSTANTIATE_TEST_SUITE_P(
    Verify, ForgedTubes,
    testing::Values(
        CertificateForgery{"DemandedAsWithout",
                           [](TamperedRun& run) { Demand("floor", 0.005, &run); },
                           "floor: the certificate demands 0.005, config.yaml 0.0112"},
        CertificateForgery{"DemandedALittleLess",
                           [](TamperedRun& run) { Demand("zmp_robot", 0.026, &run); },
                           "zmp_robot: the certificate demands 0.026, config.yaml 0.0262"},
        CertificateForgery{"Wider", TubeJson([](Json& j) { j["tube"]["joint_rad"] = 0.01; }),
                           "the tube of the certificate is not that of config.yaml"},
        // The config says so, too: what is demanded does not suffice any more.
        CertificateForgery{"WiderEverywhere",
                           [](TamperedRun& run) {
                             run.EditJson([](Json& j) { j["tube"]["waist_m"] = 0.01; });
                             TamperedRun::Replace(run.run() / "config.yaml", "waist_m: 0.005",
                                                  "waist_m: 0.01");
                           },
                           "ground: the certificate says that the tube raises it by"},
        CertificateForgery{"RaisedLess",
                           TubeJson([](Json& j) { j["tube"]["raised"]["floor"] = 0.006; }),
                           "floor: the certificate says that the tube raises it by 0.006"},
        CertificateForgery{"TakenLess",
                           TubeJson([](Json& j) { j["tube"]["taken"]["clearance"] = 0.006; }),
                           "tube: the certificate says that it takes 0.006"},
        CertificateForgery{"SelfClearanceAsWithout",
                           [](TamperedRun& run) {
                             run.EditCertificate([](Table& table) {
                               for (auto& row : table) {
                                 if (row[2] != "self_clearance") continue;
                                 row[5] = ShortestText(std::stod(row[5]) + 0.004);
                               }
                             });
                           },
                           "by the walk"},
        CertificateForgery{"MoreFamilies",
                           TubeJson([](Json& j) { j["tube"]["raised"]["friction"] = 0; }),
                           "other families are raised than those that hold in it"},
        CertificateForgery{"FewerFamilies",
                           TubeJson([](Json& j) { j["tube"]["raised"].erase("joint"); }),
                           "other families are raised than those that hold in it"},
        CertificateForgery{"LeftOut", TubeJson([](Json& j) { j.erase("tube"); }),
                           "config.yaml has a tube, the certificate has none"}),
    [](const auto& info) { return info.param.name; });

TEST(VerifyTube, AcceptsTheRunAsItIs) {
  const TamperedRun run(WalkInATube());
  const Outcome outcome = run.Verify();
  EXPECT_EQ(outcome.status, kSuccess) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("tube: takes up to 0.0139"));
  EXPECT_THAT(outcome.out, HasSubstr("motion that at every instant stays within that tube"));
}

TEST(VerifyTube, TheStatementNamesTheFamiliesThatHoldInIt) {
  const std::string statement = kTubeStatement;
  const size_t colon = statement.find("zmp_robot:");
  const size_t list = statement.find(" in floor");
  const std::string named = statement.substr(list, colon + 10 - list);
  for (const MarginFamily family : AllMarginFamilies()) {
    const std::string pattern = "[ ,]" + std::string(Name(family)) + "[ ,:]";
    EXPECT_EQ(bool(FirstMatch(named, pattern)), Traits(family).in_tube != nullptr) << Name(family);
  }
}

TEST(VerifyTube, OfZeroIsNone) {
  const TamperedRun run({.config = "fig3_two_half_steps", .overrides = {"smoothing.tube.zmp_m=0"}});
  const TamperedRun without({.config = "fig3_two_half_steps"});
  EXPECT_EQ(ReadText(run.certificate()), ReadText(without.certificate()));
  EXPECT_EQ(ReadText(run.json()), ReadText(without.json()));
  EXPECT_EQ(run.Verify().status, kSuccess);
}

// Derived twice, by the joints of a chain and along one line through the robot.
TEST(VerifyTube, FindsWhatTheProgramFinds) {
  std::vector<RobotModel> robots = RobotsOfAllKinds();
  for (RobotModel& robot : RobotsWithOffsets()) robots.push_back(std::move(robot));
  WalkDraw draw(5);
  for (const RobotModel& robot : robots) {
    for (int i = 0; i < 20; ++i) {
      const Tube tube{.foot = draw.Uniform(0, 0.05),
                      .foot_turn = draw.Uniform(0, 0.1),
                      .waist = draw.Uniform(0, 0.05),
                      .waist_turn = draw.Uniform(0, 0.1),
                      .joint = draw.Uniform(0, 0.1),
                      .joint_speed = draw.Uniform(0, 1),
                      .zmp = draw.Uniform(0, 0.05)};
      const auto raised = RaisedBy(tube, robot);
      const auto fall = verify::FallInTube(tube, robot);
      const TubeShift shift(robot, tube);
      const verify::BodyWays ways(tube, robot);
      for (size_t b = 0; b < robot.bodies.size(); ++b) {
        EXPECT_NEAR(shift.bodies[b], ways.bodies[b], 1e-12);
      }
      for (size_t p = 0; p < robot.self_pairs.size(); ++p) {
        const auto [a, b] = robot.self_pairs[p];
        EXPECT_NEAR(shift.pairs[p], ways.nearer(a, b), 1e-12);
      }
      for (const MarginFamily family : AllMarginFamilies()) {
        EXPECT_NEAR(Nth(raised, family), Nth(fall, family), 1e-12) << Name(family);
        EXPECT_GE(Nth(raised, family), Nth(fall, family)) << Name(family);
      }
    }
  }
}

}  // namespace
}  // namespace halfstep
