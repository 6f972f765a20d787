#pragma once

#include <array>
#include <string>
#include <vector>

#include "wpg/robot/urdf_file.h"

namespace halfstep {

/// Two chains of joints that hang on one link: the legs of a URDF.
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

/// Finds the legs by their structure (FindLegPair), or as the user names them, and reads no mesh.
/// Throws InputError with one sentence, which names the joints, when there are none; when they have
/// not six joints each, but for toes beyond the sixth; or when the first six of more are no hip,
/// knee and ankle, as of legs whose knee is two joints.
FoundLegs FindLegs(const UrdfTree& urdf, const LegNames& names);

}  // namespace halfstep
