#include "experiments/checker/robot_motion.h"

#include <algorithm>
#include <array>

#include "wpg/check.h"
#include "wpg/nth.h"

namespace halfstep::checker {
namespace {

constexpr size_t kMostFrames = 20'000;  // that are remembered

// The frame of x, y, z, and the rotation of a quaternion w, x, y, z of any length but 0.
template <typename T, typename Inverse>
FrameIn<T> FrameOfPose(const std::array<T, 7>& pose, const Inverse& inverse) {
  const auto& [px, py, pz, w, x, y, z] = pose;
  const T two = Interval(2.0) * inverse(w * w + x * x + y * y + z * z);
  const auto one_less = [&](const T& a, const T& b) { return T(1.0) - two * (a * a + b * b); };
  FrameIn<T> X;
  X.R = {VectorIn<T>{one_less(y, z), two * (x * y - w * z), two * (x * z + w * y)},
         VectorIn<T>{two * (x * y + w * z), one_less(x, z), two * (y * z - w * x)},
         VectorIn<T>{two * (x * z - w * y), two * (y * z + w * x), one_less(x, y)}};
  X.p = {px, py, pz};
  return X;
}

}  // namespace

RobotMotion::RobotMotion(const Trajectory& trajectory, const JointedRobot& robot)
    : curves_(trajectory),
      robot_(robot),
      curve_of_(robot.urdf().joints.size(), -1),
      slides_(curve_of_.size(), 0.0) {
  const std::vector<UrdfJoint>& joints = robot.urdf().joints;
  for (size_t j = 0; j < trajectory.joints.size(); ++j) {
    const auto named = std::ranges::find(joints, trajectory.joints[j], &UrdfJoint::name);
    HALFSTEP_CHECK(named != joints.end(), trajectory.joints[j]);
    const auto index = static_cast<size_t>(named - joints.begin());
    curve_of_[index] = static_cast<int>(j);
    if (!joints[index].slides) continue;
    const Interval all = curves_.Range(static_cast<int>(j), 0, curves_.begin(), curves_.end());
    slides_[index] = all.Magnitude();
  }
  if (trajectory.base.size() > 0) base_ = static_cast<int>(trajectory.joints.size());
}

std::vector<JointedRobot::Lever> RobotMotion::Levers(const JointedRobot::Body& body,
                                                     int link) const {
  std::vector<JointedRobot::Lever> levers = robot_.Levers(body, link, slides_);
  std::erase_if(levers,
                [this](const JointedRobot::Lever& lever) { return lever.joint < 0 && base_ < 0; });
  return levers;
}

const RobotMotion::Frames& RobotMotion::At(double t) {
  const auto known = frames_.find(t);
  if (known != frames_.end()) return known->second;
  if (frames_.size() > kMostFrames) frames_.clear();
  std::vector<Interval> q(curve_of_.size());
  for (size_t j = 0; j < q.size(); ++j) {
    if (curve_of_[j] >= 0) q[j] = curves_.Range(curve_of_[j], 0, t, t);
  }
  Frame X_WRoot;
  if (base_ >= 0) {
    std::array<Interval, 7> pose;
    for (int i = 0; i < 7; ++i) Nth(pose, i) = curves_.Range(base_ + i, 0, t, t);
    X_WRoot = FrameOfPose(pose, [](const Interval& x) { return Interval(1.0) / x; });
  }
  Frames frames{robot_.Frames(X_WRoot, q), {}};
  for (const Frame& X : frames.sure) frames.about.push_back(MiddleOf(X));
  return frames_.emplace(t, std::move(frames)).first->second;
}

// With p, q the quaternions at t and at another time, and θ the angle between both as vectors, the
// rotations differ by a turn of 2θ, which moves a point at a distance r by no more than 2r|sin θ|;
// and |p||sin θ| is how far p is from the line through q, so no more than |p − q|.
std::pair<double, double> RobotMotion::BaseMoved(double from, double to, double t) const {
  std::array<Interval, 2> squares;
  Interval length;
  for (int i = 0; i < 7; ++i) {
    const Interval there = curves_.Range(base_ + i, 0, from, to);
    const Interval here = curves_.Range(base_ + i, 0, t, t);
    const Interval off = std::max(there.FarthestFrom(here.lo), there.FarthestFrom(here.hi));
    Interval& sum = squares[i < 3 ? 0 : 1];
    sum = sum + Square(off);
    if (i >= 3) length = length + Square(here);
  }
  const Interval turned = Interval(2.0) * Sqrt(squares[1]) / Sqrt(length);
  return {Sqrt(squares[0]).hi, turned.hi};
}

double RobotMotion::Moved(const std::vector<JointedRobot::Lever>& levers, double from, double to,
                          double t) const {
  double sum = 0.0;
  for (const JointedRobot::Lever& lever : levers) {
    if (lever.joint < 0) {
      const auto [shift, turn] = BaseMoved(from, to, t);
      sum = Above(Above(sum + shift) + Above(turn * lever.reach));
      continue;
    }
    const int curve = CurveOf(lever.joint);
    if (curve < 0) continue;
    const Interval there = curves_.Range(curve, 0, from, to), here = curves_.Range(curve, 0, t, t);
    const double most = std::max(there.FarthestFrom(here.lo), there.FarthestFrom(here.hi));
    sum = Above(sum + Above(most * lever.reach));
  }
  return sum;
}

const FrameIn<Curve>& RobotMotion::On(int link, double from, double to) {
  auto known = on_.find({from, to});
  if (known == on_.end()) {
    if (on_.size() > kMostFrames / robot_.urdf().links.size()) on_.clear();
    known = on_.emplace(std::pair(from, to),
                        std::vector<std::optional<FrameIn<Curve>>>(robot_.urdf().links.size()))
                .first;
  }
  std::vector<std::optional<FrameIn<Curve>>>& frames = known->second;
  std::vector<int> chain;
  for (int at = link; !Nth(frames, at); at = robot_.JointOf(at).parent) {
    chain.push_back(at);
    if (Nth(robot_.urdf().links, at).joint < 0) break;
  }
  for (auto at = chain.rbegin(); at != chain.rend(); ++at) {
    const int joint = Nth(robot_.urdf().links, *at).joint;
    if (joint >= 0) {
      const int curve = CurveOf(joint);
      const Curve q = curve < 0 ? Curve(0.0) : curves_.On(curve, from, to);
      const UrdfJoint& moved = Nth(robot_.urdf().joints, joint);
      Nth(frames, *at) = JointedRobot::After(*Nth(frames, moved.parent), moved, q);
    } else if (base_ < 0) {
      Nth(frames, *at).emplace();
    } else {
      std::array<Curve, 7> pose;
      for (int i = 0; i < 7; ++i) Nth(pose, i) = curves_.On(base_ + i, from, to);
      Nth(frames, *at) = FrameOfPose(pose, [](const Curve& x) { return Inverse(x); });
    }
  }
  return *Nth(frames, link);
}

Eigen::Isometry3d MiddleOf(const Frame& X) {
  Eigen::Isometry3d middle = Eigen::Isometry3d::Identity();
  for (size_t i = 0; i < 3; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    for (size_t k = 0; k < 3; ++k) {
      middle.linear()(row, static_cast<Eigen::Index>(k)) = X.R[i][k].Middle();
    }
    middle.translation()[row] = X.p[i].Middle();
  }
  return middle;
}

Frame FrameOver(const FrameIn<Curve>& X, bool in_middle) {
  const auto part = [in_middle](const Curve& x) { return in_middle ? x.at[0] : x.over[0]; };
  Frame over;
  for (size_t i = 0; i < 3; ++i) {
    for (size_t k = 0; k < 3; ++k) over.R[i][k] = part(X.R[i][k]);
    over.p[i] = part(X.p[i]);
  }
  return over;
}

}  // namespace halfstep::checker
