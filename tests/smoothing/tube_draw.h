#pragma once

#include <algorithm>

#include "smoothing/margins/tube.h"
#include "tests/smoothing/test_walks.h"
#include "wpg/geometry/rotation.h"
#include "wpg/motion/posture.h"
#include "wpg/nth.h"

namespace halfstep {

/// Postures anywhere in a tube around a planned one, by forward kinematics from waist and joints.
class TubeDraw {
 public:
  TubeDraw(const RobotModel& robot, const Tube& tube, unsigned seed)
      : robot_(robot), tube_(tube), draw_(seed) {}

  /// Draws errors of waist and joints, at the ends of their ranges half of the time, and goes from
  /// `plan` towards them as far as the soles stay in the tube: at half of the draws each foot, and
  /// not the waist, is where they are drawn. Precondition: the legs of `plan` are solved.
  Posture Near(const Posture& plan) {
    const Errors errors = DrawErrors(plan);
    double inside = 0.0, outside = 1.0;
    if (IsWithin(Displaced(plan, errors, 1.0), plan)) return Displaced(plan, errors, 1.0);
    for (int i = 0; i < 30; ++i) {
      const double middle = 0.5 * (inside + outside);
      (IsWithin(Displaced(plan, errors, middle), plan) ? inside : outside) = middle;
    }
    return Displaced(plan, errors, inside);
  }
  /// A number in [−1, 1], one of the ends half of the time.
  double Part() {
    const double x = draw_.Uniform(-1, 1);
    return draw_.Uniform(0, 1) < 0.5 ? x : (x < 0 ? -1.0 : 1.0);
  }
  /// A vector of length ≤ 1, or of just 1 half of the time.
  Eigen::Vector3d InBall() {
    Eigen::Vector3d v;
    do {
      v = {draw_.Uniform(-1, 1), draw_.Uniform(-1, 1), draw_.Uniform(-1, 1)};
    } while (v.norm() > 1.0 || v.norm() < 1e-3);
    return draw_.Uniform(0, 1) < 0.5 ? v : Eigen::Vector3d(v.normalized());
  }
  WalkDraw& draw() { return draw_; }

 private:
  struct Errors {
    std::array<Vector6d, 2> q;
    int base = -1;  // −1: the waist is moved by shift and turn, else the sole of that side
    Eigen::Vector3d shift, axis;
    double turn = 0.0;
  };

  Errors DrawErrors(const Posture&) {
    Errors errors;
    for (Vector6d& q : errors.q) {
      for (int j = 0; j < 6; ++j) q[j] = tube_.joint * Part();
    }
    errors.base = draw_.Uniform(0, 1) < 0.5 ? -1 : (draw_.Uniform(0, 1) < 0.5 ? 0 : 1);
    errors.shift = (errors.base < 0 ? tube_.waist : tube_.foot) * InBall();
    errors.axis = InBall().normalized();
    errors.turn = (errors.base < 0 ? tube_.waist_turn : tube_.foot_turn) * Part();
    return errors;
  }

  static Eigen::Isometry3d Moved(Eigen::Isometry3d X, const Errors& errors, double part) {
    X.translation() += part * errors.shift;
    X.linear() = (AxisRotation(part * errors.turn, errors.axis) * X.linear()).eval();
    return X;
  }

  Posture Displaced(const Posture& plan, const Errors& errors, double part) const {
    Posture moved = plan;
    for (size_t s = 0; s < 2; ++s) {
      moved.ik[s].q += part * errors.q[s];
      moved.frames[s] = PlaceLeg(robot_.legs[s], moved.ik[s].q);
    }
    if (errors.base < 0) {
      moved.X_WB = Moved(plan.X_WB, errors, part);
    } else {
      const auto s = static_cast<size_t>(errors.base);
      moved.X_WB = Moved(plan.X_WLink[s][6], errors, part) * moved.frames[s].X_BLink[6].inverse();
    }
    for (size_t s = 0; s < 2; ++s) {
      for (size_t i = 0; i < 7; ++i) {
        moved.X_WLink[s][i] = moved.X_WB * moved.frames[s].X_BLink[i];
      }
      moved.X_WSole[s] = moved.X_WLink[s][6];
    }
    return moved;
  }

  static bool IsNear(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double shift,
                     double turn) {
    constexpr double kRounding = 1e-12;
    return (a.translation() - b.translation()).norm() <= shift + kRounding &&
           AngleOf(a.linear() * b.linear().transpose()) <= turn + kRounding;
  }
  bool IsWithin(const Posture& moved, const Posture& plan) const {
    bool within = IsNear(moved.X_WB, plan.X_WB, tube_.waist, tube_.waist_turn);
    for (size_t s = 0; s < 2; ++s) {
      within =
          within && IsNear(moved.X_WLink[s][6], plan.X_WLink[s][6], tube_.foot, tube_.foot_turn);
    }
    return within;
  }

  const RobotModel& robot_;
  Tube tube_;
  WalkDraw draw_;
};

}  // namespace halfstep
