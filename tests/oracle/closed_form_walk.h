#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/oracle/real.h"
#include "tests/oracle/rest_to_rest_closed_form.h"

namespace halfstep::oracle {

/// Place of a sole, in W [m, rad]; z: the height of the level that it stands on.
struct FloorPose {
  double x = 0, y = 0, yaw = 0, z = 0;
};

/// Feet: 0 left, 1 right, here and below.
struct PlannedStep {
  int foot = 0;
  FloorPose landing;
  double via_height = 0;  ///< above the support sole [m]
  double duration = 0;    ///< T of each half-step, as planned [s]
};

/// Everything that a walk follows from.
struct WalkPlan {
  std::array<FloorPose, 2> start;
  std::vector<PlannedStep> steps;
  double via_lateral = 0;             ///< [m]
  double shift = 0;                   ///< (t2 − t1)/T
  double foot_delay = 0;              ///< of T
  double bump_ramp = 1;               ///< of the ZMP's bump; 1: it is round
  double foot_ramp = 0.5;             ///< of the foot's horizontal motion
  double lift_share = 1;              ///< of the foot's flight
  double com_height = 0;              ///< z_c [m]
  double crouch = 0;                  ///< the waist is so far below where it stands [m]
  std::vector<double> overlaps;       ///< Δ_i [s]
  std::vector<double> height_scales;  ///< η_j
  std::vector<double> durations;      ///< T_i [s]
  /// Of step j: how far from the support sole's centre, along its y towards the other foot, CoM and
  /// ZMP rest [m].
  std::vector<double> support_points;
  /// Of step j [m], and of half-step i, in place of via_lateral and of the numbers above; empty:
  /// these.
  std::vector<double> via_laterals, foot_ramps, foot_delays, lift_shares;
  /// The same; and of step j, how far its via point is ahead of the support sole's centre [m].
  std::vector<double> zmp_shifts, zmp_bump_ramps, via_alongs;
  /// Of half-step i, as fractions of T_i next to the floor: from when until when the waist's height
  /// changes; empty: as below.
  std::vector<double> rise_begins, rise_ends;
  /// Of step j: its landing's place seen from where it is planned; empty: it is there.
  std::vector<FloorPose> footsteps;

  double via_lateral_of(size_t i) const {  ///< of half-step i
    return via_laterals.empty() ? via_lateral : via_laterals[i / 2];
  }
  double foot_ramp_of(size_t i) const { return foot_ramps.empty() ? foot_ramp : foot_ramps[i]; }
  double foot_delay_of(size_t i) const {  ///< of half-step i
    return foot_delays.empty() ? foot_delay : foot_delays[i];
  }
  FloorPose landing_of(size_t step) const {
    const FloorPose& planned = steps[step].landing;
    if (footsteps.empty()) return planned;
    const FloorPose& move = footsteps[step];
    const double c = std::cos(planned.yaw), s = std::sin(planned.yaw);
    return {planned.x + c * move.x - s * move.y, planned.y + s * move.x + c * move.y,
            planned.yaw + move.yaw, planned.z};
  }
  double shift_of(size_t i) const { return zmp_shifts.empty() ? shift : zmp_shifts[i]; }
  double bump_ramp_of(size_t i) const {  ///< of half-step i
    return zmp_bump_ramps.empty() ? bump_ramp : zmp_bump_ramps[i];
  }
  double via_along_of(size_t i) const { return via_alongs.empty() ? 0 : via_alongs[i / 2]; }
  double lift_share_of(size_t i) const { return lift_shares.empty() ? lift_share : lift_shares[i]; }
  double rise_begin_of(size_t i) const { return rise_begins.empty() ? 0.525 : rise_begins[i]; }
  double rise_end_of(size_t i) const { return rise_ends.empty() ? 1 : rise_ends[i]; }
};

/// The walk at one instant, in W [m, rad]; `rate` per second, `second` per second squared.
struct WalkState {
  struct Values {
    Eigen::Vector2d com, zmp;
    double waist_yaw = 0, waist_z = 0;    ///< z: above where the waist stands over the level 0
    std::array<Eigen::Vector4d, 2> feet;  ///< x, y, z, yaw
  };
  Values value, rate;
  Values second;  ///< its ZMP is not told: 0
};

/// A stretch of time between two neighbouring knots. What it says holds on [begin, end], both ends
/// included.
struct Stretch {
  double begin = 0, end = 0;  ///< [s]
  int in_air = -1;            ///< foot that is in the air, or −1
  bool moves = false;         ///< that foot is in its horizontal motion
  double lands_at = 0;        ///< height of the level where it will stand [m]
  /// The shortest time that a ZMP takes from foot to foot, of those that are on their way in it
  /// [s]; ∞: none is.
  double shift = std::numeric_limits<double>::infinity();
};

/// The superposed walk of smoothing/README.md, "The homotopy", from the readmes' formulas.
class ClosedFormWalk {
 public:
  /// Cutting a walk of thousands of half-steps takes minutes.
  explicit ClosedFormWalk(const WalkPlan& plan, bool with_stretches = true);
  double duration() const { return static_cast<double>(half_steps_.back().end); }  ///< [s]
  double start_of(int i) const {
    return static_cast<double>(half_steps_[static_cast<size_t>(i)].begin);
  }
  WalkState At(Real t) const;
  /// CoM x, y, ZMP x, y, waist's yaw, x, y, z and yaw of the left and the right sole, waist's z.
  using Quantities = std::array<Real, 14>;
  /// Value, rate and second of all quantities at t_k + τ, not rounded; no second of the ZMP.
  std::array<Quantities, 3> Exactly(int k, Real tau) const {
    return Exactly(half_steps_[static_cast<size_t>(k)].begin + tau);
  }
  /// At t_k + τ.
  WalkState At(int k, double tau) const {
    return At(half_steps_[static_cast<size_t>(k)].begin + static_cast<Real>(tau));
  }
  /// They cover [0, D]; none where they were not asked for.
  const std::vector<Stretch>& stretches() const { return stretches_; }

 private:
  std::array<Quantities, 3> Exactly(Real t) const;
  struct HalfStep {
    bool up = true;
    int swing = 0;
    Real begin = 0, end = 0, T = 0;
    Real sigma1 = 0, sigma2 = 0;                         // between which the ZMP shifts
    Real delay = 0, ramp = 0, share = 0, bump_ramp = 1;  // as the plan has them
    Real rise_begin = 0, rise_end = 1;                   // of T from its beginning
    double lands_at = 0;                                 // of the whole step
    Quantities from{}, change{};
    RestToRestClosedForm profile;
  };
  // Profiles of com, zmp, waist's yaw, foot, its height, waist's height, and their rates.
  struct Fractions {
    Real com = 0, zmp = 0, waist = 0, foot = 0, height = 0, rise = 0;
  };
  using Jet = std::array<Fractions, 3>;  // value, rate, second
  void Fractionize(const HalfStep& half_step, Real tau, Jet* jet) const;
  void CutIntoStretches();
  static Real Of(const Fractions& fractions, int quantity);

  std::vector<HalfStep> half_steps_;
  std::vector<Stretch> stretches_;
};

}  // namespace halfstep::oracle
