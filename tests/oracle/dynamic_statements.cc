// The oracle's statements about accelerations of joints, and about what the floor gives.
#include <cmath>

#include "tests/oracle/plain_soles.h"
#include "tests/oracle/walk_truth.h"

namespace halfstep::oracle {

const PlainDynamics& WalkTruth::DynamicsOf(Instant& at) const {
  if (!at.dynamics) at.dynamics.emplace(robot_, at.state, at.q, at.speed);
  return *at.dynamics;
}

// The wrench of the ground on one foot, as wpg/README.md has two feet share it: force, and moment
// about the place where the ground's moment on both is upright in the plane z = 0.
std::array<Eigen::Vector3d, 2> WalkTruth::FloorOn(size_t foot, Instant& at,
                                                  const Stretch& s) const {
  const PlainDynamics& dynamics = DynamicsOf(at);
  const Eigen::Vector3d moment(0, 0, dynamics.yaw_moment);
  if (s.in_air >= 0) {
    if (s.in_air == static_cast<int>(foot)) return {Eigen::Vector3d(0, 0, 0), {0, 0, 0}};
    return {dynamics.force, moment};
  }
  const auto& feet = at.state.value.feet;
  const bool level = demands_.forgets == ForgetsHeights::kInLoads;
  std::array<Eigen::Vector2d, 2> p;  // in the planes of the soles
  for (size_t i = 0; i < 2; ++i) p[i] = dynamics.zmp_at(level ? 0 : feet[i][2]);
  const double left = FromSole(feet[0], robot_.sole_size, p[0]);
  const double right = FromSole(feet[1], robot_.sole_size, p[1]);
  if (!(left + right > 0)) {
    return {Eigen::Vector3d::Constant(kNever), Eigen::Vector3d::Constant(kNever)};
  }
  const double lambda = left / (left + right), share = foot == 1 ? lambda : 1 - lambda;
  // Each foot's own ZMP is as far from its centre; yaw moments are shared in proportion.
  Eigen::Vector3d at_foot = feet[foot].head<3>();
  at_foot.head<2>() +=
      (1 - lambda) * (p[0] - feet[0].head<2>()) + lambda * (p[1] - feet[1].head<2>());
  if (level) at_foot.z() = 0;
  at_foot.head<2>() -= dynamics.zmp_in_world();
  Eigen::Vector3d turns = at_foot.cross(dynamics.force);
  turns.z() = dynamics.yaw_moment;
  return {share * dynamics.force, share * turns};
}

// Corners of the soles that stand, along the force onto a plane: seen from where the line of the
// ZMP meets it, which for each corner is where it passes the corner's height.
std::vector<Eigen::Vector2d> WalkTruth::SeenAlongForce(Instant& at, const Stretch& s) const {
  std::vector<Eigen::Vector2d> corners;
  for (size_t foot = 0; foot < 2; ++foot) {
    if (s.in_air == static_cast<int>(foot)) continue;
    const Eigen::Vector4d& place = at.state.value.feet[foot];
    const bool level = demands_.forgets == ForgetsHeights::kInShadows;
    const Eigen::Vector2d p = DynamicsOf(at).zmp_at(level ? 0 : place[2]);
    Eigen::Vector4d seen = place;
    seen.head<2>() -= p;
    for (const auto& c : SoleCorners(seen, robot_.sole_size)) corners.push_back(c);
  }
  return corners;
}

// The coefficient that suffices for a pressure of two points.
double WalkTruth::FrictionNeeded(Instant& at, const Stretch& s) const {
  const PlainDynamics& dynamics = DynamicsOf(at);
  const auto& feet = at.state.value.feet;
  const bool level =
      demands_.forgets == ForgetsHeights::kInFriction || std::abs(feet[0][2] - feet[1][2]) < 1e-10;
  double lever = 0;
  if (s.in_air < 0 && !level) {
    std::array<std::array<Eigen::Vector2d, 4>, 2> soles;
    for (size_t i = 0; i < 2; ++i) {
      Eigen::Vector4d seen = feet[i];
      seen.head<2>() -= dynamics.zmp_at(feet[i][2]);
      soles[i] = SoleCorners(seen, robot_.sole_size);
    }
    lever = LongestSectionLever(soles[0], soles[1]);
  } else {
    const double height = feet[s.in_air == 0 ? 1 : 0][2];
    lever = LongestLever(SupportCorners(at.state, s), dynamics.zmp_at(height));
  }
  if (!(lever > 0) || !(dynamics.force.z() > 0)) return kNever;
  return (dynamics.force.head<2>().norm() + std::abs(dynamics.yaw_moment) / lever) /
         dynamics.force.z();
}

void WalkTruth::AddDynamicStatements() {
  const double effort = robot_.mass * kGravity * 0.7 * robot_.size();  // [N m]
  statements_.push_back(
      {"zmp_robot", "", 20.0 * robot_.size(), [this](Instant& at, const Stretch& s) {
         if (!at.reaches || !(DynamicsOf(at).force.z() > 0)) return Exactly(-kNever);
         return Exactly(InsideHull(SeenAlongForce(at, s), {0, 0}));
       }});
  statements_.push_back({"friction", "", 20.0, [this](Instant& at, const Stretch& s) {
                           if (!at.reaches) return Exactly(-kNever);
                           return Exactly(demands_.friction - FrictionNeeded(at, s));
                         }});
  for (size_t leg = 0; leg < 2; ++leg) {
    for (size_t j = 0; j < 6; ++j) {
      const auto k = static_cast<Eigen::Index>(j);
      const auto& joint = robot_.joints[static_cast<size_t>(robot_.legs[leg].joints[j])];
      if (joint.effort < kNever) {
        statements_.push_back({"torque", joint.name, 40 * effort,
                               [this, &joint, leg, j](Instant& at, const Stretch& s) {
                                 if (!at.reaches || !(DynamicsOf(at).force.z() > 0))
                                   return Exactly(-kNever);
                                 const auto [force, moment] = FloorOn(leg, at, s);
                                 return Exactly(joint.effort - std::abs(DynamicsOf(at).Torque(
                                                                   leg, j, force, moment)));
                               },
                               true});
      }
      if (joint.acceleration < kNever) {
        statements_.push_back({"joint_acceleration", joint.name, 5000.0,
                               [this, &joint, leg, k](Instant& at, const Stretch&) {
                                 if (!at.reaches) return Exactly(-kNever);
                                 return Exactly(joint.acceleration -
                                                std::abs(DynamicsOf(at).acceleration[leg][k]));
                               }});
      }
    }
  }
}

}  // namespace halfstep::oracle
