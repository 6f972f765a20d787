#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "planner/swept/swept_volumes.h"
#include "smoothing/walk/superposed_walk.h"

namespace halfstep {

/// The swept volume by which a half-step of a walk may be called free: that of an element of the
/// set, placed at the support sole.
struct PlacedVolume {
  int volume = 0;         ///< of down half-steps from 0, of up half-steps after all of them
  bool mirrored = false;  ///< on a right support: the mirror image
  Foothold X_WS;          ///< the support sole
};

/// By half-step of the walk; none for those that are in no set. Overlaps do not count: the volume
/// is that of the half-step from rest to rest.
std::vector<std::optional<PlacedVolume>> VolumesOf(const SuperposedWalk& walk,
                                                   const SweptVolumes& volumes);

/// The message `volumes` (experiments/server/README.md) of the walk with this index, from half-step
/// `first` on.
nlohmann::json VolumesMessage(const std::vector<std::optional<PlacedVolume>>& half_steps,
                              size_t walk, int first = 0);

/// The message `volume`, as cells, seen from a left support. Cells are merged while there are too
/// many for a picture. Precondition: VolumesOf() names the volume.
nlohmann::json VolumeMessage(int volume, const SweptVolumes& volumes);

}  // namespace halfstep
