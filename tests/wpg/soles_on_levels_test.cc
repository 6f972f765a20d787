// What two soles at different heights can carry: forces at their corners found by non-negative
// least squares, sections looked through one by one, loads against moments.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>

#include "tests/draws.h"
#include "tests/wpg/algebra_draw.h"
#include "tests/wpg/asking_robot.h"
#include "tests/wpg/non_negative.h"
#include "wpg/geometry/support_polygon.h"
#include "wpg/motion/foot_friction.h"
#include "wpg/motion/foot_loads.h"
#include "wpg/motion/sole_section.h"
#include "wpg/motion/sole_shadows.h"

namespace halfstep {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

const Vector2d kSole(0.23, 0.135);

// Two soles at different heights, and what is asked of them.
struct OnLevels {
  WalkState x = WalkState::Zero();
  StandingHeights heights{x, std::nullopt};
  RobotDynamics dynamics;

  SoleShadows Shadows() const { return {x, heights, kSole, dynamics}; }
  Pose2 Sole(Side side) const { return FootPose(x, side); }
  Vector2d ZmpAt(Side side) const { return *dynamics.Zmp(heights.of(side)); }
  std::array<Vector2d, 2> Zmps() const { return {ZmpAt(Side::kLeft), ZmpAt(Side::kRight)}; }
  std::optional<FootLoads> Loads() const { return FootLoads::OnLevels(x, heights, kSole, Zmps()); }
  std::optional<FootFriction> Friction() const {
    return FootFriction::OnLevels(dynamics, x, heights, kSole);
  }
  // Corners of that sole in space, from O (3×4).
  Eigen::Matrix<double, 3, 4> Corners(Side side) const {
    Eigen::Matrix<double, 3, 4> corners;
    corners.topRows<2>() = SoleCorners(Sole(side), kSole);
    corners.row(2).setConstant(heights.of(side));
    return corners.colwise() - dynamics.O();
  }
};

WalkState DrawSoles(AlgebraDraw* draw) {
  WalkState x = WalkState::Zero();
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const int foot = FootIndex(side);
    x[foot] = draw->Uniform(-0.2, 0.2);
    x[foot + 1] = Sign(side) * draw->Uniform(0.08, 0.2);
    x[foot + 2] = draw->Uniform(-0.2, 0.2);
    x[foot + 3] = draw->Uniform(-0.7, 0.7);
  }
  return x;
}

// The line of ZMPs leads through a point between the soles, or somewhat beside them.
OnLevels DrawOnLevels(AskingRobot* asking, AlgebraDraw* draw) {
  WalkState x = DrawSoles(draw);
  const double share = draw->Uniform(-0.3, 1.3);
  Vector3d point = (1.0 - share) * x.segment<3>(kLeftX) + share * x.segment<3>(kRightX);
  point.head<2>() += Vector2d(draw->Uniform(-0.15, 0.15), draw->Uniform(-0.1, 0.1));
  const Given given{.zmp = {0, 0},
                    .pull = draw->Uniform(0, 200) * Vector2d(draw->Direction().head<2>()),
                    .turn = draw->Uniform(-20, 20),
                    .push = 400.0};
  // So that the ZMP on z = 0 is where the robot can be.
  const Vector2d zmp = point.head<2>() - point.z() / given.push * given.pull;
  for (const Side side : {Side::kLeft, Side::kRight}) x.segment<2>(FootIndex(side)) -= zmp;
  return {x, {x, std::nullopt}, asking->That(given)};
}

// Whether pushes along the floor's force at the soles' corners have its force, and its moment but
// for the one about the vertical.
bool CornersCanCarry(const OnLevels& soles, const Vector2d& moved = {0, 0}) {
  Vector6d contact = soles.dynamics.contact();
  const Vector3d force = contact.tail<3>(), aside(moved.x(), moved.y(), 0.0);
  contact.head<3>() += aside.cross(force);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(6, 10);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const auto corners = soles.Corners(side);
    for (Eigen::Index k = 0; k < 4; ++k) {
      A.col(4 * Index(side) + k) << Vector3d(corners.col(k)).cross(force) / force.z(),
          force / force.z();
    }
  }
  A(2, 8) = 1.0;
  A(2, 9) = -1.0;
  const Eigen::VectorXd pushes = NonNegativeLeastSquares(A, contact);
  return (A * pushes - contact).norm() < 1e-7 * contact.norm();
}

TEST(SolesOnLevels, CarryWhatIsInsideOfTheirShadowsAndNothingElse) {
  AskingRobot asking;
  AlgebraDraw draw(60);
  int carried = 0, refused = 0, wrong_from_above = 0, wrong_in_the_middle = 0;
  for (int i = 0; i < Draws(1500); ++i) {
    const OnLevels soles = DrawOnLevels(&asking, &draw);
    const double margin = soles.Shadows().Margin();
    if (std::abs(margin) < 1e-4) continue;
    const bool can = CornersCanCarry(soles);
    ASSERT_EQ(margin > 0.0, can) << margin;
    ++(can ? carried : refused);
    const SupportPolygon from_above(soles.Sole(Side::kLeft), soles.Sole(Side::kRight), kSole);
    // Controls: without heights, and on one plane between them.
    if ((from_above.Margin(*soles.dynamics.Zmp()) > 0.0) != can) ++wrong_from_above;
    if ((from_above.Margin(soles.Shadows().zmp()) > 0.0) != can) ++wrong_in_the_middle;
    if (!can) continue;
    // So far it may be moved aside, and no farther.
    EXPECT_TRUE(CornersCanCarry(soles, 0.99 * margin * draw.Direction().head<2>()));
    const SupportPolygon hull = soles.Shadows().hull();
    bool leaves = false;
    for (int k = 0; k < hull.size(); ++k) {
      const Vector2d edge = hull.corner((k + 1) % hull.size()) - hull.corner(k);
      const Vector2d outward = Vector2d(edge.y(), -edge.x()).normalized();
      leaves = leaves || !CornersCanCarry(soles, 1.01 * margin * outward);
    }
    EXPECT_TRUE(leaves);
  }
  EXPECT_GT(carried, Draws(1500) / 4);
  EXPECT_GT(refused, Draws(1500) / 4);
  EXPECT_GT(wrong_from_above, Draws(1500) / 30);
  EXPECT_GT(wrong_in_the_middle, kFewDraws ? 0 : 25);  // of 150 draws hardly one
}

TEST(SolesOnLevels, AreTodaysPolygonWhereTheyAreLevel) {
  AskingRobot asking;
  AlgebraDraw draw(61);
  for (int i = 0; i < 50; ++i) {
    OnLevels soles = DrawOnLevels(&asking, &draw);
    soles.x[kLeftZ] = draw.Uniform(0, 1) < 0.5 ? 0.0 : 0.3;
    soles.x[kRightZ] = soles.x[kLeftZ] + draw.Uniform(-9e-11, 9e-11);
    soles.heights = {soles.x, std::nullopt};
    EXPECT_TRUE(soles.heights.level());
    const SupportPolygon polygon(soles.Sole(Side::kLeft), soles.Sole(Side::kRight), kSole);
    EXPECT_EQ(soles.Shadows().Margin(), polygon.Margin(soles.ZmpAt(Side::kLeft)));
    // The left sole's height counts where it stands alone.
    soles.x[kRightZ] = 7.0;
    EXPECT_EQ(StandingHeights(soles.x, Side::kLeft).middle(), soles.x[kLeftZ]);
    EXPECT_FALSE(StandingHeights(soles.x, std::nullopt).level());
  }
}

TEST(SolesOnLevels, HaveTheirSections) {
  AlgebraDraw draw(62);
  for (int i = 0; i < Draws(500); ++i) {
    const WalkState x = DrawSoles(&draw);
    const Pose2 left = FootPose(x, Side::kLeft);
    Pose2 right = FootPose(x, Side::kRight);
    right.yaw += std::floor(draw.Uniform(-4, 4)) * 1.5707963267948966;
    if (i % 5 == 0) right.yaw = left.yaw;
    const double share = i % 7 == 0 ? 0.0 : i % 7 == 1 ? 1.0 : draw.Uniform(0, 1);
    const SupportPolygon section = SupportPolygon::Section(left, right, kSole, share);
    const auto of_left = SoleCorners(left, kSole), of_right = SoleCorners(right, kSole);
    for (int k = 0; k < 12; ++k) {
      const Vector2d n = Eigen::Rotation2Dd(k * 0.52) * Vector2d(1, 0);
      double most = -1e9;
      for (int c = 0; c < section.size(); ++c) most = std::max(most, n.dot(section.corner(c)));
      EXPECT_NEAR(most,
                  (1.0 - share) * (n.transpose() * of_left).maxCoeff() +
                      share * (n.transpose() * of_right).maxCoeff(),
                  1e-14);
    }
    // Counter-clockwise: its centre is as far inside as it is of the narrower sole at least.
    const Vector2d centre = (1.0 - share) * left.position() + share * right.position();
    EXPECT_GT(section.Margin(centre), 0.5 * kSole.y() - 1e-12);
  }
}

// Of a section, by its corners.
double RoomIn(const SupportPolygon& section, const Vector2d& p, const Vector2d& u) {
  double room = 1e9;
  for (int i = 0; i < section.size(); ++i) {
    const Vector2d edge = section.corner((i + 1) % section.size()) - section.corner(i);
    if (edge.norm() < 1e-9) continue;
    const Vector2d inward = Vector2d(-edge.y(), edge.x()).normalized();
    room = std::min(room, inward.dot(p - section.corner(i)) /
                              std::max(std::abs(inward.dot(u)), SoleSection::kAround));
  }
  return room;
}

TEST(SoleSection, IsTheOneWithMostRoom) {
  AskingRobot asking;
  AlgebraDraw draw(63);
  int inside = 0;
  double closest = 1.0;
  for (int i = 0; i < Draws(100); ++i) {
    const OnLevels soles = DrawOnLevels(&asking, &draw);
    const Pose2 left = soles.Sole(Side::kLeft), right = soles.Sole(Side::kRight);
    const auto zmps = soles.Zmps();
    const SoleSection widest = SoleSection::Widest(left, right, kSole, zmps);
    ASSERT_EQ(widest.room > 0.0, soles.Shadows().Margin() > 0.0);
    if (!(widest.room > 0.0)) continue;
    ++inside;
    const auto room_at = [&](double share, const Vector2d& u) {
      return RoomIn(SupportPolygon::Section(left, right, kSole, share),
                    (1.0 - share) * zmps[0] + share * zmps[1], u);
    };
    EXPECT_NEAR(room_at(widest.share, widest.along), widest.room, 1e-12);
    double most = 0.0;
    for (const Pose2& sole : {left, right}) {
      for (Eigen::Index axis = 0; axis < 2; ++axis) {
        for (int k = 0; k <= 200; ++k) {
          most = std::max(most, room_at(k / 200.0, sole.rotation().col(axis)));
        }
      }
    }
    EXPECT_LE(most, widest.room + 1e-12);
    closest = std::min(closest, most / widest.room);
  }
  EXPECT_GT(inside, Draws(100) / 4);
  EXPECT_GT(closest, 0.8);
}

TEST(SoleSection, HasTheSlopesOfDifferences) {
  AskingRobot asking;
  AlgebraDraw draw(64);
  int compared = 0, kinks = 0;
  for (int i = 0; i < Draws(400); ++i) {
    const OnLevels soles = DrawOnLevels(&asking, &draw);
    const std::array<Vector2d, 2> ways = {draw.Direction().head<2>(), draw.Direction().head<2>()};
    const auto at = [&](double h) {
      std::array<Vector2d, 2> zmps = soles.Zmps();
      for (size_t s = 0; s < 2; ++s) zmps[s] += h * ways[s];
      return SoleSection::Widest(soles.Sole(Side::kLeft), soles.Sole(Side::kRight), kSole, zmps);
    };
    constexpr double kStep = 1e-7;
    const SoleSection here = at(0.0);
    if (!(here.room > 1e-3)) continue;
    const double slope = here.normal.dot((1.0 - here.share) * ways[0] + here.share * ways[1]);
    const double forward = (at(kStep).room - here.room) / kStep,
                 backward = (here.room - at(-kStep).room) / kStep;
    ++compared;
    if (std::abs(forward - backward) > 1e-5) {
      ++kinks;
      continue;
    }
    EXPECT_NEAR(slope, 0.5 * (forward + backward), 1e-5);
  }
  EXPECT_GT(compared, Draws(400) / 4);
  EXPECT_LE(kinks, 1 + compared / 20);
}

// The two forces of the pressure, each at corners of both soles, are the floor's wrench, yaw moment
// included, and within the cone of the coefficient.
TEST(FootFriction, OnLevelsIsEnoughAtTheSolesCorners) {
  AskingRobot asking;
  AlgebraDraw draw(65);
  int compared = 0;
  double most = 0.0;
  for (int i = 0; i < Draws(300); ++i) {
    const OnLevels soles = DrawOnLevels(&asking, &draw);
    const auto friction = soles.Friction();
    ASSERT_EQ(friction.has_value(), soles.Shadows().Margin() > 0.0);
    if (!friction) continue;
    const SoleSection section =
        SoleSection::Widest(soles.Sole(Side::kLeft), soles.Sole(Side::kRight), kSole, soles.Zmps());
    if (section.room < 1e-3) continue;
    ++compared;
    const Vector6d& contact = soles.dynamics.contact();
    const Vector2d p = *soles.dynamics.Zmp(friction->height()), u = section.along;
    const Vector3d pole = Vector3d(p.x(), p.y(), friction->height()) - soles.dynamics.O();
    const Vector3d moment = contact.head<3>() - pole.cross(contact.tail<3>());
    EXPECT_LT(moment.head<2>().norm(), 1e-9 * contact.norm());
    Vector6d sum = Vector6d::Zero();
    for (const double sign : {-1.0, 1.0}) {
      Vector3d force = 0.5 * contact.tail<3>(), at = pole;
      at.head<2>() += sign * section.room * u;
      force.head<2>() += sign * moment.z() / (2.0 * section.room) * Vector2d(-u.y(), u.x());
      // Weights of the corners of either sole, and what they add up to.
      Eigen::MatrixXd A = Eigen::MatrixXd::Zero(5, 8);
      A.block<3, 4>(0, 0) = soles.Corners(Side::kLeft);
      A.block<3, 4>(0, 4) = soles.Corners(Side::kRight);
      A.block<1, 4>(3, 0).setOnes();
      A.block<1, 4>(4, 4).setOnes();
      Eigen::VectorXd b(5);
      b << at, 1.0 - section.share, section.share;
      const Eigen::VectorXd weights = NonNegativeLeastSquares(A, b);
      ASSERT_LT((A * weights - b).norm(), 1e-9);
      for (Eigen::Index k = 0; k < 8; ++k) {
        const Vector3d push = weights[k] * force, corner = A.block<3, 1>(0, k);
        EXPECT_LE(push.head<2>().norm(), (friction->needed() + 1e-9) * push.z());
        sum += Spatial(corner.cross(push), push);
      }
      most = std::max(most, force.head<2>().norm() / force.z() / friction->needed());
    }
    EXPECT_LT((sum - contact).norm(), 1e-7 * contact.norm());
  }
  EXPECT_GT(compared, Draws(300) / 4);
  EXPECT_GT(most, 0.99);
}

TEST(FootLoads, OnLevelsAddUpAndPutEachZmpAsFarFromItsSole) {
  AskingRobot asking;
  AlgebraDraw draw(66);
  int compared = 0;
  double without_rise = 0.0;
  for (int i = 0; i < Draws(500); ++i) {
    const OnLevels soles = DrawOnLevels(&asking, &draw);
    const auto loads = soles.Loads();
    ASSERT_TRUE(loads);
    const Vector6d& contact = soles.dynamics.contact();
    const std::array<Vector6d, 2> on = {loads->On(Side::kLeft, contact),
                                        loads->On(Side::kRight, contact)};
    EXPECT_LT((on[0] + on[1] - contact).norm(), 1e-10 * contact.norm());
    if (std::min(on[0][5], on[1][5]) < 1.0) continue;
    ++compared;
    // Each foot's own ZMP in the plane of its sole, from the sole's centre.
    std::array<Vector2d, 2> away;
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const Vector6d& w = on[static_cast<size_t>(Index(side))];
      const Vector2d zmp = soles.dynamics.O().head<2>() + Vector2d(-w[1], w[0]) / w[5] +
                           soles.heights.of(side) * w.segment<2>(3) / w[5];
      away[static_cast<size_t>(Index(side))] = zmp - soles.Sole(side).position();
    }
    EXPECT_LT((away[0] - away[1]).norm(), 1e-9);
    const double share = loads->share(Side::kRight);
    const Vector2d e =
        (1.0 - share) * (soles.ZmpAt(Side::kLeft) - soles.Sole(Side::kLeft).position()) +
        share * (soles.ZmpAt(Side::kRight) - soles.Sole(Side::kRight).position());
    EXPECT_LT((away[0] - e).norm(), 1e-9);
    // Control: the loads of one plane.
    const FootLoads flat = FootLoads::BothFeet(soles.Sole(Side::kLeft), soles.Sole(Side::kRight),
                                               kSole, *soles.dynamics.Zmp());
    without_rise = std::max(without_rise, (flat.On(Side::kLeft, contact) - on[0]).norm());
  }
  EXPECT_GT(compared, Draws(500) / 10);
  EXPECT_GT(without_rise, 10.0);
}

TEST(FootLoads, OnLevelsHaveTheSlopesOfDifferences) {
  AskingRobot asking;
  AlgebraDraw draw(67);
  int compared = 0, kinks = 0;
  for (int i = 0; i < Draws(300); ++i) {
    const OnLevels soles = DrawOnLevels(&asking, &draw);
    const auto loads = soles.Loads();
    const Vector6d& contact = soles.dynamics.contact();
    Vector6d slope;
    slope << 20 * draw.Direction(), 100 * draw.Direction();
    const auto at = [&](double h, Side side) -> Vector6d {
      const Vector6d w = contact + h * slope;
      std::array<Vector2d, 2> zmps;
      for (const Side of : {Side::kLeft, Side::kRight}) {
        zmps[static_cast<size_t>(Index(of))] = soles.dynamics.O().head<2>() +
                                               Vector2d(-w[1], w[0]) / w[5] +
                                               soles.heights.of(of) * w.segment<2>(3) / w[5];
      }
      return FootLoads::OnLevels(soles.x, soles.heights, kSole, zmps)->On(side, w);
    };
    for (const Side side : {Side::kLeft, Side::kRight}) {
      constexpr double kStep = 1e-6;
      const Vector6d analytic = loads->SlopeOn(
          side, contact, slope, soles.dynamics.ZmpSlope(slope, soles.heights.of(Side::kLeft)));
      const Vector6d forward = (at(kStep, side) - at(0, side)) / kStep,
                     backward = (at(0, side) - at(-kStep, side)) / kStep;
      ++compared;
      if ((forward - backward).norm() > 1e-2) {
        ++kinks;
        continue;
      }
      EXPECT_LT((analytic - 0.5 * (forward + backward)).norm(), 1e-4 * (1 + analytic.norm()));
    }
  }
  EXPECT_LE(kinks, compared / 20);
}

// A sole above the other: nothing says which of them carries.
TEST(FootLoads, OnLevelsAreRefusedWhereBothSolesHaveTheZmp) {
  AskingRobot asking;
  OnLevels soles{WalkState::Zero(),
                 {WalkState::Zero(), std::nullopt},
                 asking.That({.zmp = {0, 0}, .pull = {0, 0}, .turn = 0, .push = 400})};
  soles.x[kLeftZ] = 0.15;
  soles.x[kRightX] = 0.1;
  soles.heights = {soles.x, std::nullopt};
  EXPECT_FALSE(soles.Loads());
  soles.x[kRightX] = 0.12;  // 5 mm beside the right sole
  const auto loads = soles.Loads();
  ASSERT_TRUE(loads);
  EXPECT_EQ(loads->share(Side::kLeft), 1.0);
  EXPECT_TRUE(std::isfinite(loads->ShareDrift(0.0049)));
  EXPECT_TRUE(std::isinf(loads->ShareDrift(0.0051)));
}

}  // namespace
}  // namespace halfstep
