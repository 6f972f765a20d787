#pragma once

#include <array>
#include <vector>

#include "experiments/checker/profiles.h"
#include "experiments/checker/taylor.h"
#include "experiments/verify/walk_text.h"

namespace halfstep::checker {

/// What the tables of a run say of a walk.
struct WalkTables {
  std::vector<verify::FootstepRow> footsteps;   ///< both feet at the start, then those of the steps
  std::vector<verify::HalfStepRow> half_steps;  ///< two for each footstep, perhaps but for the last
  std::vector<Interval> starts;                 ///< t_i of each [s]; their rows' are not read
  verify::FormColumns planned;                  ///< form of half-steps whose row has none
  Interval com_height;                          ///< z_c of the pendulum [m]
  double crouch = 0.0;  ///< of footsteps that do not say it, and at the start [m]
};

/// Where the numbers of a walk stand: CoM x, y and ZMP x, y [m], the waist's yaw [rad], and of each
/// sole by Index(Side) x, y, z [m] and yaw [rad], in W; how much higher the waist is than where it
/// stands over soles at z = 0 [m].
enum WalkNumber : size_t {
  kCom = 0,
  kZmp = 2,
  kYaw = 4,
  kSole = 5,
  kWaistZ = 13,
  kNumWalkNumbers = 14
};
using WalkNumbers = std::array<Curve, kNumWalkNumbers>;  ///< as functions of time

/// The walk's motion, f(t) = f_0(0) + Σ_i [f_i(clamp(t − t_i, 0, T_i)) − f_i(0)].
/// Source: smoothing/README.md, "The homotopy"; wpg/README.md, "Half-step".
class WalkMotion {
 public:
  /// A foot in the air, from lift-off to landing, times rounded outwards [s].
  struct Flight {
    size_t side = 0;                          ///< Index(Side)
    double begin = 0.0, end = 0.0;            ///< closed
    double moves_from = 0.0, moves_to = 0.0;  ///< the foot may move horizontally between
    double landing = 0.0;                     ///< z of the sole after it [m]
    bool lands = true;  ///< else the walk ends with the foot in the air, as if over where it was
  };

  /// Throws InputError for tables that are of no walk.
  explicit WalkMotion(const WalkTables& tables);

  /// The walk that is cut after half-step `last`, counted from 0 (nothing else begins), from
  /// `from` [s] on. It knows the half-steps from the step before the one that lasts then, so it
  /// costs the same in any walk. Precondition: this one is whole, and `last` does not begin after
  /// `from` (std::logic_error).
  WalkMotion CutAfter(size_t last, double from) const;

  /// All numbers on [from, to].
  WalkNumbers On(double from, double to) const;
  double end() const { return steps_.back().end.hi; }              ///< from 0 [s]
  const std::vector<Flight>& flights() const { return flights_; }  ///< known ones in their order
  /// The known flight that an instant [s] is part of, or null. Of those that are apart.
  const Flight* FlightAt(double t) const;
  /// Of a known half-step: when it begins [s], how long its ZMP goes from foot to foot [s].
  std::array<Interval, 2> StartAndShift(size_t half_step) const;
  size_t first() const { return first_; }                 ///< known half-step; even
  size_t size() const { return first_ + steps_.size(); }  ///< n
  /// Since when a sole, by Index(Side), stands or stood before the flights that are known [s].
  double StandsSince(size_t side) const { return since_.front()[side]; }
  /// Between two neighbours everything is smooth and the same soles stand, but for rounding; from 0
  /// to end(), of a cut walk from its `from` on [s].
  const std::vector<double>& knots() const { return knots_; }

 private:
  using Rest = std::array<Interval, kNumWalkNumbers>;
  struct HalfStep {
    Interval start, duration, end, shift;
    size_t swing = 0;
    Profile yaw, way, height, rise;
    Pendulum pendulum;

    Interval At(const Interval& sigma) const { return start + sigma * duration; }
  };

  WalkMotion() = default;
  // Of the foot that an up half-step raises from where it stands, if it is not put down.
  static Flight FlightOf(const HalfStep& up, const Rest& before);
  void FindKnots();

  size_t first_ = 0;
  std::vector<HalfStep> steps_;
  std::vector<double> ended_;  // by when each and those before it have [s]
  std::vector<Rest> rests_;    // where half-step i begins; last: where the walk ends
  std::vector<Flight> flights_;
  std::vector<std::array<double, 2>> since_;  // StandsSince() before each flight
  std::vector<double> knots_;
};

}  // namespace halfstep::checker
