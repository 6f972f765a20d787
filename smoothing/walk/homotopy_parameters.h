#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "smoothing/walk/parameter_families.h"
#include "wpg/motion/half_step_sequence.h"

namespace halfstep {

/// A point of the smoothing homotopy of a sequence of n half-steps: the values of each family.
struct HomotopyParameters {
  // Of the families that algorithms name.
  /// Δ_i [s] of junction i, between half-steps i and i+1 (n−1). Below 0 it is a rest: half-step
  /// i+1 begins −Δ_i after half-step i has ended.
  std::vector<double> overlaps;
  std::vector<double> height_scales;  ///< η_j of step j: multiplies its via height (n/2).
  std::vector<double> durations;      ///< T_i of half-step i [s] (n).
  /// Support point of step j [m]: of both its half-steps, which share the support foot (n/2).
  std::vector<double> support_points;
  std::vector<double> zmp_shifts;  ///< shift of half-step i, as in its HalfStepShape (n)
  // Where the footstep of step j is, seen from where it is planned (n/2).
  std::vector<double> footstep_xs;    ///< [m]
  std::vector<double> footstep_ys;    ///< [m]
  std::vector<double> footstep_yaws;  ///< [rad]
  /// Of the other families, a value for each junction, step or half-step as the family's row says.
  ByParameterFamily<std::vector<double>> others;

  /// The values of a family.
  std::vector<double>& of(ParameterFamily family) {
    const auto named = Traits(family).values;
    return named != nullptr ? this->*named : others[family];
  }
  /// The same, to be read.
  const std::vector<double>& of(ParameterFamily family) const {
    const auto named = Traits(family).values;
    return named != nullptr ? this->*named : others[family];
  }

  friend bool operator==(const HomotopyParameters&, const HomotopyParameters&) = default;
};

/// The planned motion, where the homotopy starts: Δ = 0, or less where a rest is planned, η = 1,
/// all else as planned.
HomotopyParameters PlannedMotion(const HalfStepSequence& sequence);

/// One parameter: its family, and its index there from 0.
struct HomotopyParameter {
  using Family = ParameterFamily;    ///< see ParameterFamily
  Family family = Family::kOverlap;  ///< to which it belongs
  int index = 0;                     ///< in its family, from 0

  /// Its value in `parameters`.
  double& in(HomotopyParameters& parameters) const {
    return parameters.of(family).at(static_cast<size_t>(index));
  }
  /// The same, to be read.
  double in(const HomotopyParameters& parameters) const {
    return parameters.of(family).at(static_cast<size_t>(index));
  }
  friend bool operator==(const HomotopyParameter&, const HomotopyParameter&) = default;
};

/// Which parameters are meant; empty: all.
using ParameterFilter = std::function<bool(const HomotopyParameter&)>;
/// Rates along some parameters, each once.
using ParameterRates = std::vector<std::pair<HomotopyParameter, double>>;

/// Whether a junction leads from an up to a down half-step, or the other way.
enum class JunctionKind { kUpDown, kDownUp };

/// Junction i leads from an up to a down half-step when i is even.
constexpr JunctionKind KindOfJunction(int junction) {
  return junction % 2 == 0 ? JunctionKind::kUpDown : JunctionKind::kDownUp;
}

/// The natural bound of a junction's overlap is min(before·T_i, after·T_{i+1}) [s]. Up→down it is
/// min(T − t2, t1), with T and t2 of the up and t1 of the down half-step; beyond it the foot would
/// go under the floor. Down→up it is the shorter of the two durations; beyond it half-steps would
/// begin, or end, out of order. Source: smoothing/README.md, "Natural bounds".
struct NaturalBound {
  /// Fractions of the durations of the half-steps before and after the junction.
  double before = 1.0, after = 1.0;

  /// The bound [s] for the durations of both half-steps [s].
  double At(double T_before, double T_after) const;
};
/// The natural bound of junction `junction` between half-steps whose ZMPs shift in these fractions
/// of their durations (HalfStepShape::shift).
NaturalBound NaturalBoundOf(int junction, double shift_before, double shift_after);
/// The same at a point of the homotopy.
NaturalBound NaturalBoundOf(const HomotopyParameters& parameters, int junction);

/// The bound of a junction's overlap at a point of the homotopy [s].
double NaturalOverlapBound(const HomotopyParameters& parameters, int junction);

/// The least height scale of a step with which its via point is no lower than its two footsteps; so
/// high it has to be (smoothing/README.md, "The foot never goes below the floor"). 0 on flat
/// ground.
double LeastHeightScale(const HalfStepSequence& sequence, int step);

/// An overlap may exceed its natural bound by this and still counts as within it [s].
inline constexpr double kOverlapTolerance = 1e-12;
/// The robot rests no longer than this at a junction [s].
inline constexpr double kLongestRest = 3600.0;

/// Throws std::logic_error unless the sizes fit the sequence, all values are finite and between
/// `least` and `most` of their families (those of forms) or at least `least` (all), height scales
/// are at least LeastHeightScale, and no overlap exceeds its natural bound by more than
/// kOverlapTolerance.
void CheckParameters(const HalfStepSequence& sequence, const HomotopyParameters& parameters);

/// Lowers every overlap that is above its natural bound to it, and raises negative ones to 0 except
/// where `rests` rests, too.
void ClampOverlaps(const HomotopyParameters& rests, HomotopyParameters* parameters);

/// D = Σ T_i − Σ Δ_i [s].
double DurationOf(const HomotopyParameters& parameters);

}  // namespace halfstep
