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

/// A robot of any tree of links that turn and slide, as its URDF has it.
class JointedRobot {
 public:
  /// A convex body of a link, in the link's frame; a mesh is its convex hull.
  struct Body {
    std::string name;       ///< the link's, the second and further ones with #2, #3 …
    int link = -1;          ///< index
    ConvexBody shape = {};  ///< contains the collision shape
    double reach = 0.0;     ///< no point of it is farther from the link's origin [m]
  };
  /// What moves a body as seen from another one, and by how much a point of it then moves at most,
  /// at any positions of the others: a joint's turn [rad] or shift [m] times `reach`.
  struct Lever {
    int joint = -1;      ///< of the URDF; −1: the root's motion in W, with its turn's `reach`
    double reach = 0.0;  ///< of a turn [m]; 1 of a shift
  };

  /// Throws InputError with every complaint about meshes. `packages` (name → folder) and
  /// `dae_up_axis` as for LinkShapes.
  JointedRobot(UrdfTree urdf, const std::map<std::string, std::string>& packages,
               bool dae_up_axis = false);

  const UrdfTree& urdf() const { return urdf_; }               ///< as read
  const std::vector<Body>& bodies() const { return bodies_; }  ///< of all links

  /// A link's frame, from that of its parent and the position of the joint between them. What does
  /// not move stays at 0.
  template <typename T>
  static FrameIn<T> After(const FrameIn<T>& X_WParent, const UrdfJoint& joint, const T& q) {
    FrameIn<T> X = X_WParent * FrameOf<T>(joint.X_ParentChild);
    if (joint.kind == UrdfJoint::Kind::kRevolute) {
      const auto [s, c] = SinCosOf(q);
      return X * TurnAbout(joint.axis, s, c);
    }
    if (!joint.slides) return X;
    const VectorIn<T> axis = X.Turned(VectorOf<T>(joint.axis));
    for (size_t i = 0; i < 3; ++i) X.p[i] = X.p[i] + axis[i] * q;
    return X;
  }
  /// Frames of all links in W for that of the root and joint positions by index [rad, m]. All
  /// frames of all positions within the intervals are within the result.
  std::vector<Frame> Frames(const Frame& X_WRoot, const std::vector<Interval>& q) const;

  /// What moves a body as seen from a link, or from W (−1). `slides`: by joint, how far it is from
  /// 0 at most, of those that slide [m]. When every joint m moves by at most d_m, no point of the
  /// body moves farther than Σ d_m·reach_m as seen from there.
  std::vector<Lever> Levers(const Body& body, int link, const std::vector<double>& slides) const;
  /// The joint that moves a link. Precondition: it is not the root.
  const UrdfJoint& JointOf(int link) const;
  /// Whether both links are one, or joined by one joint or by fixed ones.
  bool AreNeighbours(int link_a, int link_b) const;

 private:
  // Links from one to the root, both included.
  std::vector<int> Above(int link) const;
  int Rigid(int link) const;  // the uppermost link that is fixed to it

  UrdfTree urdf_;
  std::vector<Body> bodies_;
};

}  // namespace halfstep::checker
