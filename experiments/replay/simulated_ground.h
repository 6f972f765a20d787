#pragma once

#include <vector>

#include "wpg/ground/ground.h"

namespace halfstep::replay {

/// The ground of a scene, as far as something may touch it. By default the plane z = 0.
struct SimulatedGround {
  bool floor = true;                ///< whether the plane z = 0 bears; it is endless
  std::vector<GroundSolid> solids;  ///< prisms at rest: soles stand on them, bodies touch them

  /// Whether it is something else than the plane z = 0.
  bool uneven() const { return !floor || !solids.empty(); }
};

}  // namespace halfstep::replay
