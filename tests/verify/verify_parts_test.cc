// What the parts of verify claim by themselves: distances, the motion between two rows, the floor.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "experiments/verify/check_clearance.h"
#include "experiments/verify/check_rows.h"
#include "experiments/verify/csv_text.h"
#include "experiments/verify/distances.h"
#include "experiments/verify/floor_distances.h"
#include "experiments/verify/own_names.h"
#include "experiments/verify/played_motion.h"
#include "experiments/verify/robot_momentum.h"
#include "smoothing/methods/solver_method_options.h"
#include "tests/verify/rows_of.h"
#include "wpg/files/input_error.h"

namespace halfstep::verify {
namespace {

using testing::HasSubstr;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Distances, BoundingVolumesAreNeverFartherApartThanTheSolids) {
  Scene scene = Fig5().scene;
  scene.obstacles.push_back({"ball", MakeSphere(0.2), Eigen::Isometry3d::Identity()});
  scene.obstacles.push_back({"rod", MakeCapsule(0.02, 1.5), Eigen::Isometry3d::Identity()});
  scene.obstacles.push_back({"disc", MakeCylinder(0.5, 0.05), Eigen::Isometry3d::Identity()});
  scene.obstacles.push_back(
      {"mesh", FacesOf(MakeBox({0.3, 0.1, 1.2})), Eigen::Isometry3d::Identity()});
  const RobotModel& robot = Fig5().robot;
  const SuperposedWalk walk(Fig5().sequence, PlannedMotion(Fig5().sequence));
  const DescribedWalk described(robot, PlanOf(Fig5().sequence), RowsOf(walk));
  std::mt19937 random(8);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int k = 0; k < 12; ++k) {
    for (Obstacle& obstacle : scene.obstacles) {
      obstacle.X_WO.translation() = Eigen::Vector3d(unit(random), unit(random), 1 + unit(random));
      obstacle.X_WO.rotate(Eigen::AngleAxisd(unit(random), Eigen::Vector3d(1, 2, 3).normalized()));
    }
    Distances distances(robot, scene);
    const Placement at = PlaceRobot(robot, described.Row((0.5 + 0.4 * unit(random)) * 4));
    double nearest = kInfinity, nearest_pair = kInfinity;
    for (size_t b = 0; b < robot.bodies.size(); ++b) {
      for (size_t o = 0; o < scene.obstacles.size(); ++o) {
        const auto quick = distances.FromObstacle(b, o, at, 0.0, -kInfinity);
        const auto exact = distances.FromObstacle(b, o, at, 0.0, kInfinity);
        ASSERT_TRUE(!quick.exact && exact.exact);
        EXPECT_LE(quick.distance, exact.distance + 1e-9) << distances.NameOfObstaclePair(b, o);
        nearest = std::min(nearest, exact.distance);
      }
    }
    for (const auto& [i, j] : robot.self_pairs) {
      const auto a = static_cast<size_t>(i), b = static_cast<size_t>(j);
      const double exact = distances.OfPair(a, b, at, kInfinity).distance;
      EXPECT_LE(distances.OfPair(a, b, at, -kInfinity).distance, exact + 1e-9);
      nearest_pair = std::min(nearest_pair, exact);
    }
    EXPECT_EQ(distances.NearestObstacle(at, 0.0, 10), nearest);
    EXPECT_EQ(distances.NearestPair(at, 10), nearest_pair);
    EXPECT_LE(distances.NearestObstacle(at, 0.0, 0.01), 0.01);
  }
}

TEST(PlayedMotion, FarthestPointOfPrimitivesIsTheClosedForm) {
  const Eigen::Vector3d origin(0, 0, 0), aside(3, 4, 0);
  EXPECT_NEAR(FarthestFrom(MakeSphere(0.5), aside), 5.5, 1e-12);
  EXPECT_NEAR(FarthestFrom(MakeCapsule(0.5, 2), origin), 1.5, 1e-12);
  EXPECT_NEAR(FarthestFrom(MakeCylinder(3, 8), origin), 5, 1e-12);
  EXPECT_NEAR(FarthestFrom(MakeCylinder(3, 8), aside), std::hypot(8, 4), 1e-12);
}

// One coordinate at a time moves: every vertex stays within its body's path.
TEST(PlayedMotion, NoPointGoesFartherThanItsBodysPath) {
  const RobotModel& robot = Fig5().robot;
  const SuperposedWalk walk(Fig5().sequence, PlannedMotion(Fig5().sequence));
  const PlayedRow start = DescribedWalk(robot, PlanOf(Fig5().sequence), RowsOf(walk)).Row(1.1);
  for (int k = 0; k < 16; ++k) {
    std::vector<PlayedRow> rows = {start, start};
    rows[1].t += 0.01;
    if (k < 4) {
      rows[1].waist[k] += 0.01;
    } else {
      rows[1].q[static_cast<size_t>(k - 4) / 6][(k - 4) % 6] += 0.01;
    }
    const PlayedMotion motion(robot, rows);
    const Placement a = motion.PlaceRow(rows[0]), b = motion.PlaceRow(rows[1]);
    for (const RobotBody& body : robot.bodies) {
      const double in_world = motion.PathInWorld(body)[1], in_waist = motion.PathInWaist(body)[1];
      for (const Eigen::Vector3d& v : body.shape.vertices.colwise()) {
        EXPECT_LE((a.OfBody(body) * v - b.OfBody(body) * v).norm(), in_world + 1e-12) << body.name;
        EXPECT_LE((a.OfBody_B(body) * v - b.OfBody_B(body) * v).norm(), in_waist + 1e-12)
            << body.name;
      }
    }
  }
}

// A robot of dots, for what passes by closely and briefly.
constexpr double kDot = 1e-4;  // [m]
RobotBody Dot(const std::string& name, int leg, const Eigen::Vector3d& p) {
  RobotBody body{.name = name, .leg = leg, .link = leg < 0 ? -1 : 4, .shape = MakeSphere(kDot)};
  body.shape.vertices.col(0) += p;
  BoundBySphere(&body.shape);
  return body;
}
RobotModel WithoutBodies() {
  RobotModel robot = Fig5().robot;
  robot.bodies.clear();
  robot.self_pairs.clear();
  return robot;
}
std::vector<PlayedRow> TwoRows() {
  std::vector<PlayedRow> rows(2);
  rows[1].t = 0.01;
  for (PlayedRow& row : rows) {
    row.soles.fill(Eigen::Vector4d::Zero());
    row.q.fill(Vector6d::Zero());
  }
  return rows;
}
bool KeepsClearances(const RobotModel& robot, const Scene& scene,
                     const std::vector<PlayedRow>& rows) {
  CertificateText certificate;
  certificate.demanded.fill(0.004);
  Distances distances(robot, scene);
  Findings findings;
  CheckClearances(PlayedMotion(robot, rows), certificate, 0, &distances, &findings);
  return findings.disagreements() == 0;
}

TEST(CheckClearances, SeesAnObstacleThatIsPassedWithinAMillimetre) {
  RobotModel robot = WithoutBodies();
  robot.bodies.push_back(Dot("dot", -1, {0, 0, 0}));
  std::vector<PlayedRow> rows = TwoRows();
  rows[1].waist.x() = 0.1;
  for (double x = 0.01; x < 0.09; x += 0.0037) {
    for (const double distance : {0.0039, 0.005}) {
      Scene scene;
      scene.obstacles.push_back(
          {"dot", MakeSphere(kDot),
           Eigen::Isometry3d(Eigen::Translation3d(x, distance + 2 * kDot, 0))});
      EXPECT_EQ(KeepsClearances(robot, scene, rows), distance > 0.004) << x;
    }
  }
}

TEST(CheckClearances, SeesTwoLegsThatPassWithinAMillimetre) {
  for (double ahead = -0.02; ahead < 0.02; ahead += 0.0037) {
    for (const double distance : {0.0039, 0.007}) {
      RobotModel robot = WithoutBodies();
      const PlayedRow zero = TwoRows()[0];
      const Placement at = PlaceRobot(robot, zero);
      for (const int leg : {0, 1}) {
        RobotBody dot = Dot(leg == 0 ? "left" : "right", leg, {0, 0, 0});
        const double y = (leg == 0 ? 0.5 : -0.5) * (distance + 2 * kDot);
        dot = Dot(dot.name, leg,
                  at.OfBody_B(dot).inverse() * Eigen::Vector3d(leg == 0 ? ahead : 0, y, -0.6));
        robot.bodies.push_back(dot);
      }
      robot.self_pairs = {{0, 1}};
      std::vector<PlayedRow> rows = TwoRows();
      for (const int leg : {0, 1}) {
        for (const int end : {0, 1}) {
          rows[static_cast<size_t>(end)].q[static_cast<size_t>(leg)][2] = leg == end ? 0.15 : -0.15;
        }
      }
      EXPECT_EQ(KeepsClearances(robot, {}, rows), distance > 0.004) << ahead;
    }
  }
}

// A plan that stands, its soles at these heights.
WalkPlan StandingAt(double left, double right) {
  return {{Foothold({0, 0.1, 0}, left), Foothold({0, -0.1, 0}, right)}, {}};
}

TEST(WalkFloor, IsTheOneLevelOfAPlanUnlessItIsGiven) {
  EXPECT_NEAR(WalkFloor(StandingAt(0.2, 0.2)).Above(0.25), 0.05, 1e-15);
  EXPECT_EQ(WalkFloor(-0.25).Above(0.25), 0.5);
  EXPECT_EQ(WalkFloor(-kInfinity).Above(0.25), kInfinity);
  EXPECT_THROW(WalkFloor{StandingAt(0.2, 0)}, std::logic_error);
  WalkPlan climbs = PlanOf(Fig5().sequence);
  climbs.half_steps.back().X_WS.height = 0.15;
  EXPECT_THROW(WalkFloor{climbs}, std::logic_error);
}

// The force that the floor gives, seen from where its points are.
TEST(RobotMomentum, ItsZmpIsAPointOfTheFloor) {
  RobotMomentum momentum;
  momentum.floor = {.force = {3, -5, 100}, .moment = {20, 30, 7}};
  for (const double height : {0.0, 0.2}) {
    const Eigen::Vector2d zmp = momentum.Zmp(height);
    const Eigen::Vector3d moment = momentum.floor.About({zmp.x(), zmp.y(), height});
    EXPECT_LT(moment.head<2>().norm(), 1e-12) << height;
  }
}

// Forces are linear in inertias, those that no rigid body has included: a public URDF states some.
TEST(RobotMomentum, IsLinearInInertias) {
  const SuperposedWalk walk(Fig5().sequence, PlannedMotion(Fig5().sequence));
  const DescribedWalk described(Fig5().robot, PlanOf(Fig5().sequence), RowsOf(walk));
  const auto floor_with = [&](const Eigen::Vector3d& moments) {
    RobotModel robot = Fig5().robot;
    robot.masses.links[0][2].inertia = moments.asDiagonal();
    const auto momentum = RobotMomentum::Of(robot, described.At(0.9), described.NearAngles(0.9));
    EXPECT_TRUE(momentum);
    return momentum->floor.moment;
  };
  const Eigen::Vector3d thin(0.4, 0.5, 0.6), wrong(2.0, 0.3, 0.2);
  const Eigen::Vector3d mean = floor_with(0.5 * (thin + wrong));
  EXPECT_LT((0.5 * (floor_with(thin) + floor_with(wrong)) - mean).norm(), 1e-6);
  EXPECT_GT((floor_with(thin) - mean).norm(), 1e-4);
}

TEST(CheckFloor, SeesABodyThatIsLowestBetweenTwoRows) {
  RobotModel robot = WithoutBodies();
  std::vector<PlayedRow> rows = TwoRows();
  for (PlayedRow& row : rows) row.waist.z() = 1;
  const Placement at = PlaceRobot(robot, rows[0]);
  const RobotBody dot = Dot("dot", 0, {0, 0, 0});
  const Eigen::Vector3d hip = robot.legs[0].hip_B;
  robot.bodies.push_back(
      Dot("dot", 0, at.OfBody_B(dot).inverse() * Eigen::Vector3d(hip.x(), hip.y(), -0.6)));
  rows[0].q[0][2] = -0.1;
  rows[1].q[0][2] = 0.1;
  const PlayedMotion motion(robot, rows);
  const double ends = LowestPoint(robot.bodies[0], motion.PlaceRow(rows[0]));
  const double middle = LowestPoint(robot.bodies[0], motion.Place(0.005));
  ASSERT_LT(middle, ends - 1e-3);
  for (const double demanded : {0.5 * (middle + ends), middle - 0.1}) {
    CertificateText certificate;
    certificate.demanded.fill(demanded);
    Findings findings;
    CheckFloor(motion, WalkFloor(0), certificate, 0, &findings);
    EXPECT_EQ(findings.disagreements() > 0, demanded > middle);
  }
}

// A stretched leg swings through the vertical: its foot is lowest in between.
TEST(PlayedMotion, NoBodyIsLowerBetweenTwoRowsThanItsSagSays) {
  const RobotModel& robot = Fig5().robot;
  const SuperposedWalk walk(Fig5().sequence, PlannedMotion(Fig5().sequence));
  std::vector<PlayedRow> rows(2,
                              DescribedWalk(robot, PlanOf(Fig5().sequence), RowsOf(walk)).Row(0));
  rows[1].t = 0.01;
  for (PlayedRow& row : rows) {
    for (Vector6d& q : row.q) q.setZero();
  }
  for (const size_t side : {0u, 1u}) {
    for (const int joint : {1, 2}) {
      rows[0].q[side][joint] = -0.2;
      rows[1].q[side][joint] = 0.2;
    }
  }
  const PlayedMotion motion(robot, rows);
  double lowered = 0;
  for (const RobotBody& body : robot.bodies) {
    const double ends = std::min(LowestPoint(body, motion.PlaceRow(rows[0])),
                                 LowestPoint(body, motion.PlaceRow(rows[1])));
    for (int k = 1; k < 20; ++k) {
      const double height = LowestPoint(body, motion.Place(0.01 * k / 20));
      EXPECT_GE(height, ends - motion.Sag(body, 0)) << body.name;
      lowered = std::max(lowered, ends - height);
    }
  }
  EXPECT_GT(lowered, 0.01);
}

TEST(FloorDistances, OfASoleFromAnAreaByHand) {
  const RobotModel& robot = Fig5().robot;
  const Eigen::Vector2d high = robot.sole_outline.rowwise().maxCoeff();
  const Eigen::Vector2d low = robot.sole_outline.rowwise().minCoeff();
  const auto from = [&](const std::vector<Eigen::Vector2d>& corners) {
    Eigen::Matrix2Xd area(2, static_cast<Eigen::Index>(corners.size()));
    for (size_t i = 0; i < corners.size(); ++i) area.col(static_cast<Eigen::Index>(i)) = corners[i];
    return FromArea(robot, Pose2{}, area);
  };
  // A corner towards an edge of the sole, then an edge towards a corner of it.
  const double x = high.x() + 0.1, y = 0.5 * (low.y() + high.y());
  EXPECT_NEAR(from({{x, y}, {x + 1, y - 0.01}, {x + 1, y + 0.01}}), 0.1, 1e-9);
  EXPECT_NEAR(from({{x, -5}, {x + 1, -5}, {x + 1, 5}, {x, 5}}), 0.1, 1e-9);
  // Around the sole, within it, through it without a corner in it.
  EXPECT_EQ(from({{-5, -5}, {5, -5}, {5, 5}, {-5, 5}}), -1);
  EXPECT_EQ(from({{0, y}, {0.01, y}, {0, y + 0.01}}), -1);
  EXPECT_EQ(from({{-5, y}, {5, y}, {0, 50}}), -1);
}

TEST(FloorDistances, LowestPointOfPrimitivesIsTheClosedForm) {
  const Placement at{Eigen::Isometry3d(Eigen::Translation3d(0, 0, 7)), {}};
  RobotBody body = Fig5().robot.bodies.front();
  body.leg = -1;
  body.shape = MakeSphere(0.5);
  EXPECT_NEAR(LowestPoint(body, at), 6.5, 1e-12);
  body.shape = MakeCylinder(3, 8);
  EXPECT_NEAR(LowestPoint(body, at), 3, 1e-12);
  Placement lying = at;
  lying.X_WB.rotate(Eigen::AngleAxisd(std::acos(-1) / 2, Eigen::Vector3d::UnitX()));
  EXPECT_NEAR(LowestPoint(body, lying), 4, 1e-12);
}

TEST(FloorDistances, OnlyTheLastLinkOfALegIsAFoot) {
  RobotBody body = Fig5().robot.bodies.front();
  for (const int leg : {-1, 0, 1}) {
    for (int link = 0; link < 6; ++link) {
      body.leg = leg;
      body.link = link;
      EXPECT_EQ(verify::IsOnFoot(body), leg >= 0 && link == 5);
    }
  }
}

// A config that only the program can read that registered its names is read without them, and they
// are told; what is a mistake anywhere stays one.
TEST(OwnNames, AreTakenOutOfTheConfigAndTold) {
  const std::string path = ShippedConfig("fig5_box");
  const std::string shipped = ReadBytes(path);
  const std::string text = shipped.substr(0, shipped.find("\nsmoothing:")) + R"(
planner: {name: mine/grid}
smoothing:
  methods: [dichotomy, mine/scale]
  margins: {own: 0.25, zmp_m: 0.012}
  optimizer: {weights: {com_jerk: 0.5, mine: 3}}
)";
  EXPECT_THROW(ParseConfig(path, text, {}), InputError);
  const OwnNames own = FindOwnNames(path, text);
  EXPECT_THAT(own.told, testing::UnorderedElementsAre("the method mine/scale",
                                                      "the planner mine/grid", "the weight mine"));
  EXPECT_EQ(own.methods, (std::vector<std::string>{"dichotomy", "mine/scale"}));
  EXPECT_EQ(own.own_margin, 0.25);
  const ExperimentConfig config = ParseConfig(path, text, own.overrides);
  EXPECT_EQ(config.smoothing.methods, std::vector<std::string>{"dichotomy"});
  EXPECT_EQ(config.smoothing.limits.demanded_of(MarginFamily::kZmp), 0.012);
  EXPECT_EQ(config.smoothing.options.Get(OptimizerGroup()).options.program.weights.com_jerk, 0.5);

  EXPECT_TRUE(FindOwnNames(path, shipped).overrides.empty());
  EXPECT_TRUE(FindOwnNames(path, "smoothing: [").told.empty());
  const std::string wrong = text + "speed: 3\n";
  EXPECT_THROW(ParseConfig(path, wrong, FindOwnNames(path, wrong).overrides), InputError);
}

TEST(CsvTables, AreReadInPartsAsAtOnce) {
  std::string text = "a,b\n";
  for (int i = 0; i < 10000; ++i) text += std::to_string(i) + ",\"x,\"\n";
  const CsvText whole("t.csv", text, {"a", "b"});
  int rows = 0, parts = 0;
  size_t longest = 0;
  CsvText::InParts("t.csv", text, {"a", "b"}, [&](const CsvText& part) {
    ++parts;
    longest = std::max(longest, part.size());
    for (size_t i = 0; i < part.size(); ++i, ++rows) {
      ASSERT_EQ(part.Whole(i, 0, 0), rows);
      ASSERT_EQ(part.Cell(i, 1), whole.Cell(static_cast<size_t>(rows), 1));
    }
  });
  EXPECT_EQ(rows, 10000);
  EXPECT_GT(parts, 1);
  EXPECT_LT(longest, 5000);
  // Complaints count lines of the file.
  text.replace(text.find("\n9000,") + 1, 4, "nine");
  try {
    CsvText::InParts("t.csv", text, {"a", "b"}, [](const CsvText& part) {
      for (size_t i = 0; i < part.size(); ++i) (void)part.Number(i, 0);
    });
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("t.csv:9002: a: "));
  }
}

}  // namespace
}  // namespace halfstep::verify
