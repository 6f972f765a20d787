#include "wpg/robot/link_anchors.h"

#include <algorithm>

#include "wpg/nth.h"

namespace halfstep {

std::vector<LinkAnchor> FindAnchors(const UrdfTree& urdf, int waist,
                                    const std::array<std::array<int, 6>, 2>& leg_joints,
                                    const std::vector<double>& posture) {
  std::vector<double> q = posture;
  for (const auto& joints : leg_joints) {
    for (const int joint : joints) Nth(q, joint) = 0.0;
  }
  const std::vector<Eigen::Isometry3d> X = urdf.LinkPoses(q);
  std::vector<LinkAnchor> anchors(urdf.links.size());
  anchors[0].urdf_link = waist;
  for (size_t i = 1; i < urdf.links.size(); ++i) {
    const int joint = urdf.links[i].joint;
    anchors[i] = Nth(anchors, Nth(urdf.joints, joint).parent);
    for (size_t leg = 0; leg < 2; ++leg) {
      const auto found = std::find(leg_joints[leg].begin(), leg_joints[leg].end(), joint);
      if (found == leg_joints[leg].end()) continue;
      anchors[i].leg = static_cast<int>(leg);
      anchors[i].link = static_cast<int>(found - leg_joints[leg].begin());
      anchors[i].urdf_link = static_cast<int>(i);
    }
  }
  for (size_t i = 0; i < anchors.size(); ++i) {
    // Exactly the identity for the anchors themselves, so that upright cylinders stay so.
    const auto anchor = static_cast<size_t>(anchors[i].urdf_link);
    anchors[i].X_AnchorLink =
        anchor == i ? Eigen::Isometry3d::Identity() : X[anchor].inverse() * X[i];
  }
  return anchors;
}

}  // namespace halfstep
