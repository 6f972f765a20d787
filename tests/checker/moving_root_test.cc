// Robots whose root moves: what is proved of the floor, of obstacles and of links that stand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "experiments/checker/check_trajectory.h"
#include "experiments/checker/robot_motion.h"
#include "tests/checker/found_in_check.h"
#include "tests/refusal_of.h"
#include "wpg/geometry/rotation.h"

namespace halfstep::checker {
namespace {

using testing::HasSubstr;
using Kind = TrajectoryFinding::Kind;

constexpr double kLeg = 0.5;  // of the hip above the foot's ball [m]

// A trunk, a leg of 0.5 m that turns about y and a ball of 1 cm as its foot.
JointedRobot Hopper() {
  return {
      ParseUrdf("hopper.urdf",
                "<robot name='hopper'><link name='trunk'><collision><geometry><box size='0.2 0.2 "
                "0.2'/></geometry></collision></link><link name='leg'><collision><origin xyz='0 "
                "0 -0.5'/><geometry><sphere radius='0.01'/></geometry></collision></link><joint "
                "name='hip' type='revolute'><parent link='trunk'/><child link='leg'/><axis "
                "xyz='0 1 0'/><limit lower='-2' upper='2' velocity='9' effort='9'/></joint>"
                "</robot>"),
      {}};
}

// Knots: t, hip; x, y, z; w, x, y, z of the trunk's quaternion.
Trajectory HopperTrajectory(const std::vector<std::array<double, 9>>& knots) {
  Trajectory trajectory;
  trajectory.file = "hopper.csv";
  trajectory.joints = {"hip"};
  trajectory.q.resize(1, std::ssize(knots));
  Eigen::MatrixXd poses(7, std::ssize(knots));
  for (Eigen::Index k = 0; k < poses.cols(); ++k) {
    const std::array<double, 9>& knot = knots[static_cast<size_t>(k)];
    trajectory.times.push_back(knot[0]);
    trajectory.q(0, k) = knot[1];
    for (int i = 0; i < 7; ++i) poses(i, k) = knot[static_cast<size_t>(i + 2)];
  }
  SetBase(poses, &trajectory);
  return trajectory;
}

// The frame that is stated, by another way.
Eigen::Isometry3d TrunkAt(const Trajectory& trajectory, double t) {
  Eigen::Index k = 0;
  while (t > trajectory.times[static_cast<size_t>(k + 1)]) ++k;
  const double from = trajectory.times[static_cast<size_t>(k)];
  const double u = (t - from) / (trajectory.times[static_cast<size_t>(k + 1)] - from);
  Eigen::VectorXd pose = (1 - u) * trajectory.base.col(k) + u * trajectory.base.col(k + 1);
  if (trajectory.base_v.size() > 0) {
    const double h = trajectory.times[static_cast<size_t>(k + 1)] - from;
    const auto rate = [&](Eigen::Index at) {
      const Eigen::VectorXd v = trajectory.base_v.col(at), p = trajectory.base.col(at);
      const Eigen::Quaterniond turn =
          Eigen::Quaterniond(0, v[3], v[4], v[5]) * Eigen::Quaterniond(p[3], p[4], p[5], p[6]);
      Eigen::VectorXd all(7);
      all << v.head<3>(), 0.5 * turn.w(), 0.5 * turn.vec();
      return Eigen::VectorXd(h * all);
    };
    pose = (1 + 2 * u) * (1 - u) * (1 - u) * trajectory.base.col(k) +
           u * (1 - u) * (1 - u) * rate(k) + u * u * (3 - 2 * u) * trajectory.base.col(k + 1) -
           u * u * (1 - u) * rate(k + 1);
  }
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.linear() =
      Eigen::Quaterniond(pose[3], pose[4], pose[5], pose[6]).normalized().toRotationMatrix();
  X.translation() = pose.head<3>();
  return X;
}

// At both knots the foot rests on the floor; between them it goes along an arc, 1 mm below.
TEST(MovingRoot, AFootThatSinksBetweenKnotsIsFound) {
  const double swing = std::acos(1.0 - 0.001 / kLeg), height = kLeg * std::cos(swing) + 0.01;
  const Trajectory sinks = HopperTrajectory(
      {{0, -swing, 0, 0, height, 1, 0, 0, 0}, {1, swing, 0, 0, height, 1, 0, 0, 0}});
  const TrajectoryCheck check = CheckTrajectory(sinks, Hopper(), {}, {.ground = 1e-6});
  const TrajectoryFinding& foot = FoundIn(check, Kind::kGround, "leg");
  EXPECT_FALSE(foot.proved);
  EXPECT_GT(foot.at_knots.value(), -1e-9);
  EXPECT_GE(foot.holds.value(), 0.001 - 1e-15);  // no less is true
  EXPECT_LT(foot.holds.value(), 0.001 + 2e-6);
  EXPECT_TRUE(CheckTrajectory(sinks, Hopper(), {}, {.ground = 0.001 + 1e-7}).proved());
  EXPECT_FALSE(CheckTrajectory(sinks, Hopper(), {}, {.ground = 0.001 - 1e-7}).proved());
  // The floor is not asked for, and that is told.
  const TrajectoryCheck without = CheckTrajectory(sinks, Hopper(), {}, {});
  EXPECT_TRUE(without.proved());
  EXPECT_THAT(without.not_covered, testing::Contains(HasSubstr("--ground")));
}

// A quarter of a turn of the trunk takes the foot past a ball; three quarters, told by a knot
// between, go the other way; the sign of a quaternion says nothing.
TEST(MovingRoot, TurnsByTheShorterWay) {
  const double s = std::sqrt(0.5), hip = M_PI_2;  // the leg along −x
  Scene scene;
  Obstacle ball{.name = "ball", .shape = Sphere{0.02}};
  ball.X_WO.translation() << -0.5 * s, -0.5 * s, 1.0;
  scene.obstacles = {ball};
  const std::array<double, 9> start = {0, hip, 0, 0, 1, 1, 0, 0, 0};
  for (const double sign : {1.0, -1.0}) {
    const Trajectory quarter =
        HopperTrajectory({start, {1, hip, 0, 0, 1, sign * s, 0, 0, sign * s}});
    const TrajectoryCheck check = CheckTrajectory(quarter, Hopper(), scene, {});
    const TrajectoryFinding& foot = FoundIn(check, Kind::kClearance, "leg - ball");
    EXPECT_FALSE(foot.proved);
    EXPECT_NEAR(foot.at, 0.5, 0.1);
    EXPECT_GT(foot.at_knots.value(), 0.3);
  }
  const Trajectory other_way =
      HopperTrajectory({start, {1, hip, 0, 0, 1, -s, 0, 0, s}, {2, hip, 0, 0, 1, 0, 0, 0, 1}});
  EXPECT_TRUE(CheckTrajectory(other_way, Hopper(), scene, {}).proved());
}

TEST(MovingRoot, FramesAndMotionsHoldWhatIsStated) {
  const JointedRobot robot = Hopper();
  std::mt19937_64 random(3);
  std::normal_distribution<double> draw;
  double tightest = 1.0, widest = 0.0;
  for (int i = 0; i < 100; ++i) {
    std::vector<std::array<double, 9>> knots;
    for (int k = 0; k < 4; ++k) {
      Eigen::Quaterniond q(draw(random), draw(random), draw(random), draw(random));
      q.normalize();
      knots.push_back({0.5 * k, 0.5 * draw(random), draw(random), draw(random), draw(random), q.w(),
                       q.x(), q.y(), q.z()});
    }
    Trajectory drawn = HopperTrajectory(knots);
    if (i % 2 == 1) {  // cubic
      SetBaseVelocities(Eigen::MatrixXd::NullaryExpr(6, 4, [&] { return draw(random); }), &drawn);
    }
    RobotMotion motion(drawn, robot);
    const JointedRobot::Body& foot = robot.bodies().back();
    const auto at = [&](double t) -> Eigen::Vector3d {
      const double q = motion.curves().Range(0, 0, t, t).Middle();
      return TrunkAt(drawn, t) * robot.urdf().LinkPoses({q})[1] * foot.shape.center;
    };
    std::uniform_real_distribution<double> place(0.0, 1.5), share(0.0, 1.0);
    const double from = place(random), to = from + (1.5 - from) * std::pow(share(random), 3);
    const double middle = 0.5 * from + 0.5 * to;
    const double most = motion.Moved(motion.Levers(foot, -1), from, to, middle);
    const bool whole = !motion.Pieces().HasKnot(from, to);
    double moved = 0.0;
    for (int n = 0; n <= 50; ++n) {
      const double t = from + (to - from) * n / 50;
      const Eigen::Vector3d there = at(t);
      const Vector sure = motion.At(t).sure[1] * VectorOf(foot.shape.center);
      moved = std::max(moved, (there - at(middle)).norm());
      try {
        const Vector wide = whole ? FrameOver(motion.On(1, from, to)) * VectorOf(foot.shape.center)
                                  : Vector{Interval(-9, 9), Interval(-9, 9), Interval(-9, 9)};
        for (size_t x = 0; x < 3; ++x) {
          const double value = there[static_cast<Eigen::Index>(x)];
          EXPECT_TRUE(sure[x].lo <= value + 1e-14 && value - 1e-14 <= sure[x].hi);
          EXPECT_LT(sure[x].hi - sure[x].lo, 1e-13);
          EXPECT_TRUE(wide[x].lo <= value + 1e-14 && value - 1e-14 <= wide[x].hi);
          if (whole && to - from < 0.01) widest = std::max(widest, wide[x].hi - wide[x].lo);
        }
      } catch (const NotDefined&) {
        EXPECT_GT(to - from, 0.05);
      }
    }
    EXPECT_LE(moved, most);
    tightest = std::min(tightest, 1.0 - moved / most);
  }
  EXPECT_LT(tightest, 0.2);
  EXPECT_GT(widest, 0.0);
  EXPECT_LT(widest, 0.3);
}

// The trunk goes ahead while the leg turns back: the foot stands at knots, and shifts between.
TEST(MovingRoot, AContactHoldsByWhatItMovesAndNoLess) {
  const double swing = 0.2;
  const auto x = [](double hip) { return kLeg * std::sin(hip); };
  const auto z = [](double hip) { return kLeg * std::cos(hip) + 0.01; };
  const Trajectory stands = HopperTrajectory({{0, -swing, x(-swing), 0, z(swing), 1, 0, 0, 0},
                                              {1, swing, x(swing), 0, z(swing), 1, 0, 0, 0},
                                              {2, swing, x(swing) + 1, 0, z(swing), 1, 0, 0, 0}});
  // Corners of the box around the ball go up to 1 cm farther from the axis than it.
  double most = 0.0;
  for (int n = 0; n <= 1000; ++n) {
    const double u = n / 1000.0, hip = swing * (2 * u - 1);
    const Eigen::Vector3d trunk(x(swing) * (2 * u - 1), 0, z(swing));
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector3d corner(i & 1 ? 0.01 : -0.01, 0.01, (i & 2 ? 0.01 : -0.01) - kLeg);
      const auto place = [&](const Eigen::Vector3d& at, double angle) -> Eigen::Vector3d {
        return at + RollPitchYaw(0, angle, 0) * corner;
      };
      const Eigen::Vector3d first(x(-swing), 0, z(swing));
      most = std::max(most, (place(trunk, hip) - place(first, -swing)).norm());
    }
  }
  ASSERT_GT(most, 0.005);
  const auto check = [&](double distance, double angle, double to) {
    return CheckTrajectory(stands, Hopper(), {},
                           {.contacts = {{.link = "leg", .from = 0.0, .to = to}},
                            .contact_distance = distance,
                            .contact_angle = angle});
  };
  EXPECT_TRUE(check(most + 1e-6, 2 * swing + 1e-9, 1.0).proved());
  const TrajectoryCheck less = check(most - 1e-6, 2 * swing - 1e-6, 1.0);
  for (const TrajectoryFinding& finding : less.findings) {
    if (finding.kind != Kind::kStill && finding.kind != Kind::kTilt) continue;
    const double truth = finding.kind == Kind::kStill ? most : 2 * swing;
    EXPECT_FALSE(finding.proved);
    EXPECT_GE(finding.holds.value(), truth - 1e-12);
    EXPECT_LT(finding.holds.value(), truth + 3e-6);
  }
  EXPECT_FALSE(check(0.1, 2 * swing + 1e-9, 2.0).proved());
  EXPECT_THAT(RefusalOf([&] { check(0.1, 0.1, 3.0); }), HasSubstr("--contact: leg: 0 to 3 s"));
}

TEST(MovingRoot, MistakesAreTold) {
  EXPECT_THAT(RefusalOf([] {
                HopperTrajectory({{0, 0, 0, 0, 1, 1, 0, 0, 0}, {1, 0, 0, 0, 1, 2, 0, 0, 0}});
              }),
              HasSubstr("base: knot 2: is no pose"));
  const Trajectory rests =
      HopperTrajectory({{0, 0, 0, 0, 1, 1, 0, 0, 0}, {1, 0, 0, 0, 1, 1, 0, 0, 0}});
  EXPECT_THAT(
      RefusalOf([&] { CheckTrajectory(rests, Hopper(), {}, {.contacts = {{.link = "foot"}}}); }),
      HasSubstr("--contact: no such link: 'foot'"));
}

}  // namespace
}  // namespace halfstep::checker
