// What the parts of verify claim by themselves: the walk that half_steps.csv describes, distances,
// the motion between two rows, the floor.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "experiments/config/experiment.h"
#include "experiments/tables/parameter_tables.h"
#include "experiments/verify/check_clearance.h"
#include "experiments/verify/check_overlaps.h"
#include "experiments/verify/check_rows.h"
#include "experiments/verify/csv_text.h"
#include "experiments/verify/described_walk.h"
#include "experiments/verify/distances.h"
#include "experiments/verify/floor_distances.h"
#include "experiments/verify/own_names.h"
#include "experiments/verify/played_motion.h"
#include "experiments/verify/robot_momentum.h"
#include "smoothing/methods/solver_method_options.h"
#include "smoothing/walk/superposed_walk.h"
#include "tests/experiments/child_process.h"
#include "tests/verify/plan_of.h"
#include "wpg/files/input_error.h"

namespace halfstep::verify {
namespace {

using testing::HasSubstr;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

const Experiment& Fig5() {
  static const Experiment experiment = Prepare(LoadConfig(ShippedConfig("fig5_box"), {}));
  return experiment;
}
const Experiment& Fig4() {
  static const Experiment experiment = Prepare(LoadConfig(ShippedConfig("fig4_raw_sequence"), {}));
  return experiment;
}

// What half_steps.csv and overlaps.csv would say of a walk.
std::vector<HalfStepRow> RowsOf(const SuperposedWalk& walk) {
  std::vector<HalfStepRow> rows;
  for (int i = 0; i < walk.num_half_steps(); ++i) {
    const auto n = static_cast<size_t>(i);
    rows.push_back(
        {i % 2 == 0 ? "up" : "down", std::string(Name(walk.half_step(i).support)), walk.start_of(i),
         walk.parameters().durations[n], walk.parameters().height_scales[n / 2],
         walk.parameters().support_points[n / 2],
         FormColumns{walk.parameters().of(ParameterFamily::kViaLateral)[n / 2],
                     walk.parameters().of(ParameterFamily::kFootRamp)[n],
                     walk.parameters().of(ParameterFamily::kFootDelay)[n],
                     walk.parameters().of(ParameterFamily::kLiftShare)[n],
                     walk.parameters().of(ParameterFamily::kViaAlong)[n / 2],
                     walk.parameters().zmp_shifts[n],
                     walk.parameters().of(ParameterFamily::kZmpBumpRamp)[n],
                     {walk.parameters().footstep_xs[n / 2], walk.parameters().footstep_ys[n / 2],
                      walk.parameters().footstep_yaws[n / 2]}}});
  }
  return rows;
}
std::vector<OverlapRow> OverlapsOf(const HomotopyParameters& at) {
  std::vector<OverlapRow> rows;
  for (size_t i = 0; i < at.overlaps.size(); ++i) {
    rows.push_back({i % 2 == 0 ? "up_down" : "down_up", at.overlaps[i], at.durations[i],
                    at.durations[i + 1], at.height_scales[i / 2], at.height_scales[(i + 1) / 2]});
  }
  return rows;
}

// Durations, heights, support points, forms and overlaps are drawn; `fullness` of the natural
// bounds at most.
HomotopyParameters Drawn(const HalfStepSequence& sequence, double fullness, std::mt19937* random) {
  std::uniform_real_distribution<double> unit(0, 1);
  HomotopyParameters at = PlannedMotion(sequence);
  for (double& duration : at.durations) duration *= 0.8 + 0.4 * unit(*random);
  for (double& scale : at.height_scales) scale = 0.5 + unit(*random);
  for (double& offset : at.support_points) offset = 0.05 * unit(*random);
  for (double& via : at.of(ParameterFamily::kViaLateral)) via += 0.02 * unit(*random);
  for (double& ramp : at.of(ParameterFamily::kFootRamp)) ramp = 0.5 - 0.2 * unit(*random);
  for (double& delay : at.of(ParameterFamily::kFootDelay)) delay = 0.05 + 0.1 * unit(*random);
  for (double& share : at.of(ParameterFamily::kLiftShare)) share = 1 - 0.3 * unit(*random);
  for (double& ahead : at.of(ParameterFamily::kViaAlong)) ahead = 0.05 * unit(*random);
  for (double& shift : at.zmp_shifts) shift = 0.03 + 0.1 * unit(*random);
  for (double& ramp : at.of(ParameterFamily::kZmpBumpRamp)) ramp = 0.2 + 0.8 * unit(*random);
  for (double& x : at.footstep_xs) x = 0.02 * unit(*random);
  for (double& y : at.footstep_ys) y = 0.01 * unit(*random);
  for (double& yaw : at.footstep_yaws) yaw = 0.1 * unit(*random);
  for (size_t i = 0; i < at.overlaps.size(); ++i) {
    at.overlaps[i] = fullness * unit(*random) * NaturalOverlapBound(at, static_cast<int>(i));
  }
  return at;
}

// verify has its own list of the columns of forms.
TEST(VerifyFormColumns, AreThoseOfTheFamilies) {
  size_t k = 0;
  const auto& columns = kFormColumns;
  for (const ParameterFamily family : FamiliesOfHalfSteps(HalfStepsExtent::kForms)) {
    const ParameterFamilyTraits& traits = Traits(family);
    if (!traits.of_form) continue;
    ASSERT_LT(k, columns.size()) << traits.name;
    const FormColumn& one = columns[k++];
    EXPECT_EQ(one.name, traits.name);
    EXPECT_EQ(one.key, traits.key);
    EXPECT_EQ(one.column, traits.column);
    EXPECT_EQ(one.of_step(), traits.of == ParameterOf::kStep);
    EXPECT_EQ(one.least, traits.least);
    EXPECT_EQ(one.most, traits.most);
  }
  EXPECT_EQ(k, columns.size());
}

TEST(DescribedWalk, IsTheWalkThatTheRowsWereMadeOf) {
  std::mt19937 random(3);
  const HalfStepSequence& sequence = Fig4().sequence;
  for (int k = 0; k < 8; ++k) {
    const SuperposedWalk walk(sequence, Drawn(sequence, 0.9, &random));
    const DescribedWalk described(Fig4().robot, PlanOf(sequence), RowsOf(walk));
    ASSERT_NEAR(described.end(), walk.duration(), 1e-12);
    std::uniform_real_distribution<double> time(0, walk.duration());
    for (int i = 0; i < 200; ++i) {
      const double t = time(random);
      const LocalTime at = walk.Locate(t);
      const WalkInstant one = described.At(t);
      const WalkJet other = walk.At(t);
      EXPECT_LT((one.value - other.value).cwiseAbs().maxCoeff(), 1e-10);
      EXPECT_LT((one.first - other.first).cwiseAbs().maxCoeff(), 1e-9);
      EXPECT_LT((one.second - other.second).cwiseAbs().maxCoeff(), 1e-8);
      EXPECT_EQ(described.HalfStepAt(t), at.half_step + 1);
      const Support support = described.SupportAt(t);
      EXPECT_EQ(support == Support::kRight, walk.InAir(at, Side::kLeft));
      EXPECT_EQ(support == Support::kLeft, walk.InAir(at, Side::kRight));
      for (const int side : {0, 1}) {
        const bool moves = one.first.segment<2>(side == 0 ? kLeftX : kRightX).norm() > 1e-9;
        EXPECT_TRUE(!moves || described.MovesHorizontally(t, side)) << t;
        const int step = walk.StepInAir(at);
        const bool swings = step >= 0 && Index(walk.half_step(2 * step).swing()) == side;
        EXPECT_EQ(described.MovesHorizontally(t, side), swings && walk.MovesHorizontally(step, at));
      }
    }
  }
}

TEST(DescribedWalk, JointSpeedsAreThoseOfItsRows) {
  const SuperposedWalk walk(Fig5().sequence, PlannedMotion(Fig5().sequence));
  const DescribedWalk described(Fig5().robot, PlanOf(Fig5().sequence), RowsOf(walk));
  for (const double t : {0.3, 0.9, 1.7, 2.2, 3.1}) {
    const PlayedRow a = described.Row(t - 1e-4), b = described.Row(t + 1e-4);
    for (const size_t side : {0u, 1u}) {
      const Vector6d speeds = (b.q[side] - a.q[side]) / (b.t - a.t);
      EXPECT_LT((described.JointSpeeds(t)[side] - speeds).norm(), 1e-5);
    }
  }
}

TEST(DescribedWalk, JointAnglesOfALegThatDoesNotReachAreNoNumbers) {
  RobotModel robot = Fig5().robot;
  const SuperposedWalk walk(Fig5().sequence, PlannedMotion(Fig5().sequence));
  EXPECT_TRUE(DescribedWalk(robot, PlanOf(Fig5().sequence), RowsOf(walk)).Row(1).AllFinite());
  robot.waist_height += 0.5;
  const PlayedRow row = DescribedWalk(robot, PlanOf(Fig5().sequence), RowsOf(walk)).Row(1);
  for (const Vector6d& q : row.q) EXPECT_TRUE(q.array().isNaN().all());
}

// Against second differences of the acceleration; not above them by more than what the norms give
// away.
TEST(DescribedWalk, BoundOfTheCoMsFourthDerivativeHoldsAndIsNear) {
  const SuperposedWalk walk(Fig5().sequence, PlannedMotion(Fig5().sequence));
  const DescribedWalk described(Fig5().robot, PlanOf(Fig5().sequence), RowsOf(walk));
  const double h = 1e-3;
  double most = 0, bound = 0;
  for (double t = 2 * h; t < described.end() - 2 * h; t += h) {
    const auto acceleration = [&](double at) -> Eigen::Vector2d {
      return described.At(at).second.segment<2>(kComX);
    };
    const double fourth =
        (acceleration(t + h) - 2 * acceleration(t) + acceleration(t - h)).norm() / (h * h);
    const double here = described.ComFourthBound(t - h, t + h);
    EXPECT_LE(fourth, here + 1e-6) << t;
    most = std::max(most, fourth);
    bound = std::max(bound, here);
  }
  EXPECT_LT(bound, 5 * most);
}

// Overlaps as long as the homotopy allows are accepted, longer ones by a microsecond are not.
TEST(CheckOverlaps, AcceptsNothingBeyondTheNaturalBounds) {
  std::mt19937 random(5);
  const HalfStepSequence& sequence = Fig4().sequence;
  const HomotopyParameters start = Drawn(sequence, 0, &random);
  for (size_t i = 0; i < start.overlaps.size(); ++i) {
    HomotopyParameters at = start;
    at.overlaps[i] = NaturalOverlapBound(at, static_cast<int>(i));
    std::vector<HalfStepRow> half_steps = RowsOf(SuperposedWalk(sequence, at));
    std::vector<OverlapRow> overlaps = OverlapsOf(at);
    Findings right, wrong;
    EXPECT_TRUE(CheckOverlaps(half_steps, overlaps, PlanOf(sequence), &right));
    EXPECT_THAT(right.reasons(), testing::IsEmpty());
    overlaps[i].overlap += 1e-6;
    for (size_t k = i + 1; k < half_steps.size(); ++k) half_steps[k].start -= 1e-6;
    EXPECT_FALSE(CheckOverlaps(half_steps, overlaps, PlanOf(sequence), &wrong));
    EXPECT_THAT(wrong.reasons(), testing::ElementsAre(HasSubstr("natural bound")));
  }
}

// One parameter of each family, fixed at its value and as planned, and what a walk says that moved
// it.
TEST(CheckFixed, NamesEveryParameterThatMoved) {
  std::mt19937 random(6);
  const HalfStepSequence& sequence = Fig4().sequence;
  HomotopyParameters at = Drawn(sequence, 0, &random);
  at.overlaps[1] = 0.01;
  const std::vector<HalfStepRow> half_steps = RowsOf(SuperposedWalk(sequence, at));
  const std::vector<OverlapRow> overlaps = OverlapsOf(at);
  const auto reasons = [&](const std::vector<FixedConfig>& fixed) {
    Findings findings;
    CheckFixed(half_steps, overlaps, PlanOf(sequence), fixed, &findings);
    return findings.reasons();
  };
  EXPECT_THAT(reasons({{"overlap", 2, at.overlaps[1]},
                       {"duration", 3, at.durations[2]},
                       {"height_scale", 2, at.height_scales[1]},
                       {"support_point", 2, at.support_points[1]},
                       {"via_lateral", 1, at.of(ParameterFamily::kViaLateral)[0]},
                       {"foot_ramp", 2, at.of(ParameterFamily::kFootRamp)[1]},
                       {"foot_delay", 3, at.of(ParameterFamily::kFootDelay)[2]},
                       {"lift_share", 4, at.of(ParameterFamily::kLiftShare)[3]},
                       {"via_along", 2, at.of(ParameterFamily::kViaAlong)[1]},
                       {"zmp_shift", 3, at.zmp_shifts[2]},
                       {"zmp_bump_ramp", 1, at.of(ParameterFamily::kZmpBumpRamp)[0]},
                       {"footstep_x", 1, at.footstep_xs[0]},
                       {"footstep_y", 2, at.footstep_ys[1]},
                       {"footstep_yaw", 1, at.footstep_yaws[0]}}),
              testing::IsEmpty());
  EXPECT_THAT(reasons({{"overlap", 2, at.overlaps[1] + 1e-6}}),
              testing::ElementsAre(HasSubstr("overlap 2 is")));
  EXPECT_THAT(reasons({{"duration", 3, at.durations[2] + 1e-6}}),
              testing::ElementsAre(HasSubstr("duration 3 is")));
  EXPECT_THAT(reasons({{"height_scale", 2, at.height_scales[1] + 1e-6}}),
              testing::ElementsAre(HasSubstr("height_scale 2 is")));
  EXPECT_THAT(reasons({{"support_point", 2, at.support_points[1] + 1e-6}}),
              testing::ElementsAre(HasSubstr("support_point 2 is")));
  EXPECT_THAT(reasons({{"via_lateral", 1, {}},
                       {"lift_share", 4, {}},
                       {"via_along", 2, {}},
                       {"zmp_shift", 3, {}},
                       {"zmp_bump_ramp", 1, {}},
                       {"footstep_y", 1, {}}}),
              testing::ElementsAre(HasSubstr("via_lateral 1 is"), HasSubstr("lift_share 4 is"),
                                   HasSubstr("via_along 2 is"), HasSubstr("zmp_shift 3 is"),
                                   HasSubstr("zmp_bump_ramp 1 is"), HasSubstr("footstep_y 1 is")));
  const std::string planned = Formatted("fixed at %.9g", sequence.half_steps[2].half_step.duration);
  EXPECT_THAT(reasons({{"overlap", 2, {}},
                       {"duration", 3, {}},
                       {"height_scale", 2, {}},
                       {"support_point", 2, {}}}),
              testing::ElementsAre(HasSubstr("fixed at 0"), HasSubstr(planned),
                                   HasSubstr("fixed at 1"), HasSubstr("fixed at 0")));
  EXPECT_THAT(reasons({{"via_point", 1, {}}, {"overlap", 400, {}}}),
              testing::ElementsAre(HasSubstr("via_point 1 is not known"),
                                   HasSubstr("overlap 400 is not known")));
}

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
HalfStepSequence StandingAt(double left, double right) {
  return {{Foothold({0, 0.1, 0}, left), Foothold({0, -0.1, 0}, right)}, {}, {}};
}

TEST(FlatFloor, IsTheOneLevelOfAPlan) {
  const FlatFloor floor(StandingAt(0.2, 0.2));
  EXPECT_NEAR(floor.Above(0.25), 0.05, 1e-15);
  EXPECT_EQ(floor.Point({1, 2}), Eigen::Vector3d(1, 2, 0.2));
  EXPECT_EQ(floor.Sole({0, 0.1, 0}), StandingAt(0.2, 0.2).start[0]);
  EXPECT_THROW(FlatFloor{StandingAt(0.2, 0)}, std::logic_error);
  HalfStepSequence climbs = Fig5().sequence;
  climbs.half_steps.back().X_WS.height = 0.15;
  EXPECT_THROW(FlatFloor{climbs}, std::logic_error);
}

// The force that the floor gives, seen from where its points are.
TEST(RobotMomentum, ItsZmpIsAPointOfTheFloor) {
  RobotMomentum momentum;
  momentum.floor = {.force = {3, -5, 100}, .moment = {20, 30, 7}};
  for (const double height : {0.0, 0.2}) {
    const FlatFloor floor(StandingAt(height, height));
    const Eigen::Vector3d moment = momentum.floor.About(floor.Point(momentum.Zmp(floor)));
    EXPECT_LT(moment.head<2>().norm(), 1e-12) << height;
  }
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
    CheckFloor(motion, FlatFloor(StandingAt(0, 0)), {}, certificate, 0, &findings);
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

}  // namespace
}  // namespace halfstep::verify
