#pragma once

#include <vector>

#include "smoothing/walk/parameter_families.h"
#include "wpg/motion/half_step_sequence.h"

namespace halfstep {

/// A point of the smoothing homotopy of a sequence of n half-steps: the values of each family.
struct HomotopyParameters {
  std::vector<double> overlaps;  ///< Δ_i [s] of junction i, between half-steps i and i+1 (n−1).
  std::vector<double> height_scales;  ///< η_j of step j: multiplies its via height (n/2).
  std::vector<double> durations;      ///< T_i of half-step i [s] (n).

  std::vector<double>& of(ParameterFamily family) { return this->*Traits(family).values; }
  const std::vector<double>& of(ParameterFamily family) const {
    return this->*Traits(family).values;
  }

  friend bool operator==(const HomotopyParameters&, const HomotopyParameters&) = default;
};

/// The planned motion, where the homotopy starts: Δ = 0, η = 1, T as planned.
HomotopyParameters PlannedMotion(const HalfStepSequence& sequence);

/// One parameter: its family and index there, from 0.
struct HomotopyParameter {
  using Family = ParameterFamily;
  Family family = Family::kOverlap;
  int index = 0;

  double& in(HomotopyParameters& parameters) const {
    return parameters.of(family).at(static_cast<size_t>(index));
  }
  double in(const HomotopyParameters& parameters) const {
    return parameters.of(family).at(static_cast<size_t>(index));
  }
  friend bool operator==(const HomotopyParameter&, const HomotopyParameter&) = default;
};

enum class JunctionKind { kUpDown, kDownUp };

/// Junction i leads from an up to a down half-step when i is even.
constexpr JunctionKind KindOfJunction(int junction) {
  return junction % 2 == 0 ? JunctionKind::kUpDown : JunctionKind::kDownUp;
}

/// The natural bound of a junction's overlap is min(before·T_i, after·T_{i+1}). Up→down: min(T −
/// t2, t1), beyond which the foot would go under the floor. Down→up: the shorter of the two
/// durations, beyond which half-steps would begin, or end, out of order.
struct NaturalBound {
  double before = 1.0, after = 1.0;

  /// [s], from both durations [s].
  double At(double T_before, double T_after) const;
};
/// Of the junction of that number between two half-steps of these shapes.
NaturalBound NaturalBoundOf(int junction, const HalfStepShape& before, const HalfStepShape& after);
NaturalBound NaturalBoundOf(const HalfStepSequence& sequence, int junction);

/// The bound of a junction for given durations [s].
double NaturalOverlapBound(const HalfStepSequence& sequence, const std::vector<double>& durations,
                           int junction);

/// Overlaps count as within their natural bound up to this [s].
inline constexpr double kOverlapTolerance = 1e-12;

/// Throws std::logic_error unless the sizes fit the sequence, all is finite, T > 0, η ≥ 0 and every
/// overlap lies in [0, its natural bound], to kOverlapTolerance.
void CheckParameters(const HalfStepSequence& sequence, const HomotopyParameters& parameters);

/// Lowers every overlap that is above its natural bound to it, and raises negative ones to 0.
void ClampOverlaps(const HalfStepSequence& sequence, HomotopyParameters* parameters);

/// D = Σ T_i − Σ Δ_i [s].
double DurationOf(const HomotopyParameters& parameters);

}  // namespace halfstep
