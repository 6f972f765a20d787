#pragma once

#include <Eigen/Geometry>
#include <map>
#include <string>
#include <vector>

#include "experiments/checker/curves.h"
#include "experiments/checker/frame.h"
#include "wpg/geometry/convex_body.h"
#include "wpg/robot/urdf_file.h"

namespace halfstep::checker {

/// A robot of any tree of links and revolute joints, as its URDF has it. Its root is fixed in W.
class JointedRobot {
 public:
  /// A convex body of a link, in the link's frame; a mesh is its convex hull.
  struct Body {
    std::string name;       ///< the link's, the second and further ones with #2, #3 …
    int link = -1;          ///< index
    ConvexBody shape = {};  ///< contains the collision shape
    double reach = 0.0;     ///< no point of it is farther from the link's origin [m]
  };
  /// A joint between two bodies, and how far points of the first may be from its origin.
  struct Lever {
    int joint = -1;      ///< of the URDF
    double reach = 0.0;  ///< at any joint angles [m]
  };

  /// Throws InputError with every complaint about meshes. `packages` (name → folder) and
  /// `dae_up_axis` as for LinkShapes.
  JointedRobot(UrdfTree urdf, const std::map<std::string, std::string>& packages,
               bool dae_up_axis = false);

  const UrdfTree& urdf() const { return urdf_; }               ///< as read
  const std::vector<Body>& bodies() const { return bodies_; }  ///< of all links

  /// Frames of all links in W for joint positions by index [rad]; joints that are not revolute stay
  /// at 0. All frames of all positions within the intervals are within the result.
  std::vector<Frame> Frames(const std::vector<Interval>& q) const;

  /// The revolute joints between a body and a link (the root: W), each with the lever of the body's
  /// points. When every joint m of them turns by an angle of at most d_m, no point of the body
  /// moves farther than Σ d_m·reach_m as seen from the link.
  std::vector<Lever> Levers(const Body& body, int link) const;
  /// Whether both links are one, or joined by one joint or by fixed ones.
  bool AreNeighbours(int link_a, int link_b) const;

 private:
  // Links from one to the root, both included.
  std::vector<int> Above(int link) const;
  const UrdfJoint& JointOf(int link) const;
  int Rigid(int link) const;  // the uppermost link that is fixed to it

  UrdfTree urdf_;
  std::vector<Body> bodies_;
};

}  // namespace halfstep::checker
