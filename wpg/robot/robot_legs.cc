#include "wpg/robot/robot_legs.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "wpg/elementary.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"
#include "wpg/robot/leg_continuation.h"
#include "wpg/robot/leg_ik.h"
#include "wpg/robot/leg_neighbourhood.h"
#include "wpg/robot/met_leg.h"

namespace halfstep {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kMeeting = 1e-6;   // axes farther apart than this [m] do not meet
constexpr double kParallel = 1e-3;  // |sine| below which axes count as parallel
constexpr double kLever = 1e-3;     // least distance of hip and ankle from the knee axis [m]

std::string Millimetres(double metres) {
  return Formatted(metres < 1e-4 ? "%.4f mm" : "%.1f mm", metres * 1e3);
}

double AxisDistance(const LegJoint& a, const LegJoint& b) {
  const Vector3d between = b.point_B - a.point_B, across = a.axis_B.cross(b.axis_B);
  const double sine = across.norm();
  if (sine < 1e-9) return between.cross(a.axis_B).norm();
  return std::abs(between.dot(across)) / sine;
}

double DistanceToAxis(const LegJoint& joint, const Vector3d& point) {
  return (point - joint.point_B).cross(joint.axis_B).norm();
}

bool AreParallel(const LegJoint& a, const LegJoint& b) {
  return a.axis_B.cross(b.axis_B).norm() < kParallel;
}

class LegChecker {
 public:
  LegChecker(const UrdfTree& urdf, const std::array<int, 6>& indices, Complaints* complaints)
      : urdf_(urdf), indices_(indices), complaints_(complaints) {}

  bool ok() const { return ok_; }

  void Complain(size_t joint, const std::string& what) {
    const UrdfJoint& at = Nth(urdf_.joints, indices_[joint]);
    complaints_->Add(urdf_.file, at.place.line, at.place.column, at.name, what);
    ok_ = false;
  }

  // The point nearest to the axes `first` … `first + count − 1`. Tells the leg which of them miss
  // each other.
  Vector3d NearestPointOf(Leg* leg, size_t first, size_t count, const std::string& which) {
    std::vector<const LegJoint*> joints;
    std::vector<Vector3d> axes, points;
    for (size_t i = first; i < first + count; ++i) {
      joints.push_back(&leg->joints[i]);
      axes.push_back(joints.back()->axis_B);
      points.push_back(joints.back()->point_B);
    }
    std::string misses;
    const auto miss = [&misses](const std::string& what) {
      misses += (misses.empty() ? "" : ", ") + what;
    };
    for (size_t i = 0; i < count; ++i) {
      for (size_t k = i + 1; k < count; ++k) {
        const double distance = AxisDistance(*joints[i], *joints[k]);
        if (distance > kMeeting) {
          miss(which + " axes " + joints[i]->name + " and " + joints[k]->name +
               " pass each other at " + Millimetres(distance));
        }
      }
      if (i > 0 && AreParallel(*joints[i - 1], *joints[i])) {
        Complain(first + i, which + " axes " + joints[i - 1]->name + " and " + joints[i]->name +
                                " are parallel: they cannot turn the foot every way");
      }
    }
    const Vector3d point = NearestPoint(axes, points, std::vector<double>(count, 1.0));
    for (size_t i = 0; i < count && misses.empty() && ok_; ++i) {
      const double distance = DistanceToAxis(*joints[i], point);
      if (distance > kMeeting) {
        miss(which + " axes meet in pairs but not in one point: " + joints[i]->name +
             " misses it by " + Millimetres(distance));
      }
    }
    if (!misses.empty()) leg->offsets += (leg->offsets.empty() ? "" : ", ") + misses;
    return point;
  }

 private:
  const UrdfTree& urdf_;
  const std::array<int, 6>& indices_;
  Complaints* complaints_;
  bool ok_ = true;
};

// Whether the leg provably follows its sole by 1 mm any way from the standing posture: the least
// that intervals of a walk ask of it.
bool CanFollow(const Leg& leg) {
  constexpr double kLeast = 0.001;  // [m]
  const auto near = LegNeighbourhood::Around(leg, leg.standing_q);
  return near && near->Ways(near->Asked(0.0, kLeast)) && ContinueLeg(leg, near->X_BSole()).arrived;
}

}  // namespace

std::optional<std::array<int, 6>> FindLegJoints(const UrdfTree& urdf, int waist, int foot,
                                                Complaints* complaints) {
  const UrdfLink& foot_link = Nth(urdf.links, foot);
  std::vector<int> found;
  bool ok = true;
  for (int link = foot; link != waist;) {
    const int index = Nth(urdf.links, link).joint;
    if (index < 0) {
      complaints->Add(urdf.file, foot_link.place.line, foot_link.place.column, foot_link.name,
                      "does not hang on " + Nth(urdf.links, waist).name);
      return std::nullopt;
    }
    const UrdfJoint& joint = Nth(urdf.joints, index);
    if (!joint.faults.empty()) {
      complaints->Add(joint.faults);
      ok = false;
    } else if (joint.kind == UrdfJoint::Kind::kOther) {
      complaints->Add(urdf.file, joint.place.line, joint.place.column, joint.name,
                      "a leg's joint must be revolute, with limits, or fixed");
      ok = false;
    }
    if (joint.kind != UrdfJoint::Kind::kFixed) found.push_back(index);
    link = joint.parent;
  }
  if (ok && found.size() != 6) {
    complaints->Add(
        urdf.file, foot_link.place.line, foot_link.place.column, foot_link.name,
        "is " + std::to_string(found.size()) + " revolute joints away from the waist (valid: 6)");
    ok = false;
  }
  if (!ok) return std::nullopt;
  std::array<int, 6> joints;
  std::copy(found.rbegin(), found.rend(), joints.begin());
  return joints;
}

double StretchedLength(const Leg& leg) {
  const LegJoint& knee = leg.joints[3];
  return DistanceToAxis(knee, leg.hip_B) + DistanceToAxis(knee, leg.ankle_B);
}

double LengthOfLeg(const Leg& leg) {
  return StretchedLength(leg) + (leg.X_BSole.inverse() * leg.ankle_B).z();
}

std::optional<Leg> LegGeometry(const UrdfTree& urdf, const LegRequest& request,
                               const std::array<int, 6>& indices, Complaints* complaints) {
  const std::vector<Isometry3d> X = urdf.LinkPoses(std::vector<double>(urdf.joints.size(), 0.0));
  const Isometry3d X_BRoot = Nth(X, request.waist).inverse();
  Leg leg;
  for (size_t i = 0; i < 6; ++i) {
    const int index = indices[i];
    const UrdfJoint& joint = Nth(urdf.joints, index);
    LegJoint& out = leg.joints[i];
    out.name = joint.name;
    out.X_BLink = X_BRoot * Nth(X, joint.child);
    out.axis_B = (out.X_BLink.linear() * joint.axis).normalized();
    out.point_B = out.X_BLink.translation();
    out.lower = Nth(request.lower, index);
    out.upper = Nth(request.upper, index);
    if (out.upper - out.lower > 2.0 * std::numbers::pi + 1e-9) {
      complaints->Add(urdf.file, joint.place.line, joint.place.column, joint.name,
                      "its limits are more than a turn apart (valid: at most 360 deg, where need "
                      "be by joint_limits_deg of the robot file)");
      return std::nullopt;
    }
    out.max_speed = joint.max_speed;
    out.max_torque = Nth(request.torque, index);
    out.max_acceleration = Nth(request.acceleration, index);
    leg.standing_q[static_cast<Eigen::Index>(i)] = Nth(request.posture, index);
  }
  leg.X_BSole = X_BRoot * Nth(X, request.foot) * request.X_FootSole;

  LegChecker check(urdf, indices, complaints);
  leg.hip_B = check.NearestPointOf(&leg, 0, 3, "hip");
  leg.ankle_B = check.NearestPointOf(&leg, 4, 2, "ankle");
  const LegJoint& knee = leg.joints[3];
  for (const auto& [point, which] :
       {std::pair{leg.hip_B, "hip"}, std::pair{leg.ankle_B, "ankle"}}) {
    const double lever = DistanceToAxis(knee, point);
    if (check.ok() && lever < kLever) {
      check.Complain(3, std::string("the knee axis passes the ") + which + " at " +
                            Millimetres(lever) + ": it cannot change the leg's length");
    }
  }
  if (!check.ok()) return std::nullopt;
  return leg;
}

std::optional<Leg> BuildLeg(const UrdfTree& urdf, const LegRequest& request,
                            const std::array<int, 6>& indices, Complaints* complaints) {
  std::optional<Leg> leg = LegGeometry(urdf, request, indices, complaints);
  if (!leg) return std::nullopt;
  const double length = StretchedLength(*leg);
  if (std::abs(LegJacobian(*leg, leg->standing_q).determinant()) <
      1e-4 * length * length * length) {
    LegChecker(urdf, indices, complaints)
        .Complain(3,
                  "the leg is singular in the standing posture (knee stretched, or hip or "
                  "ankle axes aligned): bend it there");
    return std::nullopt;
  }
  if (leg->offsets.empty()) {
    leg->branch = LegBranchOf(*leg, leg->standing_q);
    return leg;
  }
  leg->met.push_back(WithAxesThatMeet(*leg));
  if (!CanFollow(*leg)) {
    LegChecker(urdf, indices, complaints)
        .Complain(2, leg->offsets +
                         "; so there is no closed form for the leg's joints, and in the standing "
                         "posture it is too near to a singularity for a proof without: bend it "
                         "more there");
    return std::nullopt;
  }
  return leg;
}

namespace {

// A joint's range as the mirrored joint on the other side has it. A mirror turns rotations round:
// angles keep their sign where the axis changes its own.
std::array<double, 2> MirroredRange(const LegJoint& joint, const LegJoint& other) {
  const bool same_sign =
      Vector3d(joint.axis_B.x(), -joint.axis_B.y(), joint.axis_B.z()).dot(other.axis_B) < 0;
  if (same_sign) return {joint.lower, joint.upper};
  return {-joint.upper, -joint.lower};
}

}  // namespace

std::vector<std::string> MirrorDifferences(const Leg& left, const Leg& right, double tolerance) {
  constexpr double kDegree = std::numbers::pi / 180;
  const Eigen::DiagonalMatrix<double, 3> mirror(1, -1, 1);
  std::vector<std::string> differences;
  const auto tell = [&](const std::string& what, double size, const std::string& text) {
    if (size > tolerance) differences.push_back(what + " by " + text);
  };
  for (const auto& [what, l, r] : {std::tuple{"hip", left.hip_B, right.hip_B},
                                   std::tuple{"ankle", left.ankle_B, right.ankle_B}}) {
    const double apart = (mirror * l - r).norm();
    tell(what, apart, Millimetres(apart));
  }
  for (size_t i = 0; i < 6; ++i) {
    const LegJoint &l = left.joints[i], &r = right.joints[i];
    const double turned = Asin(std::min(1.0, (mirror * l.axis_B).cross(r.axis_B).norm()));
    tell("the axis of " + r.name, turned, Formatted("%.3g deg", turned / kDegree));
    const double off = DistanceToAxis(r, mirror * l.point_B);
    tell("the place of " + r.name, off, Millimetres(off));
    const auto [lower, upper] = MirroredRange(l, r);
    const double range = std::max(std::abs(lower - r.lower), std::abs(upper - r.upper));
    tell("the limits of " + r.name, range, Formatted("%.3g deg", range / kDegree));
    const double speed = std::abs(l.max_speed - r.max_speed);
    tell("the speed limit of " + r.name, speed, Formatted("%.3g rad/s", speed));
    const auto tell_limit = [&](const char* what, double of_left, double of_right,
                                const char* format) {
      if (of_left == of_right) return;  // both may be unknown: infinite
      const double apart = std::abs(of_left - of_right);
      const std::string whose = std::string("the ") + what + " limit of " + r.name;
      if (std::isfinite(apart)) {
        tell(whose, apart, Formatted(format, apart));
      } else {
        differences.push_back(whose + ", which is known of one side only");
      }
    };
    tell_limit("torque", l.max_torque, r.max_torque, "%.3g N m");
    tell_limit("acceleration", l.max_acceleration, r.max_acceleration, "%.3g rad/s²");
  }
  return differences;
}

}  // namespace halfstep
