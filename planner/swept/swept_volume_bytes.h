#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/swept/box_tree.h"

namespace halfstep {

/// A volume as cache files hold it, little-endian; equal volumes have equal bytes.
std::string VolumeBytes(const std::optional<BoxTree>& volume);

/// The `count` volumes that `bytes` hold one after the other and nothing else; `cell` [m] is their
/// lattice's spacing. None when they make no sense: too few or too many bytes, points beyond 1 km
/// or not finite, a tree that is not sound.
std::optional<std::vector<std::optional<BoxTree>>> ParseVolumes(std::string_view bytes,
                                                                size_t count, double cell);

}  // namespace halfstep
