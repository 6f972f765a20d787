#pragma once

#include <array>
#include <string>
#include <vector>

#include "wpg/robot/urdf_file.h"

namespace halfstep {

/// Two chains of joints that hang on one link and end lowest: the legs of a URDF.
struct FoundLegs {
  int waist = -1;                            ///< link on which both hang
  std::array<int, 2> feet{-1, -1};           ///< links that the sixth joints move, by Index(Side)
  std::array<std::array<int, 6>, 2> joints;  ///< URDF joint indices from the waist down
  std::vector<std::string> beyond;           ///< moving joints below the sixth, as of toes
  bool sides_by_name = false;                ///< else the left foot is the one at larger y
};

/// What the user says of the legs; "" where it is to be found.
struct LegNames {
  std::string waist;                ///< its link
  std::array<std::string, 2> feet;  ///< by Index(Side)
};

/// Finds the legs: of all pairs of chains with as many moving joints each, at least five, between a
/// common link and their ends, the pair whose ends are lowest where all joints are at zero, z of
/// the root being up. Throws InputError with one sentence when there is none, or when its chains
/// have fewer than six joints.
FoundLegs FindLegs(const UrdfTree& urdf, const LegNames& names);

}  // namespace halfstep
