#include "experiments/checker/trajectory.h"

#include <algorithm>
#include <cmath>

#include "wpg/files/input_error.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"

namespace halfstep::checker {
namespace {

constexpr double kMost = 1e6;  // of positions [rad, m] and their derivatives

[[noreturn]] void Fail(const std::string& file, const std::string& what) {
  throw InputError({file + ": " + what});
}

}  // namespace

const char* Name(Interpolation interpolation) {
  switch (interpolation) {
    case Interpolation::kLinear:
      return "linear";
    case Interpolation::kCubic:
      return "cubic";
    case Interpolation::kQuintic:
      return "quintic";
  }
  return "";
}

JointNames NamesOf(const UrdfTree& urdf) {
  JointNames names;
  for (const UrdfJoint& joint : urdf.joints) {
    if (joint.moves()) {
      names.moving.push_back(joint.name);
    } else if (joint.kind == UrdfJoint::Kind::kOther || !joint.faults.empty()) {
      names.others.push_back(joint.name);
    }
  }
  return names;
}

void SetBase(Eigen::MatrixXd poses, Trajectory* trajectory) {
  for (Eigen::Index k = 0; k < poses.cols(); ++k) {
    const double length = poses.col(k).tail<4>().norm();
    if (!(poses.col(k).cwiseAbs().maxCoeff() <= kMost && std::abs(length - 1.0) <= 0.01)) {
      Fail(trajectory->file, Formatted("base: knot %d: is no pose (valid: metres within 1e6, and a "
                                       "quaternion of length 1)",
                                       static_cast<int>(k + 1)));
    }
    const bool same = k == 0 || poses.col(k).tail<4>().dot(poses.col(k - 1).tail<4>()) >= 0.0;
    poses.col(k).tail<4>() /= same ? length : -length;
  }
  trajectory->base = std::move(poses);
}

void SetBaseVelocities(Eigen::MatrixXd velocities, Trajectory* trajectory) {
  for (Eigen::Index k = 0; k < velocities.cols(); ++k) {
    for (const double v : velocities.col(k)) {
      if (std::abs(v) <= kMost) continue;  // no NaN
      Fail(trajectory->file, Formatted("base: knot %d: its velocity is no number (valid: within "
                                       "1e6)",
                                       static_cast<int>(k + 1)));
    }
  }
  trajectory->base_v = std::move(velocities);
}

void CheckNumbers(const Trajectory& trajectory, const JointNames& names) {
  const std::string& file = trajectory.file;
  const std::vector<double>& times = trajectory.times;
  if (times.size() < 2) Fail(file, "fewer than two knots");
  for (size_t k = 0; k < times.size(); ++k) {
    if (!std::isfinite(times[k]) || (k > 0 && !(times[k] > times[k - 1]))) {
      Fail(file, Formatted("knot %zu: time %g s (valid: growing times)", k + 1, times[k]));
    }
  }
  if (trajectory.joints.empty()) {
    Fail(file, "names no joint of the robot (valid: " + Joined(names.moving) + ")");
  }
  for (size_t j = 0; j < trajectory.joints.size(); ++j) {
    const std::string& joint = trajectory.joints[j];
    if (std::ranges::find(names.moving, joint) == names.moving.end()) {
      Fail(file, joint +
                     ": is no joint that turns or slides, or its axis or limits are missing "
                     "in the URDF (valid: " +
                     Joined(names.moving) + ")");
    }
    if (std::ranges::count(trajectory.joints, joint) > 1) Fail(file, joint + ": is told twice");
    for (const Eigen::MatrixXd* numbers : {&trajectory.q, &trajectory.v, &trajectory.a}) {
      for (Eigen::Index k = 0; numbers->size() > 0 && k < numbers->cols(); ++k) {
        if (std::abs((*numbers)(static_cast<Eigen::Index>(j), k)) <= kMost) continue;  // no NaN
        Fail(file, joint + Formatted(": knot %d: is no number (valid: within 1e6)",
                                     static_cast<int>(k + 1)));
      }
    }
  }
}

void SetInterpolation(const std::optional<Interpolation>& chosen, Trajectory* trajectory) {
  const bool v = trajectory->v.size() > 0, a = trajectory->a.size() > 0;
  trajectory->interpolation = chosen.value_or(v && a ? Interpolation::kQuintic
                                              : v    ? Interpolation::kCubic
                                                     : Interpolation::kLinear);
  if (chosen == Interpolation::kLinear) trajectory->base_v.resize(0, 0);
  const bool enough = trajectory->interpolation == Interpolation::kLinear ||
                      (v && (a || trajectory->interpolation == Interpolation::kCubic));
  if (enough) return;
  Fail(trajectory->file, std::string("--interpolation ") + Name(trajectory->interpolation) +
                             ": the file has no " + (v ? "accelerations" : "velocities") +
                             " (valid: " + (v ? "linear, cubic)" : "linear)"));
}

}  // namespace halfstep::checker
