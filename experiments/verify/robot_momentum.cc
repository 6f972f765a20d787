#include "experiments/verify/robot_momentum.h"

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>

#include "experiments/verify/robot_numbers.h"
#include "experiments/verify/robot_posture.h"
#include "experiments/verify/tolerances.h"

namespace halfstep::verify {
namespace {

constexpr std::array<double, 5> kSecond = {-205.0 / 72, 8.0 / 5, -1.0 / 5, 8.0 / 315, -1.0 / 560};

// Point masses that have a body's mass, centre and inertia, in its frame: two equal ones on each
// principal axis and one in the centre. A mass is negative where no rigid body has such an inertia;
// otherwise that in the centre is 0.
struct PointMasses {
  Eigen::Matrix<double, 3, 7> places;
  Eigen::Matrix<double, 7, 1> masses;
};

PointMasses PointMassesOf(const BodyMass& body) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(body.inertia);
  const Eigen::Vector3d moments = solver.eigenvalues();
  PointMasses points;
  int positive = 0;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const double square = 0.5 * moments.sum() - moments[k];  // ∫x² dm along the axis
    const Eigen::Vector3d away =
        std::sqrt(3 * std::abs(square) / body.mass) * solver.eigenvectors().col(k);
    points.places.col(2 * k) = body.com + away;
    points.places.col(2 * k + 1) = body.com - away;
    points.masses.segment<2>(2 * k).setConstant(square < 0.0 ? -body.mass / 6 : body.mass / 6);
    if (square >= 0.0) ++positive;
  }
  points.places.col(6) = body.com;
  points.masses[6] = body.mass / 3 * (6 - 2 * positive);
  return points;
}

}  // namespace

std::optional<RobotMomentum> RobotMomentum::Of(const RobotModel& robot, const WalkInstant& at,
                                               const std::array<Vector6d, 2>& near) {
  if (!robot.masses.known()) return std::nullopt;
  const double step = Tolerances(robot).momentum_step;
  const std::array<RobotPosture, 9> postures = PosturesAround(robot, at, step, near);
  for (const RobotPosture& posture : postures) {
    if (!posture.reached) return std::nullopt;
  }
  RobotMomentum all;
  const auto push_on = [&](const BodyMass& body, const auto& pose) {
    Push push;
    if (!(body.mass > 0)) return push;
    const PointMasses points = PointMassesOf(body);
    const Eigen::Matrix<double, 3, 7> here = pose(postures[4]) * points.places;
    Eigen::Matrix<double, 3, 7> a = kSecond[0] * here;
    for (size_t k = 1; k <= 4; ++k) {
      a += kSecond[k] *
           (pose(postures[4 + k]) * points.places + pose(postures[4 - k]) * points.places);
    }
    a /= step * step;
    for (Eigen::Index i = 0; i < 7; ++i) {
      const Eigen::Vector3d force =
          points.masses[i] * (a.col(i) + kGravity * Eigen::Vector3d::UnitZ());
      push.force += force;
      push.moment += here.col(i).cross(force);
    }
    all.floor.force += push.force;
    all.floor.moment += push.moment;
    return push;
  };
  push_on(robot.masses.waist, [](const RobotPosture& posture) { return posture.X_WB; });
  const RobotPosture& now = postures[4];
  for (size_t s = 0; s < 2; ++s) {
    for (size_t j = 0; j < 6; ++j) {
      all.links[s][j] = push_on(robot.masses.links[s][j],
                                [&](const RobotPosture& posture) { return posture.OfLink(s, j); });
      all.points[s][j] = now.X_WB * now.legs[s].points[j];
      all.axes[s][j] = now.X_WB.linear() * now.legs[s].axes[j];
    }
  }
  if (!(all.floor.force.z() > 0)) return std::nullopt;
  return all;
}

Eigen::Vector2d RobotMomentum::Zmp(double height) const {
  const Eigen::Vector3d moment = floor.About({0, 0, height});
  return Eigen::Vector2d(-moment.y(), moment.x()) / floor.force.z();
}

}  // namespace halfstep::verify
