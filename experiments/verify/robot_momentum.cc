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

using Points = Eigen::Matrix<double, 3, 6>;

// Six equal point masses on the principal axes of a body, in its frame.
Points PointsOf(const BodyMass& body) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(body.inertia);
  const Eigen::Vector3d moments = solver.eigenvalues();
  Points points;
  for (Eigen::Index k = 0; k < 3; ++k) {
    // ∫x² dm along the axis; negative where no body has such an inertia.
    const double square = 0.5 * moments.sum() - moments[k];
    const Eigen::Vector3d away = std::sqrt(3 * square / body.mass) * solver.eigenvectors().col(k);
    points.col(2 * k) = body.com + away;
    points.col(2 * k + 1) = body.com - away;
  }
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
    const Points points = PointsOf(body);
    const Points here = pose(postures[4]) * points;
    Points a = kSecond[0] * here;
    for (size_t k = 1; k <= 4; ++k) {
      a += kSecond[k] * (pose(postures[4 + k]) * points + pose(postures[4 - k]) * points);
    }
    a /= step * step;
    for (Eigen::Index i = 0; i < 6; ++i) {
      const Eigen::Vector3d force =
          body.mass / 6 * (a.col(i) + kGravity * Eigen::Vector3d::UnitZ());
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
