#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "wpg/robot/urdf_file.h"

namespace halfstep {

/// On what a link of a URDF is rigid while walking: a leg's link when it hangs on that by joints
/// outside the leg, else the waist.
struct LinkAnchor {
  int leg = -1;        ///< Index(Side), or −1: the waist.
  int link = -1;       ///< 0 … 5: moved by joints 0 … link of that leg; −1 on the waist.
  int urdf_link = -1;  ///< of the anchor itself.
  Eigen::Isometry3d X_AnchorLink = Eigen::Isometry3d::Identity();  ///< while walking.
};

/// The anchors of all links by their URDF index. `leg_joints` has URDF joint indices by
/// Index(Side), and `posture` the standing posture by URDF joint index [rad], which joints outside
/// the legs keep.
std::vector<LinkAnchor> FindAnchors(const UrdfTree& urdf, int waist,
                                    const std::array<std::array<int, 6>, 2>& leg_joints,
                                    const std::vector<double>& posture);

}  // namespace halfstep
