#pragma once

#include <Eigen/Core>
#include <optional>

namespace halfstep {

/// A bound v of quantities |v(t)|, |t − m| ≤ h, whose rates are at most `rate(v)` as far as v
/// bounds them. Going outwards from m, v(m) + h·rate(assumed) would have to be passed before
/// `assumed` is: where it is below that, it holds. `rate` gives an optional vector, nothing where
/// it has no bound; its last call was with what was assumed of the result. Returns none where no
/// assumption holds. Source: smoothing/README.md, "Motion bounds".
template <typename Vector, typename Rate>
std::optional<Vector> Bootstrap(const Vector& at_midpoint, double h, const Rate& rate) {
  Vector assumed = at_midpoint;
  for (int attempt = 0; attempt < 8; ++attempt) {
    const std::optional<Vector> rates = rate(assumed);
    if (!rates) return std::nullopt;
    const Vector change = h * *rates;
    const Vector implied = at_midpoint + change;
    if (((1.0 + 0x1p-43) * implied.array() < assumed.array()).all()) return implied;  // rounded
    assumed = at_midpoint + 1.2 * change + Vector::Constant(1e-9);
  }
  return std::nullopt;
}

}  // namespace halfstep
