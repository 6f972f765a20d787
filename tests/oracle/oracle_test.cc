// The oracle against the readmes' own conditions, against the project, and a small fixed slice of
// its study.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "smoothing/walk/superposed_walk.h"
#include "tests/oracle/judge.h"
#include "tests/oracle/plain_dynamics.h"
#include "tests/oracle/project_side.h"
#include "tests/temporary_folder.h"
#include "tests/wpg/shipped_robots.h"

namespace halfstep::oracle {
namespace {

constexpr char kRobot[] = HALFSTEP_SOURCE_DIR "/wpg/robots/hrp2.yaml";

SceneKind LevelKind(unsigned k) {
  return static_cast<SceneKind>(kNumSceneKinds + static_cast<int>(k) % kNumLevelKinds);
}

TEST(RestToRestClosedFormTest, KeepsTheLipmAndItsEnds) {
  for (const double theta : {0.6, 3.0, 6.94, 20.0}) {
    for (const double shift : {0.01, 0.05, 0.5}) {
      for (const double ramp : {1.0, 0.24, 0.7}) {
        const RestToRestClosedForm pair(theta, shift, ramp);
        const auto c = [&](double sigma) { return pair.At(static_cast<Real>(sigma)); };
        // c″ = θ²(c − p) by differences of the slope, away from the knots.
        for (const double sigma : {0.11, 0.2, 0.31, 0.5 - 0.2 * shift, 0.5 + 0.3 * shift, 0.83}) {
          const Real h = 1e-7;
          const Real s = sigma;
          const double second =
              static_cast<double>((pair.At(s + h).c_rate - pair.At(s - h).c_rate) / (2 * h));
          const double expected = theta * theta * static_cast<double>(c(sigma).c - c(sigma).p);
          EXPECT_NEAR(second, expected, 1e-6 * (1 + theta * theta)) << theta << " " << shift;
        }
        EXPECT_NEAR(static_cast<double>(c(1e-12).c_rate), 0, 1e-9);
        EXPECT_NEAR(static_cast<double>(c(0.5).c), 0.5, 1e-15);
        const double knot = 0.5 - 0.5 * shift;
        EXPECT_NEAR(static_cast<double>(c(knot - 1e-9).c - c(knot + 1e-9).c), 0, 1e-7);
      }
    }
  }
}

TEST(ClosedFormWalkTest, AgreesWithTheProject) {
  const PlainRobot robot(kRobot);
  for (unsigned seed = 0; seed < 46; ++seed) {  // with rests among them; the last 16 over levels
    Draw draw(seed);
    WalkPlan plan;
    PlainScene scene;
    if (seed < 30) {
      plan = DrawPlan(robot, &draw);
    } else {
      DrawLevels(LevelKind(seed), robot, &draw, &plan, &scene);
    }
    const ClosedFormWalk oracle(plan);
    const SuperposedWalk walk(ToSequence(plan), ToParameters(plan));
    ASSERT_NEAR(oracle.duration(), walk.duration(), 1e-12);
    for (int k = 0; k <= 50; ++k) {
      const double t = walk.duration() * k / 50;
      const WalkState state = oracle.At(static_cast<Real>(t));
      const WalkJet jet = walk.At(t);
      const double far = 1e-12 + 1e-15 * jet.value.cwiseAbs().maxCoeff();
      EXPECT_LT((state.value.com - jet.value.segment<2>(kComX)).norm(), far) << seed << " " << t;
      EXPECT_LT((state.value.zmp - jet.value.segment<2>(kZmpX)).norm(), far);
      EXPECT_NEAR(state.value.waist_yaw, jet.value[kWaistYaw], far);
      EXPECT_NEAR(state.value.waist_z, jet.value[kWaistZ], far) << seed << " " << t;
      EXPECT_NEAR(state.second.waist_z, jet.second[kWaistZ], 1e-9) << seed << " " << t;
      EXPECT_LT((state.rate.com - jet.first.segment<2>(kComX)).norm(), 1e-10);
      EXPECT_LT((state.second.com - jet.second.segment<2>(kComX)).norm(), 1e-9);
      EXPECT_NEAR(state.second.waist_yaw, jet.second[kWaistYaw], 1e-9);
      for (int foot = 0; foot < 2; ++foot) {
        const int q = foot == 0 ? kLeftX : kRightX;
        const auto& feet = state.value.feet[static_cast<size_t>(foot)];
        EXPECT_LT((feet - jet.value.segment<4>(q)).norm(), far);
        const auto& rates = state.rate.feet[static_cast<size_t>(foot)];
        EXPECT_LT((rates - jet.first.segment<4>(q)).norm(), 1e-10);
        const auto& seconds = state.second.feet[static_cast<size_t>(foot)];
        EXPECT_LT((seconds - jet.second.segment<4>(q)).norm(), 1e-9) << seed << " " << t;
      }
    }
  }
}

class PlainRobotTest : public testing::TestWithParam<std::string> {
 protected:
  const std::string path_ = HALFSTEP_SOURCE_DIR "/wpg/robots/" + GetParam() + ".yaml";
};
INSTANTIATE_TEST_SUITE_P(Robots, PlainRobotTest, testing::ValuesIn(kShippedRobots),
                         [](const auto& info) { return info.param; });

TEST_P(PlainRobotTest, ReadsWhatTheProjectReads) {
  const PlainRobot plain(path_);
  const RobotModel robot = LoadRobot(path_);
  EXPECT_NEAR(plain.waist_height, robot.waist_height, 1e-12);
  EXPECT_NEAR(plain.com_x, robot.com_x_B, 1e-12);
  EXPECT_NEAR(plain.com_height, robot.com_height, 1e-12);
  EXPECT_NEAR(plain.standing_width, robot.standing_width, 1e-12);
  ASSERT_EQ(plain.bodies.size(), robot.bodies.size());
  for (int leg = 0; leg < 2; ++leg) {
    for (int j = 0; j < 6; ++j) {
      const auto& a = plain.joints[static_cast<size_t>(
          plain.legs[static_cast<size_t>(leg)].joints[static_cast<size_t>(j)])];
      const LegJoint& b = robot.legs[static_cast<size_t>(leg)].joints[static_cast<size_t>(j)];
      EXPECT_EQ(a.name, b.name);
      EXPECT_NEAR(a.lower, b.lower, 1e-15);
      EXPECT_NEAR(a.upper, b.upper, 1e-15);
      EXPECT_EQ(a.speed, b.max_speed);
      EXPECT_EQ(a.effort, b.max_torque);
      EXPECT_EQ(a.acceleration, b.max_acceleration);
    }
  }
}

TEST_P(PlainRobotTest, WatchesTheSamePairs) {
  const PlainRobot plain(path_);
  const RobotModel robot = LoadRobot(path_);
  std::set<std::set<std::string>> ours, theirs;
  for (const auto& [a, b] : plain.watched) {
    ours.insert(
        {plain.bodies[static_cast<size_t>(a)].name, plain.bodies[static_cast<size_t>(b)].name});
  }
  for (const auto& [a, b] : robot.self_pairs) {
    theirs.insert(
        {robot.bodies[static_cast<size_t>(a)].name, robot.bodies[static_cast<size_t>(b)].name});
  }
  EXPECT_EQ(ours, theirs);
}

TEST_P(PlainRobotTest, InverseKinematicsReachesTheSole) {
  const PlainRobot robot(path_);
  Draw draw(3);
  for (int k = 0; k < 200; ++k) {
    const int leg = draw.Below(2);
    Vector6 q = robot.Standing(leg);
    for (int j = 0; j < 6; ++j) q[j] += draw.Uniform(-0.2, 0.2);
    Vector6 found = robot.Standing(leg);
    ASSERT_TRUE(robot.SolveLeg(leg, robot.PlaceLeg(leg, q)[6], &found)) << k;
    EXPECT_LT((found - q).norm(), 1e-11) << k;
  }
}

// Derivative of a function of time, by differences of fourth order.
template <typename Function>
auto Rate(const Function& f, double t, double h) {
  return ((8 * (f(t + h) - f(t - h)) - (f(t + 2 * h) - f(t - 2 * h))) / (12 * h)).eval();
}

// A walk's postures from inverse kinematics alone, for differences.
struct Postures {
  const PlainRobot& robot;
  const ClosedFormWalk& walk;

  std::array<Vector6, 2> q(double t) const {
    const WalkState::Values x = walk.At(static_cast<Real>(t)).value;
    std::array<Vector6, 2> q = {robot.Standing(0), robot.Standing(1)};
    for (int leg = 0; leg < 2; ++leg) {
      const Eigen::Vector4d& foot = x.feet[static_cast<size_t>(leg)];
      const Eigen::Isometry3d X_WSole = Place(foot.head<3>(), foot[3]);
      EXPECT_TRUE(robot.SolveLeg(leg, Waist(x).inverse() * X_WSole, &q[static_cast<size_t>(leg)]));
    }
    return q;
  }
  std::vector<Eigen::Isometry3d> links(double t) const {
    const WalkState::Values x = walk.At(static_cast<Real>(t)).value;
    std::vector<Eigen::Isometry3d> X = robot.PlaceLinks(q(t));
    for (Eigen::Isometry3d& placed : X) placed = Waist(x) * placed;
    return X;
  }
  static Eigen::Isometry3d Place(const Eigen::Vector3d& p, double yaw) {
    return Eigen::Translation3d(p) * Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ());
  }
  Eigen::Isometry3d Waist(const WalkState::Values& x) const {
    const double c = std::cos(x.waist_yaw), s = std::sin(x.waist_yaw);
    return Place(
        {x.com.x() - c * robot.com_x, x.com.y() - s * robot.com_x, robot.waist_height + x.waist_z},
        x.waist_yaw);
  }
  // Momentum, angular momentum about W's origin, energy.
  Eigen::Matrix<double, 7, 1> Momenta(double t) const {
    Eigen::Matrix<double, 7, 1> sum = Eigen::Matrix<double, 7, 1>::Zero();
    const double h = 1e-3;
    const std::vector<Eigen::Isometry3d> X = links(t), a = links(t - 2 * h), b = links(t - h),
                                         c = links(t + h), d = links(t + 2 * h);
    for (size_t i = 0; i < X.size(); ++i) {
      const PlainRobot::Link& link = robot.links[i];
      const Eigen::Matrix4d rate =
          (8 * (c[i].matrix() - b[i].matrix()) - (d[i].matrix() - a[i].matrix())) / (12 * h);
      const Eigen::Vector3d r = X[i] * link.com;
      const Eigen::Vector3d v = (rate * link.com.homogeneous()).head<3>();
      const Eigen::Matrix3d turn = rate.topLeftCorner<3, 3>() * X[i].linear().transpose();
      const Eigen::Vector3d w(turn(2, 1), turn(0, 2), turn(1, 0));
      const Eigen::Vector3d spin = X[i].linear() * link.inertia * X[i].linear().transpose() * w;
      sum.head<3>() += link.mass * v;
      sum.segment<3>(3) += link.mass * r.cross(v) + spin;
      sum[6] += 0.5 * link.mass * v.squaredNorm() + 0.5 * w.dot(spin) + link.mass * 9.81 * r.z();
    }
    return sum;
  }
};

TEST_P(PlainRobotTest, DynamicsAreThoseOfDifferencesOfMomentumAndEnergy) {
  const PlainRobot robot(path_);
  Draw draw(11);
  WalkPlan plan = DrawPlan(robot, &draw);
  // From level to level, by a little.
  plan.crouch = 0.04 * robot.size();
  plan.start[0].z = 0.02 * robot.size();
  for (size_t j = 0; j < plan.steps.size(); ++j) {
    plan.steps[j].landing.z = (j % 2 == 0 ? -0.01 : 0.03) * robot.size();
    plan.steps[j].via_height += 0.04 * robot.size();
  }
  const ClosedFormWalk walk(plan);
  const Postures postures{robot, walk};
  for (const Stretch& stretch : walk.stretches()) {
    if (stretch.end - stretch.begin < 0.05) continue;
    const double t = 0.5 * (stretch.begin + stretch.end);
    const std::array<Vector6, 2> q = postures.q(t);
    std::array<Vector6, 2> speed;
    for (size_t leg = 0; leg < 2; ++leg) {
      speed[leg] = Rate([&](double s) { return postures.q(s)[leg]; }, t, 1e-3);
    }
    const WalkState state = walk.At(static_cast<Real>(t));
    const PlainDynamics found(robot, state, q, speed);
    double power = 0;
    for (size_t leg = 0; leg < 2; ++leg) {
      const Vector6 second = Rate(
          [&](double s) {
            return Vector6(Rate([&](double r) { return postures.q(r)[leg]; }, s, 1e-3));
          },
          t, 1e-3);
      EXPECT_LT((found.acceleration[leg] - second).norm(), 1e-5 * (1 + second.norm())) << t;
    }
    const Eigen::Matrix<double, 7, 1> rate =
        Rate([&](double s) { return postures.Momenta(s); }, t, 1e-3);
    const Eigen::Vector3d weight(0, 0, 9.81 * robot.mass);
    const double may_differ = 1e-5 * weight.z();
    EXPECT_LT((rate.head<3>() + weight - found.force).norm(), may_differ);
    // With the floor's wrench about the ZMP, moved to W's origin.
    const Eigen::Vector3d zmp = found.below_com + found.zmp;
    Eigen::Vector3d com(0, 0, 0);
    const auto X = postures.links(t);
    for (size_t i = 0; i < X.size(); ++i) com += robot.links[i].mass * (X[i] * robot.links[i].com);
    const Eigen::Vector3d about =
        zmp.cross(found.force) + found.yaw_moment * Eigen::Vector3d::UnitZ();
    EXPECT_LT((rate.segment<3>(3) + (com / robot.mass).cross(weight) - about).norm(),
              may_differ * 10);
    // Soles that stand do no work, so all the power is that of the joints, however they share.
    const size_t standing = stretch.in_air == 0 ? 1 : 0;
    for (size_t leg = 0; leg < 2; ++leg) {
      const bool carries = leg == standing;
      const Eigen::Vector3d force = carries ? found.force : Eigen::Vector3d(0, 0, 0);
      const Eigen::Vector3d moment(0, 0, carries ? found.yaw_moment : 0.0);
      for (size_t j = 0; j < 6; ++j) {
        power += found.Torque(leg, j, force, moment) * speed[leg][static_cast<Eigen::Index>(j)];
      }
    }
    EXPECT_NEAR(power, rate[6], may_differ) << t;
  }
}

TEST(MinNormPointTest, BracketsTheDistanceOfBoxesAndNeedles) {
  Draw draw(5);
  for (int k = 0; k < 3000; ++k) {
    ConvexSet a, b;
    const double scale = draw.Logarithmic(1e-4, 1e2);
    for (int n = 1 + draw.Below(12); n > 0; --n) a.points.push_back(draw.Vector(-0.2, 0.2));
    for (int n = 1 + draw.Below(4); n > 0; --n) {
      b.points.push_back(Eigen::Vector3d(draw.Uniform(-0.1, 0.6), 0, 0) +
                         scale * draw.Vector(-1, 1));
    }
    if (draw.Chance(0.3)) b.disc = draw.Logarithmic(1e-4, 0.1);
    const Bracket found = DistanceOf(a, b);
    EXPECT_LE(found.lower, found.upper + 1e-14);
    EXPECT_LT(found.upper - found.lower, b.disc > 0 ? 1e-7 : 1e-11) << k << " " << found.upper;
  }
}

TEST(MinNormPointTest, KnowsTheDistanceFromATiltedDisc) {
  Draw draw(9);
  for (int k = 0; k < 300; ++k) {
    ConvexSet disc, point;
    disc.disc_axis = draw.Vector(-1, 1).normalized();
    disc.points = {draw.Vector(-1, 1)};
    disc.disc = draw.Uniform(0.01, 0.03);
    const double apart = draw.Uniform(0.002, 0.05), beside = draw.Uniform(0, 0.9) * disc.disc;
    point.points = {disc.points[0] + apart * disc.disc_axis +
                    beside * disc.disc_axis.unitOrthogonal()};
    const Bracket found = DistanceOf(point, disc);
    EXPECT_NEAR(found.lower, apart, 1e-12) << k;
    EXPECT_NEAR(found.upper, apart, 1e-12) << k;
  }
}

// Two soles at drawn places and heights, a force, and where its line passes z = 0.
struct DrawnContact {
  std::array<Eigen::Vector4d, 2> feet;
  Eigen::Vector2d size{0.2, 0.12};
  Eigen::Vector3d force, zmp;

  explicit DrawnContact(Draw* draw) {
    for (size_t i = 0; i < 2; ++i) {
      const double y = (i == 0 ? 1 : -1) * draw->Uniform(0, 0.2);
      feet[i] = {draw->Uniform(-0.2, 0.2), y, draw->Uniform(-0.3, 0.3), draw->Uniform(-1, 1)};
    }
    force = {draw->Uniform(-200, 200), draw->Uniform(-200, 200), draw->Uniform(100, 700)};
    zmp = {draw->Uniform(-0.3, 0.3), draw->Uniform(-0.3, 0.3), 0};
  }
  // Corners seen from where the line passes the plane of their sole.
  std::array<Eigen::Vector2d, 4> Seen(size_t i) const {
    Eigen::Vector4d seen = feet[i];
    seen.head<2>() -= (zmp + feet[i][2] / force.z() * force).head<2>();
    return SoleCorners(seen, size);
  }
};

// Pushing forces along f at corners of both soles that have the moment of f on its line but for its
// upright part: three corners are enough, if any are.
TEST(PlainSolesTest, ForcesAtCornersExistWhereTheLineIsInsideTheShadows) {
  Draw draw(21);
  int inside = 0;
  for (int k = 0; k < 400; ++k) {
    const DrawnContact contact(&draw);
    std::vector<Eigen::Vector2d> seen;
    std::vector<Eigen::Vector3d> turns;  // moment of all of f at a corner about a point of its line
    for (size_t i = 0; i < 2; ++i) {
      for (const Eigen::Vector2d& c : contact.Seen(i)) seen.push_back(c);
      for (const Eigen::Vector2d& c : SoleCorners(contact.feet[i], contact.size)) {
        const Eigen::Vector3d corner(c.x(), c.y(), contact.feet[i][2]);
        turns.push_back((corner - contact.zmp).cross(contact.force));
      }
    }
    bool exist = false;
    for (size_t a = 0; a < 8; ++a) {
      for (size_t b = 0; b < a; ++b) {
        for (size_t c = 0; c < b; ++c) {
          Eigen::Matrix3d A;
          A << turns[a].head<2>(), turns[b].head<2>(), turns[c].head<2>(), 1, 1, 1;
          const Eigen::Vector3d w = A.fullPivLu().solve(Eigen::Vector3d(0, 0, 1));
          exist = exist || (w.minCoeff() >= 0 && (A * w - Eigen::Vector3d(0, 0, 1)).norm() < 1e-9);
        }
      }
    }
    EXPECT_EQ(exist, InsideHull(seen, {0, 0}) > 0) << k;
    inside += exist;
  }
  EXPECT_GT(inside, 50);
  EXPECT_LT(inside, 350);
}

// The best section against sections that are hulls of all pairs of corners, at steps of λ.
TEST(PlainSolesTest, TheSectionHoldsTwoPointsAndADisc) {
  Draw draw(22);
  int held = 0;
  for (int k = 0; k < 100; ++k) {
    const DrawnContact contact(&draw);
    const auto left = contact.Seen(0), right = contact.Seen(1);
    double longest = -1;
    for (int step = 0; step <= 50; ++step) {
      std::vector<Eigen::Vector2d> section;
      for (const Eigen::Vector2d& a : left) {
        for (const Eigen::Vector2d& b : right) {
          section.push_back(a + step / 50.0 * (b - a));
        }
      }
      const std::vector<HullSide> sides = HullSides(section);
      for (const HullSide& along : sides) {
        double lever = 10;
        for (const HullSide& side : sides) {
          const double apart = -side.offset;
          lever =
              std::min({lever, apart / std::max(std::abs(side.inwards.dot(along.along)), 0.25)});
        }
        longest = std::max(longest, lever);
      }
    }
    const double found = LongestSectionLever(left, right);
    EXPECT_LT(longest, std::max(found, 0.0) + 1e-12) << k;
    if (found > 0.01) {
      EXPECT_GT(longest, 0.9 * found - 0.002) << k;
    }
    held += found > 0;
  }
  EXPECT_GT(held, 15);
}

TEST(PlainGroundTest, KnowsWhereALevelEnds) {
  const auto square = [](double x, double y, double side) {
    return Polygon{{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
  };
  // Two squares of one level side by side, a higher one beyond, a bridge above all.
  std::vector<PlainSurface> surfaces = {
      {.name = "a", .polygon = square(0, 0, 1), .height = 0.45},
      {.name = "b", .polygon = square(1, 0, 1), .height = 3 * 0.15},
      {.name = "c", .polygon = square(2, 0, 1), .height = 0.6},
      {.name = "d", .polygon = square(0, 0, 1), .height = 2, .thickness = 0.1}};
  const PlainGround ground(true, surfaces);
  EXPECT_NEAR(ground.Inside(square(0.9, 0.4, 0.2), 0.45), 0.4, 1e-12);
  EXPECT_NEAR(ground.Inside(square(1.7, 0.4, 0.2), 0.45), 0.1, 1e-12);
  EXPECT_LT(ground.Inside(square(1.9, 0.4, 0.2), 0.45), 0);
  EXPECT_EQ(ground.Inside(square(0.9, 0.4, 0.2), 0.46), -kNever);
  EXPECT_NEAR(ground.Inside(square(-0.3, 0.4, 0.2), 0), 0.1, 1e-12);
  EXPECT_EQ(ground.HeightUnder({1.5, 0.5}), 0.45);
  EXPECT_EQ(ground.HeightUnder({0.5, 0.5}), 2);
  EXPECT_EQ(ground.HeightUnder({-5, 0.5}), 0);
  PlainSurface flight{.name = "flight", .count = 3, .rise = 0.15, .run = 0.3, .width = 1};
  flight.yaw_deg = 90;
  const PlainGround stairs(false, {flight});
  EXPECT_EQ(stairs.HeightUnder({0.1, 0.7}), 0.45);
  EXPECT_EQ(stairs.HeightUnder({0.1, -0.1}), std::nullopt);
  EXPECT_NEAR(stairs.Inside(square(-0.1, 0.35, 0.2), 0.3), 0.05, 1e-12);
}

TEST(TallyTest, ComesBackFromItsLine) {
  Tally tally;
  tally.walks = 1;
  tally.certified = 7;
  tally.instants = 123456;
  tally.families["floor"].pushed = 3;
  tally.families["floor"].disagreement = 1.0 / 3;
  EXPECT_EQ(ToLine(ToTally(ToLine(tally))), ToLine(tally));
}

TEST(PlainSceneTest, KnowsInsideFromOutside) {
  Draw draw(7);
  PlainScene scene;
  for (const SceneKind kind : {SceneKind::kClosedMeshes, SceneKind::kNested}) {
    const PlainRobot robot(kRobot);
    const WalkPlan plan = DrawPlan(robot, &draw);
    for (const PlainObstacle& o : DrawNastyScene(kind, plan, robot.size(), &draw).obstacles) {
      scene.obstacles.push_back(o);
    }
  }
  const PlacedScene placed(scene, {0, 0, 0});
  for (size_t o = 0; o < placed.size(); ++o) {
    const auto far = placed.Around(o, {50, 60, 70});
    EXPECT_NEAR(far.component, 0, 1e-12);
    EXPECT_FALSE(far.maybe());
  }
}

// Three robots, five kinds of scenes each; the whole study: tests/oracle/README.md.
class OracleTest : public testing::TestWithParam<std::string> {
 protected:
  std::vector<SceneKind> Kinds() const {
    std::vector<SceneKind> kinds;
    const auto robot = std::find(kShippedRobots.begin(), kShippedRobots.end(), GetParam());
    for (auto k = robot - kShippedRobots.begin(); k < kNumSceneKinds; k += 3) {
      kinds.push_back(static_cast<SceneKind>(k));
    }
    return kinds;
  }
  // Of a walk that is feasible as it is drawn, or nearly: of stairs, platforms, stones, blocks.
  unsigned LevelSeed(SceneKind kind) const {
    const std::map<std::string, std::array<unsigned, kNumLevelKinds>> seeds = {
        {"hrp2", {0, 15, 18, 9}}, {"bison", {25, 4, 19, 34}}, {"wren", {26, 5, 20, 83}}};
    return 77000000u + seeds.at(GetParam()).at(static_cast<size_t>(kind) - kNumSceneKinds);
  }
  const TemporaryFolder folder_;
  const std::string path_ = WriteJudgedRobot(GetParam(), folder_.path().string());
};
INSTANTIATE_TEST_SUITE_P(Robots, OracleTest, testing::ValuesIn(kShippedRobots),
                         [](const auto& info) { return info.param; });

TEST_P(OracleTest, NoAnswerIsFalseAndFalsifiedOnesAreFound) {
  const Judge judge(path_);
  std::vector<std::string> falsehoods;
  Tally all;
  for (const SceneKind kind : Kinds()) {
    all.Add(judge.JudgeOne(kind, 77000003u + static_cast<unsigned>(kind), folder_.path().string(),
                           &falsehoods));
  }
  EXPECT_THAT(falsehoods, testing::IsEmpty());
  EXPECT_GT(all.judged, 10);
  EXPECT_GT(all.violated, 10);
  for (const std::string name : {"zmp_robot", "torque", "friction", "joint_acceleration",
                                 "double_support", "landing_speed"}) {
    EXPECT_GT(all.families[name].pushed, 1) << name;
  }
  // No family is left out; obstacles and areas may all have stood in the way.
  // The floor is flat, where this family is absent.
  const std::set<MarginFamily> may_lack = {MarginFamily::kOwn, MarginFamily::kClearance,
                                           MarginFamily::kNoStep, MarginFamily::kFoothold};
  for (const MarginFamily family : AllMarginFamilies()) {
    if (may_lack.contains(family)) continue;
    EXPECT_GT(all.families[std::string(Name(family))].statements, 0) << Name(family);
  }
  for (const auto& [name, family] : all.families) {
    EXPECT_EQ(family.found, family.falsified) << name;
    EXPECT_LT(family.disagreement, name == "clearance" ? 1e-6 : 1e-8) << name;
  }
  // Of bodies a tube eight times as wide is often within the true limit: levers are added up.
  FamilyTally tubes;
  for (const auto& [name, family] : all.tubes) {
    tubes.Add(family);
    if (name == "joint" || name == "joint_speed" || name == "zmp_robot") {
      EXPECT_EQ(family.found, family.falsified) << name;
    }
  }
  EXPECT_GT(tubes.pushed, 3);
  EXPECT_GT(tubes.found, 0);
}

// Over levels, and what an oracle that is a little wrong about them finds.
TEST_P(OracleTest, NoAnswerOverLevelsIsFalse) {
  const Judge judge(path_);
  std::vector<std::string> falsehoods;
  Tally all;
  constexpr std::array kFamilies = {MarginFamily::kZmpRobot, MarginFamily::kFloor,
                                    MarginFamily::kFoothold, MarginFamily::kFriction,
                                    MarginFamily::kTorque};
  // One or two for each robot.
  const auto robot = std::find(kShippedRobots.begin(), kShippedRobots.end(), GetParam());
  for (auto k = static_cast<size_t>(robot - kShippedRobots.begin()); k < kFamilies.size(); k += 3) {
    const MarginFamily family = kFamilies[k];
    const auto kind = LevelKind(static_cast<unsigned>(family));
    all.Add(judge.JudgeFamily(family, kind, LevelSeed(kind), folder_.path().string(), &falsehoods));
  }
  EXPECT_THAT(falsehoods, testing::IsEmpty());
  EXPECT_GT(all.judged, 0);
  for (const auto& [name, family] : all.families) {
    EXPECT_EQ(family.found, family.falsified) << name;
    EXPECT_LT(family.disagreement, 1e-8) << name;
  }
}

TEST_P(OracleTest, AnOracleThatIsWrongAboutLevelsFindsFalsehoods) {
  const std::vector<std::pair<OracleMistake, MarginFamily>> mistakes = {
      {OracleMistake::kRisersNearer, MarginFamily::kFloor},
      {OracleMistake::kEdgesNearer, MarginFamily::kFoothold},
      {OracleMistake::kTreadsHigher, MarginFamily::kFoothold},
      {OracleMistake::kTreadsLower, MarginFamily::kFoothold},
      {OracleMistake::kWaistLater, MarginFamily::kReach},
      {OracleMistake::kFlatShadows, MarginFamily::kZmpRobot},
      {OracleMistake::kFlatFriction, MarginFamily::kFriction},
      {OracleMistake::kFlatLoads, MarginFamily::kTorque}};
  ASSERT_EQ(mistakes.size() + 1, kNumOracleMistakes);
  // A few for each robot.
  int found = 0;
  const auto robot = std::find(kShippedRobots.begin(), kShippedRobots.end(), GetParam());
  for (auto k = static_cast<size_t>(robot - kShippedRobots.begin()); k < mistakes.size(); k += 3) {
    const auto& [mistake, family] = mistakes[k];
    const Judge judge(path_, mistake);
    // An answer that it calls false, or a value that is another, in a walk of one of the kinds: the
    // waist keeps its height where the first step goes up.
    std::vector<std::string> falsehoods;
    bool differs = false;
    for (unsigned of = 0; of < kNumLevelKinds && falsehoods.empty() && !differs; ++of) {
      const SceneKind kind = LevelKind(of);
      Tally tally =
          judge.JudgeFamily(family, kind, LevelSeed(kind), folder_.path().string(), &falsehoods);
      differs = tally.families[std::string(Name(family))].disagreement > 1e-4;
    }
    EXPECT_TRUE(differs || !falsehoods.empty()) << k;
    found += !falsehoods.empty();
  }
  EXPECT_GT(found, 0);
}

// An oracle that takes one foot to be heavier by a fiftieth calls true answers false.
TEST_P(OracleTest, AnOracleOfAnotherRobotFindsFalsehoods) {
  const TemporaryFolder other;
  const std::string path = WriteJudgedRobot(GetParam(), other.path().string());
  const PlainRobot plain(path);
  const std::string foot = plain.links[static_cast<size_t>(plain.legs[0].foot_link)].name;
  const std::string urdf = (other / (GetParam() + ".urdf")).string();
  std::string text = ReadText(urdf);
  const std::string mass = "<mass value=\"";
  const size_t begin = text.find(mass, text.find("<link name=\"" + foot)) + mass.size();
  const size_t end = text.find('"', begin);
  text.replace(begin, end - begin,
               std::to_string(1.02 * std::stod(text.substr(begin, end - begin))));
  std::filesystem::remove(urdf);  // a link
  WriteText(urdf, text);
  const Judge judge(path_, path, 1e-9);
  std::vector<std::string> falsehoods;
  judge.JudgeOne(SceneKind::kMoving, 77000001u, folder_.path().string(), &falsehoods);
  EXPECT_THAT(falsehoods, testing::Contains(testing::AnyOf(testing::HasSubstr("zmp_robot"),
                                                           testing::HasSubstr("torque"),
                                                           testing::HasSubstr("friction"))));
}

}  // namespace
}  // namespace halfstep::oracle
