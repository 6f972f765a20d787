// What `halfstep verify` derives of walks over levels, and what it must refuse of them. Hashes
// follow each forgery.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "experiments/verify/distances.h"
#include "experiments/verify/level_tops.h"
#include "planner/ground/level_borders.h"
#include "planner/ground/level_ground.h"
#include "tests/verify/certificate_forgery.h"
#include "tests/verify/rows_of.h"

namespace halfstep {
namespace {

using testing::HasSubstr;
using Table = TamperedRun::Table;

// Two steps onto a platform of 10 cm.
const TamperedWalk kOntoPlatform = {
    .config = "platform_15cm",
    .overrides = {"scene=../scenes/platform_10cm.yaml",
                  "footsteps=[{foot: right, x_m: 0.27, y_m: -0.105}, "
                  "{foot: left, x_m: 0.27, y_m: 0.105}]",
                  "half_step.crouch_m=0.02", "half_step.lift_share=0.9", "output.period_s=0.02"}};

TEST(VerifyLevels, AWalkOntoAPlatformIsVerified) {
  const TamperedRun run(kOntoPlatform);
  const Outcome outcome = run.Verify();
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("soles inside their levels: "));
  EXPECT_THAT(outcome.out, HasSubstr("foothold 2"));
}

// Two steps back on the floor, the waist lower from the first one on.
const TamperedWalk kLower = {
    .config = "platform_15cm",
    .overrides = {"scene=../scenes/platform_10cm.yaml",
                  "footsteps=[{foot: right, x_m: -0.05, y_m: -0.105, via_height_m: 0.12, "
                  "crouch_m: 0.08}, {foot: left, x_m: -0.1, y_m: 0.105, crouch_m: 0.03}]",
                  "output.period_s=0.02"}};

TEST(VerifyCrouch, AWalkThatChangesTheWaistsHeightIsVerified) {
  const TamperedRun run(kLower);
  const Outcome outcome = run.Verify();
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
}

size_t ColumnOf(const Table& table, const std::string& name) {
  const auto& header = table.front();
  return static_cast<size_t>(std::ranges::find(header, name) - header.begin());
}

// Adds to a number in a row of a table of the run, counted from the header.
std::function<void(TamperedRun&)> AddTo(const std::string& file, const std::string& column,
                                        size_t row, double by) {
  return [=](TamperedRun& run) {
    TamperedRun::EditCsv(run.run() / file, [&](Table& table) {
      std::string& cell = table.at(row).at(ColumnOf(table, column));
      cell = Formatted("%.17g", std::stod(cell) + by);
    });
  };
}

TEST(VerifyCrouch, OtherHeightsOfTheWaistAreRefused) {
  for (const double by : {1e-3, -1e-3}) {
    ExpectRefused(kLower, {"Crouch", AddTo("footsteps.csv", "crouch_m", 3, by),
                           "footsteps.csv:4: not the footstep of config.yaml"});
    ExpectRefused(kLower, {"CrouchAtTheStart", AddTo("footsteps.csv", "crouch_m", 2, by),
                           "footsteps.csv:3: not the footstep of config.yaml"});
  }
  ExpectRefused(kLower, {"NoCrouches",
                         [](TamperedRun& run) {
                           TamperedRun::EditCsv(run.run() / "footsteps.csv", [](Table& table) {
                             for (auto& row : table) row.pop_back();
                           });
                         },
                         "footsteps.csv:4: not the footstep of config.yaml"});
  ExpectRefused(kLower, {"Waist", AddTo("dichotomy/trajectory.csv", "waist_z_m", 100, 1e-4),
                         "waist is off the walk of half_steps.csv"});
}

std::function<void(TamperedRun&)> InGround(const std::string& old, const std::string& by) {
  return [=](TamperedRun& run) { TamperedRun::Replace(run.scene(), old, by); };
}

std::vector<CertificateForgery> ForgeriesOnLevels() {
  return {
      {"TreadHigher", InGround("height_m: 0.1", "height_m: 0.101"),
       "footsteps.csv:4: not the footstep of config.yaml"},
      {"TreadLower", InGround("height_m: 0.1", "height_m: 0.099"),
       "footsteps.csv:4: not the footstep of config.yaml"},
      {"RiserNearer",
       InGround("[[0.14, -1], [0.7, -1], [0.7, 1], [0.14, 1]]",
                "[[0.135, -1], [0.7, -1], [0.7, 1], [0.135, 1]]"),
       "foothold: margin"},
      // The soles reach forward to x = 0.121 m, and 5 mm are demanded.
      {"RiserNearerThanIsDemanded",
       InGround("[[0.14, -1], [0.7, -1], [0.7, 1], [0.14, 1]]",
                "[[0.124, -1], [0.7, -1], [0.7, 1], [0.124, 1]]"),
       "soles inside their levels: left sole at 0.000 s at t = 0 s: 0.003, demanded 0.005"},
      {"RiserNearerToMovingSoles",
       InGround("[[0.14, -1], [0.7, -1], [0.7, 1], [0.14, 1]]",
                "[[0.122, -1], [0.7, -1], [0.7, 1], [0.122, 1]]"),
       "height of a moving sole: swing foot - "},
      // The outline reaches back to x = 0.149 m.
      {"FootOverAnEdge",
       InGround("[[0.14, -1], [0.7, -1], [0.7, 1], [0.14, 1]]",
                "[[0.15, -1], [0.7, -1], [0.7, 1], [0.15, 1]]"),
       "config.yaml: footsteps[0]: no level of the scene bears all of the sole"},
      {"HeightOfAFootstep", AddTo("footsteps.csv", "z_m", 3, 1e-3),
       "footsteps.csv:4: not the footstep of config.yaml"},
      {"RiseOfTheWaist", AddTo("dichotomy/half_steps.csv", "rise_begin", 3, -0.1),
       "off the walk of half_steps.csv"},
      {"WaistOfARow", AddTo("dichotomy/trajectory.csv", "waist_z_m", 100, 1e-4),
       "waist is off the walk of half_steps.csv"},
      {"MarginOfFoothold",
       [](TamperedRun& run) {
         run.EditCertificate([](Table& table) {
           for (auto& row : table) {
             if (row[2] == "foothold") row[5] = Formatted("%.17g", std::stod(row[5]) + 1e-3);
           }
         });
       },
       "foothold: margin"},
      {"NothingOfFoothold",
       [](TamperedRun& run) {
         run.EditCertificate([](Table& table) {
           std::erase_if(table, [](const auto& row) { return row[2] == "foothold"; });
         });
       },
       "foothold: 0 statements instead of 2"},
      {"LessDemandedOfFoothold",
       [](TamperedRun& run) {
         run.EditJson([](nlohmann::ordered_json& json) { json["demanded"]["foothold"] = 0.001; });
       },
       "foothold: the certificate demands 0.001"},
  };
}

class ForgedLevels : public testing::TestWithParam<CertificateForgery> {};
TEST_P(ForgedLevels, IsRefusedForItsReason) { ExpectRefused(kOntoPlatform, GetParam()); }
INSTANTIATE_TEST_SUITE_P(Verify, ForgedLevels, testing::ValuesIn(ForgeriesOnLevels()),
                         [](const auto& info) { return info.param.name; });

// Tiles of two heights, one of which rests on another, and a hole, below a bridge; the floor is
// below.
Scene Tiles() {
  return ParseScene(
      "tiles.yaml",
      "surfaces:\n"
      "  - {name: a, polygon_m: [[0, 0], [1, 0], [1, 1], [0, 1]], height_m: 0.1}\n"
      "  - {name: b, polygon_m: [[1, 0], [2, 0.2], [2, 1], [1, 1]], height_m: 0.1}\n"
      "  - {name: c, polygon_m: [[0, 1], [0.8, 1], [0.8, 2], [0, 2]], height_m: 0.1}\n"
      "  - {name: d, polygon_m: [[1.2, 0.5], [1.5, 0.5], [1.5, 0.9]], height_m: 0.2,\n"
      "     thickness_m: 0.1}\n"
      "  - {name: e, polygon_m: [[0.8, 1], [2, 1], [2, 2], [0.8, 2]], height_m: 0.2}\n"
      "  - {name: f, polygon_m: [[0, 0.2], [2, 0.2], [2, 0.5], [0, 0.5]], height_m: 0.6,\n"
      "     thickness_m: 0.3}\n");
}

TEST(LevelTops, AreTheLevelsOfThePlanner) {
  const Scene scene = Tiles();
  const RobotModel& robot = verify::Fig5().robot;
  const verify::LevelTops own(scene);
  const LevelBorders theirs(*scene.ground);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(-0.2, 2.2), yaw(-3, 3);
  int inside = 0;
  for (int k = 0; k < 400; ++k) {
    const Pose2 X_WF{place(random), place(random), yaw(random)};
    for (const GroundLevel& level : scene.ground->Levels()) {
      const double is = own.Inside(robot, X_WF, level.height);
      const double expected = theirs.NearestTo(robot.sole_outline, X_WF, level.number).distance;
      if (expected > 0) {
        EXPECT_NEAR(is, expected, 1e-9) << k << " on level " << level.number;
        ++inside;
      } else {
        EXPECT_EQ(is, -1) << k << " on level " << level.number;
      }
    }
    const auto stands = scene.ground->Standing(robot.sole_outline, X_WF);
    const auto height = own.HeightUnder(robot, X_WF, {});
    EXPECT_EQ(height.has_value(), stands.has_value());
    if (stands && height) {
      EXPECT_EQ(*height, stands->height);
    }
  }
  EXPECT_GT(inside, 100);
}

TEST(LevelTops, KnowNamesAndWhatRestsOnALevel) {
  const Scene scene = Tiles();
  const RobotModel& robot = verify::Fig5().robot;
  const verify::LevelTops levels(scene);
  EXPECT_EQ(levels.HeightNamed("e"), 0.2);
  EXPECT_EQ(levels.HeightNamed("floor"), 0.0);
  EXPECT_EQ(levels.HeightNamed("g"), std::nullopt);
  EXPECT_EQ(levels.Inside(robot, {1.4, 0.7, 0}, 0.1), -1);  // d is there
  EXPECT_EQ(levels.Inside(robot, {0.5, 0.5, 0}, 0.15), -1);
  EXPECT_GT(levels.Inside(robot, {0.5, 0.9, 0}, 0.1), 0.1);  // across an edge that a and c share
  EXPECT_GT(levels.Inside(robot, {0.5, 0.3, 0}, 0.1), 0.1);  // below f
}

// As a part of a heightmap that is too small for a level and happens to be as high as one.
TEST(LevelTops, AreOfWhatBearsOnly) {
  const RobotModel& robot = verify::Fig5().robot;
  LevelSurface low{.name = "low", .polygon = Eigen::Matrix2Xd(2, 4), .height = 0.1};
  low.polygon << -1, 0, 0, -1, -1, -1, 1, 1;
  LevelSurface rubble = low;
  rubble.polygon.row(0).array() += 1.0;
  const auto inside = [&] {
    Scene scene;
    scene.ground = std::make_shared<const LevelGround>(std::vector{low, rubble}, true);
    return verify::LevelTops(scene).Inside(robot, {-0.3, 0.0, 0.0}, 0.1);
  };
  const double with = inside();
  rubble.bears = false;
  const double without = inside();
  EXPECT_GT(without, 0.1);
  EXPECT_LT(without, 0.3);
  EXPECT_GT(with, without + 0.3);
}

// A foot's bodies may touch what their sole is above, and nothing else.
TEST(Distances, OfAFootAreFromWhatIsHigherThanItsSole) {
  const Scene scene = Tiles();
  const RobotModel& robot = verify::Fig5().robot;
  const verify::Distances distances(robot, scene);
  ASSERT_EQ(distances.num_obstacles(), 6u);
  for (size_t b = 0; b < robot.bodies.size(); ++b) {
    const RobotBody& body = robot.bodies[b];
    const bool of_foot = body.leg >= 0 && body.link == 5;
    EXPECT_EQ(distances.MustKeepOff(b, 0, {0.1, 0.1}), !of_foot) << body.name;
    EXPECT_TRUE(distances.MustKeepOff(b, 4, {0.1, 0.1})) << body.name;
    EXPECT_TRUE(distances.MustKeepOff(b, 0, {0.0999, 0.0999})) << body.name;
  }
}

}  // namespace
}  // namespace halfstep
