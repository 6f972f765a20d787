#pragma once

#include <Eigen/Core>
#include <vector>

#include "wpg/motion/half_step_sequence.h"

namespace halfstep {

/// A point of the smoothing homotopy of a sequence of n half-steps: three families of parameters.
struct HomotopyParameters {
  std::vector<double> overlaps;  ///< Δ_i [s] of junction i, between half-steps i and i+1 (n−1).
  std::vector<double> height_scales;  ///< η_j of step j: multiplies its via height (n/2).
  std::vector<double> durations;      ///< T_i of half-step i [s] (n).

  friend bool operator==(const HomotopyParameters&, const HomotopyParameters&) = default;
};

/// The planned motion, where the homotopy starts: Δ = 0, η = 1, T as planned.
HomotopyParameters PlannedMotion(const HalfStepSequence& sequence);

/// One parameter: its family and index there.
struct HomotopyParameter {
  enum class Family { kOverlap, kHeightScale, kDuration };
  Family family = Family::kOverlap;
  int index = 0;

  double& in(HomotopyParameters& parameters) const;
  friend bool operator==(const HomotopyParameter&, const HomotopyParameter&) = default;
};

/// Every parameter of a sequence, families in the order above.
std::vector<HomotopyParameter> AllParameters(const HalfStepSequence& sequence);

enum class JunctionKind { kUpDown, kDownUp };

/// Junction i leads from an up to a down half-step when i is even.
constexpr JunctionKind KindOfJunction(int junction) {
  return junction % 2 == 0 ? JunctionKind::kUpDown : JunctionKind::kDownUp;
}

/// Largest overlap of a junction for given durations [s]. Up→down: min(T − t2, t1), beyond which
/// the foot would go under the floor. Down→up: the shorter of the two durations, beyond which
/// half-steps would begin, or end, out of order.
double NaturalOverlapBound(const HalfStepSequence& sequence, const std::vector<double>& durations,
                           int junction);

/// Throws std::logic_error unless the sizes fit the sequence, all is finite, T > 0, η ≥ 0 and every
/// overlap lies in [0, its natural bound] (to 1e-12 s).
void CheckParameters(const HalfStepSequence& sequence, const HomotopyParameters& parameters);

}  // namespace halfstep
