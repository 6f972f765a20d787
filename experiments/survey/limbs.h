#pragma once

#include <array>
#include <optional>
#include <vector>

#include "wpg/robot/urdf_file.h"

namespace halfstep {

/// Two limbs that hang on one link, each with the moving joints that it has for itself.
struct Limbs {
  std::array<int, 2> ends{-1, -1};         ///< the last link of each
  std::array<std::vector<int>, 2> joints;  ///< URDF joint indices from the common link down
};

/// Whether a joint moves, or would if its axis and limits were those of a joint that does.
bool MeansToMove(const UrdfJoint& joint);

/// The limbs from the last link on which both ends hang.
Limbs LimbsOf(const UrdfTree& urdf, int a, int b);

/// The pair of limbs that are legs by their structure. How deep a limb reaches is the height of its
/// first joint less all of its length: that does not depend on how the joints at zero stand, so
/// that arms that hang lower than bent legs do not pass for legs. Of all pairs with at least four
/// joints each that are no arms by their names, the two that reach deepest are taken: of pairs with
/// as many joints each, and the same distances between them; only where others reach far deeper,
/// one of these, for then the legs themselves differ. z of the root is up. `arms`: the deepest of
/// the pairs that were left out as arms, where that left nothing.
std::optional<Limbs> FindLegPair(const UrdfTree& urdf, std::optional<Limbs>* arms);

}  // namespace halfstep
