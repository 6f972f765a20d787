#include "wpg/robot/leg_motion_bound.h"

#include <algorithm>
#include <cmath>

#include "wpg/elementary.h"
#include "wpg/robot/bootstrap.h"

namespace halfstep {

using Eigen::Vector3d;
using Eigen::Vector4d;

LegAnchors::LegAnchors(const Leg& leg)
    : hip_B_(leg.hip_B), ankle_S_(leg.X_BSole.inverse() * leg.ankle_B) {
  // Seen from the sole, link 4 turns about axis 5 and link 3, carried by it, about axis 4.
  constexpr std::array<size_t, 6> kAxis = {0, 1, 2, 4, 5, 5}, kCarried = {1, 2, 2, 3, 3, 4};
  for (size_t i = 0; i < 6; ++i) {
    const Vector3d anchor = leg.AxisPoint(kAxis[i]);
    anchor_L_[i] = leg.joints[i].X_BLink.inverse() * anchor;
    to_next_[i] = (leg.AxisPoint(kAxis[kCarried[i]]) - anchor).norm();
  }
}

std::array<double, 6> LegAnchors::Levers(const RobotBody& body) const {
  const size_t link = static_cast<size_t>(body.link);
  std::array<double, 6> levers{};
  levers[link] = (body.shape.center - anchor_L_[link]).norm() + body.shape.radius;
  if (OnHip(body.link)) {
    for (size_t i = 0; i < link; ++i) levers[i] = to_next_[i];
  } else {
    for (size_t i = 5; i > link; --i) levers[i] = to_next_[i];
  }
  return levers;
}

namespace {

// Seen from the sole, at m unless said. The knee turns the hip by −q̇3·c; Ω and Θ are the angular
// velocities of shank and thigh.
struct Geometry {
  Geometry(const LegAnchors& anchors, const LegFrames& frames, const Vector6d& q_rate)
      : w(anchors.hip_B() - anchors.Ankle(frames)),
        k(frames.axis_B[3]),
        b(frames.axis_B[4]),
        a(frames.axis_B[5]),
        n(a.cross(b)),
        c(k.cross(anchors.hip_B() - frames.point_B[3])),
        kc(k.cross(c)),
        shank(-q_rate[5] * a - q_rate[4] * b),
        thigh(shank - q_rate[3] * k),
        w_rate(shank.cross(w) - q_rate[3] * c),
        D(n.dot(w)),
        speeds45(std::abs(q_rate[4]) + std::abs(q_rate[5])) {}

  Vector3d w, k, b, a, n, c, kc, shank, thigh, w_rate;
  double D, speeds45;
};

struct Knee {
  double speed, acceleration;
};

// With P cos ψ = ‖c‖² + w·(k×c) and P |sin ψ| = |w·c|: v = ½‖w‖² has v̇ = −q̇3·w·c.
std::optional<Knee> BoundKnee(const Geometry& g, double q_rate, double second, double h,
                              const LegRounding& off) {
  const double r = g.c.norm(), w = g.w.norm();
  const double of_sine = off.points * (r + w) + 2.0 * off.turn * r * w;
  const double sine = std::abs(g.w.dot(g.c)) - of_sine;
  const double cosine =
      std::abs(g.c.squaredNorm() + g.w.dot(g.kc)) + of_sine + 2.0 * r * (off.points + off.turn * r);
  if (!(sine > 0.0)) return std::nullopt;
  q_rate = std::abs(q_rate) + off.speeds[3];
  const double rate = q_rate * (sine + 2.0 * of_sine);
  const double change = h * (rate + 0.5 * h * second);
  const double least2 = sine * sine - change * (2.0 * cosine + change);
  if (!(least2 > 0.0)) return std::nullopt;
  const double least = std::sqrt(least2);
  const auto acceleration = [&](double speed) {
    return (second + (cosine + change) * speed * speed) / least;
  };
  Knee knee;
  knee.speed = (rate + h * second) / least;
  knee.speed = std::min(knee.speed, q_rate + h * acceleration(knee.speed));
  knee.acceleration = acceleration(knee.speed);
  return knee;
}

// What the ankle's bootstrap gives, for the hip: Θ̇ = q̈3·ε + rest.
struct Ankle {
  double acceleration4 = 0.0, acceleration5 = 0.0;
  double shank = 0.0;         // sup ‖Ω̇‖
  double thigh = 0.0;         // sup ‖Θ̇‖
  double rest = 0.0;          // sup of the rest
  double by_knee = 0.0;       // sup ‖ε‖
  double by_knee_rate = 0.0;  // sup ‖ε̇‖
  double by_knee_off = 0.0;   // of ε at m, by rounding
};

class AnkleBound {
 public:
  AnkleBound(const Geometry& geometry, const Knee& knee, const LegDemand& demand, double h,
             const LegRounding& off)
      : g_(geometry), knee_(knee), demand_(demand), h_(h), off_(off) {
    second_ = Hypot(demand.horizontal, demand.vertical);
    rate_ = g_.w_rate.norm() + h * second_ + off.point_speeds;
    distance_ = g_.w.norm() + h * rate_ + off.points;
    sigma_ = g_.n.norm();
    cosine_ = std::abs(g_.a.dot(g_.b));
    r_ = g_.c.norm() + off.points;
    // Seen from the shank, c turns about k: (b·c, b·(k×c)) keeps its norm.
    const double bc = std::abs(g_.b.dot(g_.c)), bkc = std::abs(g_.b.dot(g_.kc));
    const double b_most = Hypot(bc, bkc) + 2.0 * off.turn * r_ + 2.0 * off.points;
    const double turn = (h * knee.speed + 2.0 * off.turn) * b_most + 2.0 * off.points;
    bc_ = std::min(b_most, bc + turn);
    bkc_ = std::min(b_most, bkc + turn);
  }

  Vector3d ByKnee() const { return g_.n.cross(g_.c) / g_.D - g_.k; }

  // Given sups (|q̇4|, |q̇5|, ‖Ω‖, ‖Θ‖).
  std::optional<Ankle> Given(const Vector4d& s) const {
    const double s3 = knee_.speed, s4 = s[0], s5 = s[1], shank = s[2], thigh = s[3];
    // Directions and lengths are off at m by rounding, as if they had moved until there.
    const double e = 3.0 * off_.turn, p = 2.0 * off_.points;
    const double nw = g_.n.cross(g_.w).norm() + h_ * sigma_ * (s5 * distance_ + rate_) +
                      e * distance_ + p;  // ‖n×w‖
    const double D_rate = s5 * nw + std::abs(g_.n.dot(g_.w_rate)) +
                          h_ * sigma_ * (s5 * rate_ + second_) + e * rate_ + off_.point_speeds;
    const double D_off = e * distance_ + p, D = std::abs(g_.D) - h_ * D_rate - D_off;
    if (!(D > 0.0)) return std::nullopt;
    const double ac = std::min(r_, std::abs(g_.a.dot(g_.c)) + (h_ * thigh + e) * r_ + p);
    const double akc = std::min(r_, std::abs(g_.a.dot(g_.kc)) + (h_ * thigh + e) * r_ + p);
    const double nc = sigma_ * r_ * h_ * (thigh + s5) + std::abs(g_.n.dot(g_.c)) + 2.0 * e * r_ + p;
    const double b_turn = h_ * s5 * sigma_ + e;
    const double rest4 = (g_.a.head<2>().norm() + e) * demand_.horizontal +
                         (std::abs(g_.a.z()) + e) * demand_.vertical + 2.0 * s3 * s4 * nc +
                         s3 * s3 * akc + s4 * (shank + s5) * nw;
    const double rest5 = std::min(1.0, g_.b.head<2>().norm() + b_turn) * demand_.horizontal +
                         std::min(1.0, std::abs(g_.b.z()) + b_turn) * demand_.vertical +
                         2.0 * s3 * s5 * nc + s3 * s3 * bkc_ + s5 * (shank + s4) * nw;
    const double Q3 = knee_.acceleration;
    const double of_shank = Across(rest4, rest5) / D + s4 * s5 * sigma_;
    const double nxc = Across(ac, bc_) + e * r_;  // ‖n×c‖
    Ankle ankle;
    ankle.acceleration4 = (rest4 + Q3 * ac) / D;
    ankle.acceleration5 = (rest5 + Q3 * bc_) / D;
    ankle.shank = of_shank + Q3 * nxc / D;
    ankle.by_knee_rate = sigma_ * r_ * (s5 + thigh) / D + nxc * D_rate / (D * D) + shank;
    ankle.by_knee_off = (2.0 * e * r_ + p) / D + nxc * D_off / (D * D) + e;
    ankle.by_knee = ByKnee().norm() + h_ * ankle.by_knee_rate + ankle.by_knee_off;
    const double knee_turned =  // ‖Ω×k‖
        std::min(shank, g_.shank.cross(g_.k).norm() + h_ * ankle.shank + ShankOff() + e * shank);
    ankle.rest = of_shank + s3 * knee_turned;
    ankle.thigh = Q3 * ankle.by_knee + ankle.rest;
    return ankle;
  }

  // How far Ω, and Θ, may be off at m.
  double ShankOff() const {
    return off_.speeds[4] + off_.speeds[5] + 3.0 * off_.turn * g_.speeds45;
  }
  double ThighOff() const { return ShankOff() + off_.speeds[3] + 3.0 * off_.turn * knee_.speed; }

 private:
  // Norm of x·a + y·b with |x|, |y| bounded.
  double Across(double x, double y) const {
    return std::sqrt(x * x + y * y + 2.0 * cosine_ * x * y);
  }

  const Geometry& g_;
  const Knee& knee_;
  const LegDemand& demand_;
  double h_;
  const LegRounding& off_;
  double second_, rate_, distance_, sigma_, cosine_, r_, bc_, bkc_;
};

// q̈0 … q̈2 given sups (|q̇0|, |q̇1|, |q̇2|), from Γ̇ = q̈3·ε + rest, Γ the thigh's angular velocity
// seen from the waist.
class HipBound {
 public:
  HipBound(const LegFrames& frames, const Vector3d& by_knee, const Ankle& ankle, double knee,
           double rest, double yaw_rate, double h, double turn_off)
      : ankle_(ankle), knee_(knee), rest_(rest), h_(h) {
    const double e = 3.0 * turn_off;
    const auto& axis = frames.axis_B;
    rows_ = {axis[1].cross(axis[2]), axis[2].cross(axis[0]), axis[0].cross(axis[1])};
    for (size_t i = 0; i < 3; ++i) {
      norms_[i] = std::min(1.0, rows_[i].norm() + e);
      along_[i] = std::abs(rows_[i].dot(by_knee)) + e * ankle.by_knee + ankle.by_knee_off;
    }
    determinant_ = std::abs(rows_[2].dot(axis[2])) - 2.0 * e;
    determinant_rate_ = std::abs(rows_[2].dot(rows_[0])) + 2.0 * e;
    by_knee_rate_ = ankle.by_knee_rate + yaw_rate * ankle.by_knee;
  }

  std::optional<Vector3d> Given(const Vector3d& s) const {
    const double before = s[0] + s[1];  // of link 1
    const double turn = h_ * s[1];
    const double determinant =
        determinant_ - turn * (determinant_rate_ + 0.5 * turn * norms_[0] * norms_[2]);
    if (!(determinant > 0.0)) return std::nullopt;
    const double across = std::min(1.0, norms_[1] + h_ * before);  // ‖axis 2 × axis 0‖
    const std::array<double, 3> norms = {norms_[0], across, norms_[2]};
    const std::array<double, 3> row_rates = {before * norms_[0], before, s[0] * norms_[2]};
    const double rest = rest_ + s[0] * s[1] * norms_[2] + s[2] * (s[0] * across + s[1] * norms_[0]);
    Vector3d accelerations;
    for (size_t i = 0; i < 3; ++i) {
      const double along =
          std::min(norms[i] * ankle_.by_knee,
                   along_[i] + h_ * (row_rates[i] * ankle_.by_knee + norms[i] * by_knee_rate_));
      accelerations[static_cast<Eigen::Index>(i)] = (knee_ * along + norms[i] * rest) / determinant;
    }
    return accelerations;
  }

  double hip_sine() const { return norms_[2]; }

 private:
  const Ankle& ankle_;
  double knee_, rest_, h_;
  std::array<Vector3d, 3> rows_;
  std::array<double, 3> norms_, along_;
  double determinant_, determinant_rate_, by_knee_rate_;
};

}  // namespace

std::optional<JointBounds> BoundJoints(const LegAnchors& anchors, const LegFrames& frames,
                                       const Vector6d& speeds, double yaw_rate,
                                       const LegDemand& demand, double half_width,
                                       const LegRounding& off) {
  const double h = half_width;
  const Geometry g(anchors, frames, speeds);
  const auto knee = BoundKnee(g, speeds[3], demand.half_square, h, off);
  if (!knee) return std::nullopt;

  const AnkleBound ankle_bound(g, *knee, demand, h, off);
  Ankle ankle;
  const auto ankle_speeds = Bootstrap<Vector4d>(
      {std::abs(speeds[4]) + off.speeds[4], std::abs(speeds[5]) + off.speeds[5],
       g.shank.norm() + ankle_bound.ShankOff(), g.thigh.norm() + ankle_bound.ThighOff()},
      h, [&](const Vector4d& assumed) -> std::optional<Vector4d> {
        const auto given = ankle_bound.Given(assumed);
        if (!given) return std::nullopt;
        ankle = *given;
        return Vector4d(ankle.acceleration4, ankle.acceleration5, ankle.shank, ankle.thigh);
      });
  if (!ankle_speeds) return std::nullopt;

  // Seen from the waist, the thigh turns at Γ = yaw rate + Θ.
  const double rest = ankle.rest + demand.yaw_acceleration + demand.yaw_rate * (*ankle_speeds)[3];
  const HipBound hip_bound(frames, ankle_bound.ByKnee(), ankle, knee->acceleration, rest,
                           demand.yaw_rate, h, off.turn);
  Vector3d hip;
  const auto hip_speeds = Bootstrap<Vector3d>(speeds.head<3>().cwiseAbs() + off.speeds.head<3>(), h,
                                              [&](const Vector3d& assumed) {
                                                const auto given = hip_bound.Given(assumed);
                                                if (given) hip = *given;
                                                return given;
                                              });
  if (!hip_speeds) return std::nullopt;

  JointBounds bounds;
  bounds.speed << *hip_speeds, knee->speed, ankle_speeds->head<2>();
  bounds.acceleration << hip, knee->acceleration, ankle.acceleration4, ankle.acceleration5;
  const double thigh = knee->acceleration * ankle.by_knee + rest;
  const Vector3d& s = *hip_speeds;
  bounds.turns = {TurnBound{s[0], hip[0]},
                  {s[0] + s[1], hip[0] + hip[1] + s[0] * s[1] * hip_bound.hip_sine()},
                  {(g.thigh + yaw_rate * Vector3d::UnitZ()).norm() + h * thigh +
                       ankle_bound.ThighOff() + off.turn * std::abs(yaw_rate) + off.speeds.sum(),
                   thigh},
                  {(*ankle_speeds)[2], ankle.shank},
                  {(*ankle_speeds)[1], ankle.acceleration5},
                  {0.0, 0.0}};
  return bounds;
}

}  // namespace halfstep
