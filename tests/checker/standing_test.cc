// What the floor has to give to a robot whose root moves, and joints above a link that stands.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "experiments/checker/check_place.h"
#include "experiments/checker/standing.h"
#include "experiments/checker/trajectory_statements.h"
#include "experiments/checker/walk_statements.h"
#include "tests/checker/found_in_check.h"
#include "tests/checker/made_run.h"
#include "tests/refusal_of.h"
#include "wpg/nth.h"
#include "wpg/robot/gravity.h"
#include "wpg/robot/robot_tree.h"

namespace halfstep::checker {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using Kind = TrajectoryFinding::Kind;

constexpr double kHigh = 0.8, kHalf = 0.1;  // of the cart above the floor, half of its foot [m]

std::string Weight(double mass, double inertia) {
  const std::string i = std::to_string(inertia);
  return "<inertial><mass value='" + std::to_string(mass) + "'/><inertia ixx='" + i + "' iyy='" +
         i + "' izz='" + i + "' ixy='0' ixz='0' iyz='0'/></inertial>";
}

// A cart of 10 kg, the root, that slides along x and turns above a foot without mass, a plate of
// 0.2 m by 0.1 m, 1 cm behind, whose lower side is 0.8 m below the cart. A head of 2 kg turns on
// the cart.
JointedRobot Cart(const std::string& foot = "<box size='0.2 0.1 0.04'/>") {
  const std::string limits = "lower='-3' upper='3' velocity='9' effort='";
  return {
      ParseUrdf("cart.urdf",
                "<robot name='cart'><link name='cart'>" + Weight(10, 0.4) +
                    "</link><link name='slide'/><link name='foot'><collision><origin xyz='-0.01 "
                    "0 -0.78'/><geometry>" +
                    foot + "</geometry></collision></link><link name='head'>" + Weight(2, 0.03) +
                    "</link><joint name='turn' type='revolute'><parent link='cart'/><child "
                    "link='slide'/><axis xyz='0 0 1'/><limit " +
                    limits +
                    "99'/></joint><joint name='along' type='prismatic'><parent link='slide'/>"
                    "<child link='foot'/><axis xyz='1 0 0'/><limit " +
                    limits +
                    "99'/></joint><joint name='neck' type='revolute'><parent link='cart'/>"
                    "<child link='head'/><origin xyz='0.1 0 0.3'/><axis xyz='0 1 0'/><limit " +
                    limits + "99'/></joint></robot>"),
      {}};
}

// The cart goes from −far to far in a second, from rest to rest, above the foot at 0.
Trajectory Ahead(double far) {
  Trajectory moves;
  moves.file = "cart.csv";
  moves.joints = {"along"};
  moves.times = {0, 1};
  moves.q.resize(1, 2);
  moves.q << far, -far;
  moves.v.setZero(1, 2);
  SetInterpolation({}, &moves);
  Eigen::MatrixXd poses(7, 2);
  poses << -far, far, 0, 0, kHigh, kHigh, 1, 1, 0, 0, 0, 0, 0, 0;
  SetBase(poses, &moves);
  SetBaseVelocities(Eigen::MatrixXd::Zero(6, 2), &moves);
  return moves;
}
constexpr double kStands = 1.0;  // s in which the foot is claimed
TrajectoryDemands Claims(std::optional<double> zmp, std::optional<double> friction) {
  return {
      .contacts = {{.link = "foot", .from = 0.0, .to = kStands}}, .zmp = zmp, .friction = friction};
}

// With x = far(6u² − 4u³ − 1), the centre of mass being 2/12·0.1 m ahead and 2/12·0.3 m above of
// the cart, the ZMP is x + 0.1/6 − (0.8 + 0.05)ẍ/g, and ‖f_t‖/f_z is |ẍ|/g.
TEST(Standing, ZmpAndFrictionAreThoseOfACart) {
  const double far = 0.02;
  double least = 1.0, most = 0.0;
  for (int n = 0; n <= 10000; ++n) {
    const double u = n / 10000.0, x = far * (6 * u * u - 4 * u * u * u - 1);
    const double a = far * (12 - 24 * u);
    least = std::min(least, kHalf - std::abs(x + 0.01 + 0.1 / 6 - 0.85 * a / kGravity));
    most = std::max(most, std::abs(a) / kGravity);
  }
  const auto check = [&](double zmp, double friction) {
    return CheckTrajectory(Ahead(far), Cart(), {}, Claims(zmp, friction));
  };
  const TrajectoryCheck kept = check(least - 1e-6, most + 1e-6);
  EXPECT_TRUE(kept.proved());
  const std::string subject = "foot from 0 to 1 s";
  EXPECT_NEAR(FoundIn(kept, Kind::kZmpRobot, subject).least, least, 1e-6);
  const TrajectoryCheck less = check(least + 1e-6, most - 1e-6);
  EXPECT_FALSE(FoundIn(less, Kind::kZmpRobot, subject).proved);
  const TrajectoryFinding& friction = FoundIn(less, Kind::kFriction, subject);
  EXPECT_FALSE(friction.proved);
  EXPECT_GE(friction.holds.value(), most - 1e-12);
  EXPECT_LT(friction.holds.value(), most + 2e-6);
  // Seven times as far the ZMP leaves the foot.
  const TrajectoryCheck fast = CheckTrajectory(Ahead(7 * far), Cart(), {}, Claims(0.0, 1.0));
  EXPECT_FALSE(FoundIn(fast, Kind::kZmpRobot, subject).proved);
  EXPECT_FALSE(FoundIn(fast, Kind::kFriction, subject).proved);
}

// Of a round sole a polygon of 16 corners is taken, of balls where they touch, and of a plate that
// is tilted its lower edge.
TEST(Standing, SolesAreWhatIsLowest) {
  const auto least = [](const JointedRobot& robot, const Trajectory& moves) {
    const TrajectoryCheck check = CheckTrajectory(moves, robot, {}, Claims(0.0, {}));
    return FoundIn(check, Kind::kZmpRobot, "foot from 0 to 1 s").least;
  };
  const double plate = least(Cart(), Ahead(0.0));
  EXPECT_NEAR(plate, 0.05, 1e-6);
  std::string balls = "<sphere radius='0.02'/>";
  for (const std::string at : {"0.1 0.05", "-0.1 0.05", "-0.1 -0.05", "0.1 -0.05"}) {
    balls += "</geometry></collision><collision><origin xyz='" + at +
             " -0.79'/><geometry><sphere radius='0.01'/>";
  }
  EXPECT_NEAR(least(Cart(balls), Ahead(0.0)), 0.05, 1e-6);
  const double disc = least(Cart("<cylinder radius='0.1' length='0.04'/>"), Ahead(0.0));
  EXPECT_NEAR(disc, (0.09 - 0.1 / 6) * std::cos(M_PI / 16), 1e-6);
  EXPECT_THAT(RefusalOf([&] { least(Cart("<sphere radius='0.02'/>"), Ahead(0.0)); }),
              HasSubstr("--zmp: contacts are at no time level soles"));
  Trajectory tilted = Ahead(0.0);
  Eigen::MatrixXd poses = tilted.base;
  poses.row(3).setConstant(std::cos(0.01));
  poses.row(5).setConstant(std::sin(0.01));
  SetBase(poses, &tilted);
  EXPECT_THAT(RefusalOf([&] { least(Cart(), tilted); }), HasSubstr("no time level soles"));
  TrajectoryDemands within = Claims(0.0, {});
  within.contact_distance = 0.2 * std::sin(0.02) + 1e-9;
  EXPECT_TRUE(CheckTrajectory(tilted, Cart(), {}, within).proved());
  within.contact_distance -= 2e-9;
  EXPECT_THAT(RefusalOf([&] { CheckTrajectory(tilted, Cart(), {}, within); }),
              HasSubstr("no time level soles"));
}

TEST(Standing, NothingPushesInAFreeFall) {
  Trajectory falls = Ahead(0.0);
  Eigen::MatrixXd poses = falls.base, velocities = Eigen::MatrixXd::Zero(6, 2);
  poses(2, 1) -= 0.5 * kGravity;
  velocities(2, 1) = -kGravity;
  SetBase(poses, &falls);
  SetBaseVelocities(velocities, &falls);
  const JointedRobot robot = Cart();
  RobotMotion motion(falls, robot);
  Pushes pushes(&motion);
  for (const Rate& force : pushes.Below(0, 0.0, 1.0).force) {
    EXPECT_LT(force.over[0].Magnitude(), 1e-10);
  }
  const TrajectoryCheck check = CheckTrajectory(falls, robot, {}, Claims(0.0, 1.0));
  const TrajectoryFinding& zmp = FoundIn(check, Kind::kZmpRobot, "foot from 0 to 1 s");
  EXPECT_FALSE(zmp.proved);
  EXPECT_EQ(zmp.least, -kInfinity);
  EXPECT_FALSE(FoundIn(check, Kind::kFriction, "foot from 0 to 1 s").holds);
}

// A motion of its own: cubic numbers, the quaternion scaled to length 1.
struct Stated {
  explicit Stated(const Trajectory& of) : of_(of) {}

  Eigen::Isometry3d RootAt(double t) const {
    Eigen::Matrix<double, 7, 2> rates;
    for (Eigen::Index k = 0; k < 2; ++k) {
      const Eigen::VectorXd v = of_.base_v.col(k);
      const Eigen::Quaterniond q(of_.base(3, k), of_.base(4, k), of_.base(5, k), of_.base(6, k));
      const Eigen::Quaterniond r = Eigen::Quaterniond(0, v[3], v[4], v[5]) * q;
      rates.col(k) << v[0], v[1], v[2], 0.5 * r.w(), 0.5 * r.x(), 0.5 * r.y(), 0.5 * r.z();
    }
    const Eigen::VectorXd p =
        Between(of_.base.col(0), rates.col(0), of_.base.col(1), rates.col(1), t);
    Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
    X.linear() = Eigen::Quaterniond(p[3], p[4], p[5], p[6]).normalized().toRotationMatrix();
    X.translation() = p.head<3>();
    return X;
  }
  double HeadAt(double t) const {
    return Between(of_.q.col(0), of_.v.col(0), of_.q.col(1), of_.v.col(1), t)[0];
  }

 private:
  Eigen::VectorXd Between(const Eigen::VectorXd& q0, const Eigen::VectorXd& v0,
                          const Eigen::VectorXd& q1, const Eigen::VectorXd& v1, double t) const {
    const double h = of_.times[1] - of_.times[0], u = (t - of_.times[0]) / h;
    return (1 + 2 * u) * (1 - u) * (1 - u) * q0 + h * u * (1 - u) * (1 - u) * v0 +
           u * u * (3 - 2 * u) * q1 - h * u * u * (1 - u) * v1;
  }
  const Trajectory& of_;
};

// Momenta by differences: the floor gives ṗ + mgẑ, and L̇ + Σ r × mgẑ about W's origin.
TEST(Standing, ForcesAreSlopesOfMomenta) {
  const JointedRobot robot = Cart();
  std::mt19937_64 random(5);
  std::normal_distribution<double> draw;
  double narrowest = 1e9;
  for (int i = 0; i < 20; ++i) {
    Trajectory drawn;
    drawn.joints = {"neck"};
    drawn.times = {2, 2.5};
    drawn.q = 0.5 * Eigen::MatrixXd::NullaryExpr(1, 2, [&] { return draw(random); });
    drawn.v = Eigen::MatrixXd::NullaryExpr(1, 2, [&] { return draw(random); });
    SetInterpolation({}, &drawn);
    Eigen::MatrixXd poses = Eigen::MatrixXd::NullaryExpr(7, 2, [&] { return draw(random); });
    for (Eigen::Index k = 0; k < 2; ++k) poses.col(k).tail<4>().normalize();
    SetBase(poses, &drawn);
    SetBaseVelocities(Eigen::MatrixXd::NullaryExpr(6, 2, [&] { return 2 * draw(random); }), &drawn);
    const Stated stated(drawn);
    using Both = Eigen::Matrix<double, 6, 1>;
    constexpr double kStep = 3e-5;
    const auto frames = [&](double t) {
      const Eigen::Isometry3d X = stated.RootAt(t);
      std::array<Eigen::Isometry3d, 2> of = {X, X};
      of[1].translate(Eigen::Vector3d(0.1, 0, 0.3));
      of[1].rotate(Eigen::AngleAxisd(stated.HeadAt(t), Eigen::Vector3d::UnitY()));
      return of;
    };
    const auto momenta = [&](double t) {
      const auto before = frames(t - kStep), now = frames(t), after = frames(t + kStep);
      Both sum = Both::Zero();
      for (size_t link = 0; link < 2; ++link) {
        const double mass = link == 0 ? 10 : 2, inertia = link == 0 ? 0.4 : 0.03;
        const Eigen::Vector3d v =
            (after[link].translation() - before[link].translation()) / (2 * kStep);
        const Eigen::Matrix3d turn = (after[link].linear() - before[link].linear()) *
                                     now[link].linear().transpose() / (2 * kStep);
        const Eigen::Vector3d w(turn(2, 1), turn(0, 2), turn(1, 0));
        sum.head<3>() += mass * v;
        sum.tail<3>() += mass * now[link].translation().cross(v) + inertia * w;
      }
      return sum;
    };
    RobotMotion motion(drawn, robot);
    Pushes pushes(&motion);
    for (const double t : {2.1, 2.25, 2.43}) {
      Both floor = (momenta(t + kStep) - momenta(t - kStep)) / (2 * kStep);
      for (size_t link = 0; link < 2; ++link) {
        const double weight = (link == 0 ? 10 : 2) * kGravity;
        floor[2] += weight;
        floor.tail<3>() += frames(t)[link].translation().cross(Eigen::Vector3d(0, 0, weight));
      }
      const Push& at = pushes.Below(0, t, t);
      const Push& over = pushes.Below(0, t - 0.001, t + 0.001);
      for (size_t k = 0; k < 6; ++k) {
        const Rate& sure = k < 3 ? at.force[k] : at.moment[k - 3];
        const Interval& wide = (k < 3 ? over.force[k] : over.moment[k - 3]).over[0];
        const double told = floor[static_cast<Eigen::Index>(k)];
        EXPECT_NEAR(sure.at[0].Middle(), told, 1e-3 * (1 + std::abs(told)));
        EXPECT_LT(sure.over[0].hi - sure.over[0].lo, 1e-9);
        EXPECT_TRUE(wide.lo <= sure.at[0].lo && sure.at[0].hi <= wide.hi);
        narrowest = std::min(narrowest, wide.hi - wide.lo);
      }
    }
  }
  EXPECT_LT(narrowest, 5.0);
}

// A carriage of 3 kg along a rail of 4 kg, and an arm of 2 kg that turns on it.
JointedRobot Crane(double force, double torque) {
  const std::string limits = "lower='-1' upper='1' velocity='5' effort='";
  return {ParseUrdf("crane.urdf",
                    "<robot name='crane'><link name='rail'>" + Weight(4, 0.2) +
                        "</link><link name='carriage'>" + Weight(3, 1) +
                        "</link><link name='arm'>"
                        "<inertial><origin xyz='0.3 0 0'/><mass value='2'/><inertia ixx='0.01' "
                        "iyy='0.05' izz='0.05' ixy='0' ixz='0' iyz='0'/></inertial></link>"
                        "<joint name='rail_joint' type='prismatic'><parent link='rail'/><child "
                        "link='carriage'/><axis xyz='1 0 0'/><limit " +
                        limits + std::to_string(force) +
                        "'/></joint><joint name='swing' type='revolute'><parent link='carriage'/>"
                        "<child link='arm'/><axis xyz='0 1 0'/><limit " +
                        limits + std::to_string(torque) + "'/></joint></robot>"),
          {}};
}
Trajectory CraneMoves(bool with_base) {
  Trajectory moves;
  moves.file = "crane.csv";
  moves.joints = {"rail_joint", "swing"};
  moves.times = {0, 1};
  moves.q.resize(2, 2);
  moves.q << 0.1, 0.5, -0.2, 0.4;
  moves.v.setZero(2, 2);
  SetInterpolation({}, &moves);
  if (!with_base) return moves;
  Eigen::MatrixXd poses = Eigen::MatrixXd::Zero(7, 2);
  poses.row(3).setOnes();
  SetBase(poses, &moves);
  SetBaseVelocities(Eigen::MatrixXd::Zero(6, 2), &moves);
  return moves;
}

// A root that rests and stands is as good as one that is fixed.
TEST(Standing, TorquesOfARootThatRestsAreThoseOfAFixedOne) {
  const TrajectoryCheck fixed = CheckTrajectory(CraneMoves(false), Crane(40, 40), {}, {});
  const TrajectoryCheck stands =
      CheckTrajectory(CraneMoves(true), Crane(40, 40), {}, {.contacts = {{.link = "rail"}}});
  for (const std::string joint : {"rail_joint", "swing"}) {
    const TrajectoryFinding& one = FoundIn(fixed, Kind::kTorque, joint);
    const TrajectoryFinding& other =
        FoundIn(stands, Kind::kTorque, joint + ", by rail from 0 to 1 s");
    EXPECT_TRUE(one.proved);
    EXPECT_NEAR(one.least, other.least, 1e-9);
  }
}

// Where the arm stands, it carries the carriage above its joint, and the rail 0.5 m beside at most.
TEST(Standing, WhatStandsCarriesTheOthers) {
  const double torque = 4 * kGravity * 0.5;
  const auto check = [](double most) {
    return CheckTrajectory(
        CraneMoves(true), Crane(1e-6, most), {},
        {.contacts = {{.link = "arm"}}, .contact_distance = 9.0, .contact_angle = 3.0});
  };
  EXPECT_TRUE(check(torque + 1e-5).proved());
  const TrajectoryCheck less = check(torque - 1e-5);
  EXPECT_TRUE(FoundIn(less, Kind::kTorque, "rail_joint, by arm from 0 to 1 s").proved);
  EXPECT_FALSE(FoundIn(less, Kind::kTorque, "swing, by arm from 0 to 1 s").proved);
  const TrajectoryCheck both =
      CheckTrajectory(CraneMoves(true), Crane(40, 40), {},
                      {.contacts = {{.link = "arm", .to = 0.75}, {.link = "rail", .from = 0.5}},
                       .contact_distance = 9.0,
                       .contact_angle = 3.0});
  EXPECT_THAT(both.not_covered, Contains(HasSubstr("torques for 0.25 s in which not exactly one")));
}

// A walk of halfstep, whose ZMP and torques are known without a trajectory of joints.
TEST(Standing, OfAWalkOfHalfstepTheSameIsFound) {
  const MadeRun run(R"(robot: wren
scene: none
footsteps:
  - {foot: right, x_m: 0.06, y_m: -0.04, yaw_deg: 10}
  - {foot: left, x_m: 0.09, y_m: 0.06, yaw_deg: 20}
)");
  const WholeRobot whole = LoadWholeRobot(InSources("wpg/robots/wren.yaml"));
  RobotTree still = whole.tree;
  still.posture.assign(still.posture.size(), 0.0);
  const CheckPlace place = ReadCheckPlace(InSources("wpg/robots/wren.yaml"), "", {});
  const Moving moving(run.walk);
  std::vector<double> times;
  for (size_t k = 0; k + 1 < moving.motion.knots().size(); ++k) {
    const double from = moving.motion.knots()[k], to = moving.motion.knots()[k + 1];
    if (to - from < 1e-6) continue;
    const int parts = static_cast<int>(std::ceil((to - from) / 0.004));
    for (int i = 0; i < parts; ++i) times.push_back(from + (to - from) * i / parts);
  }
  Trajectory trajectory;
  const std::vector<int> joints = JointsInFileOrder(whole.tree.urdf);
  for (const int joint : joints)
    trajectory.joints.push_back(Nth(whole.tree.urdf.joints, joint).name);
  trajectory.times = times;
  const auto count = std::ssize(times);
  trajectory.q.resize(std::ssize(joints), count);
  trajectory.v.resize(std::ssize(joints), count);
  Eigen::MatrixXd poses(7, count), velocities(6, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const double t = times[static_cast<size_t>(k)];
    WalkState state = moving.On(t, t);
    std::array<Vector6d, 2> q, v;
    for (size_t side = 0; side < 2; ++side) {
      for (size_t i = 0; i < 6; ++i) {
        const Curve& angle = state.leg(side).q[i];
        q[side][static_cast<Eigen::Index>(i)] = angle.at[0].Middle();
        v[side][static_cast<Eigen::Index>(i)] = angle.at[1].Middle();
      }
    }
    const std::vector<double> all = JointAngles(whole.model, whole.tree, q);
    const std::vector<double> rates = JointAngles(whole.model, still, v);
    for (size_t j = 0; j < joints.size(); ++j) {
      trajectory.q(static_cast<Eigen::Index>(j), k) = Nth(all, joints[j]);
      trajectory.v(static_cast<Eigen::Index>(j), k) = Nth(rates, joints[j]);
    }
    const auto number = [&](size_t i, size_t order) {
      return state.numbers()[i].at[order].Middle();
    };
    const double yaw = number(kYaw, 0), rate = number(kYaw, 1), ahead = whole.model.com_x_B;
    poses.col(k) << number(kCom, 0) - ahead * std::cos(yaw),
        number(kCom + 1, 0) - ahead * std::sin(yaw), moving.Height().Middle() + number(kWaistZ, 0),
        std::cos(0.5 * yaw), 0, 0, std::sin(0.5 * yaw);
    velocities.col(k) << number(kCom, 1) + ahead * rate * std::sin(yaw),
        number(kCom + 1, 1) - ahead * rate * std::cos(yaw), number(kWaistZ, 1), 0, 0, rate;
  }
  SetInterpolation({}, &trajectory);
  SetBase(poses, &trajectory);
  SetBaseVelocities(velocities, &trajectory);

  TrajectoryDemands demands{.zmp = 0.0, .friction = 1.0};
  const WalkMotion::Flight& flight = moving.motion.flights().front();
  const std::string foot = Nth(whole.tree.urdf.links, Nth(whole.tree.feet, 1 - flight.side)).name;
  demands.contacts = {{.link = foot, .from = flight.begin, .to = flight.end}};
  RobotMotion motion(trajectory, place.robot);
  std::vector<Statement> statements;
  TrajectoryCheck check;
  const std::vector<Standing> standing = StandingOf(demands, motion);
  AddFloor(trajectory, demands, standing, &motion, &statements, &check);
  AddTorques(trajectory, standing, &motion, &statements, &check);
  WalkStatements of_walk(run.walk.robot, run.walk.scene, run.walk.certificate);
  std::map<Kind, int> compared;
  for (double t = flight.begin + 0.011; t < flight.end; t += 0.037) {
    WalkState state = moving.On(t, t);
    for (const Statement& statement : statements) {
      const std::string joint = statement.subject.substr(0, statement.subject.find(','));
      for (WalkStatement& other : of_walk.all()) {
        const bool same =
            (statement.kind == Kind::kZmpRobot && other.family == verify::kZmpRobot) ||
            (statement.kind == Kind::kFriction && other.family == verify::kFriction) ||
            (statement.kind == Kind::kTorque && other.family == verify::kTorque &&
             other.subject == joint);
        if (!same) continue;
        double expected = of_walk.Look(&other, &state).value;
        if (statement.kind == Kind::kFriction) expected += 1.0 - run.walk.scene.friction;
        EXPECT_NEAR(statement.value(t), expected, statement.kind == Kind::kTorque ? 2e-3 : 2e-4)
            << statement.subject << " at " << t;
        ++compared[statement.kind];
      }
    }
  }
  // What is proved is what samples show, and no more.
  for (const Statement& statement : statements) {
    const bool knee = statement.subject.starts_with("left_knee");
    if (statement.kind == Kind::kTorque && !knee) continue;
    double least = kInfinity;
    for (size_t k = 0; k + 1 < times.size(); ++k) {
      for (int n = 0; n < 4; ++n) {
        const double t = times[k] + 0.25 * n * (times[k + 1] - times[k]);
        if (t < statement.span.begin || t > statement.span.end) continue;
        least = std::min(least, statement.value(t));
      }
    }
    const double off = statement.kind == Kind::kTorque ? 3e-3 : 1e-4;
    EXPECT_TRUE(Prove(statement.span, least - off, statement.look).proved) << statement.subject;
    EXPECT_FALSE(Prove(statement.span, least + 1e-9, statement.look).proved) << statement.subject;
  }
  EXPECT_GT(compared[Kind::kZmpRobot], 5);
  EXPECT_GT(compared[Kind::kFriction], 5);
  EXPECT_GT(compared[Kind::kTorque], 50);
}

TEST(Standing, WhatCannotBeKnownIsTold) {
  const auto refused = [](const Trajectory& trajectory, const TrajectoryDemands& demands) {
    return RefusalOf([&] { CheckTrajectory(trajectory, Cart(), {}, demands); });
  };
  const Trajectory ahead = Ahead(0.02);
  EXPECT_THAT(refused(ahead, {.zmp = 0.0}), HasSubstr("--zmp: no contact is claimed"));
  Trajectory other = ahead;
  other.base.resize(0, 0);
  EXPECT_THAT(refused(other, Claims({}, 1.0)), HasSubstr("--friction: the root is fixed"));
  other = ahead;
  other.base_v.resize(0, 0);
  EXPECT_THAT(refused(other, Claims(0.0, {})), HasSubstr("the root goes straight between knots"));
  EXPECT_THAT(CheckTrajectory(other, Cart(), {}, {}).not_covered,
              Contains(HasSubstr("torques: the root goes straight")));
  SetInterpolation(Interpolation::kLinear, &other);
  other.base_v = ahead.base_v;
  EXPECT_THAT(refused(other, Claims(0.0, {})), HasSubstr("linear pieces have no accelerations"));
  SetInterpolation(Interpolation::kLinear, &other);
  EXPECT_EQ(other.base_v.size(), 0);
  TrajectoryDemands half = Claims(0.0, {});
  half.contacts[0].to = 0.5;
  EXPECT_THAT(CheckTrajectory(ahead, Cart(), {}, half).not_covered,
              AllOf(Contains(HasSubstr("ZMP and friction for 0.5 s in which no contact")),
                    Contains(HasSubstr("torques for 0.5 s"))));
  other = ahead;
  other.base_v.row(3).setConstant(-99.0);
  other.base.col(1).tail<4>() << 0, 1, 0, 0;
  EXPECT_THAT(refused(other, {}), HasSubstr("cart.csv: base: knot 1: turns too fast"));
  EXPECT_THAT(RefusalOf([&] { SetBaseVelocities(Eigen::MatrixXd::Constant(6, 2, 1e7), &other); }),
              HasSubstr("base: knot 1: its velocity is no number"));
}

}  // namespace
}  // namespace halfstep::checker
