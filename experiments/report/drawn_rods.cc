#include "experiments/report/drawn_rods.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

#include "wpg/files/input_error.h"
#include "wpg/nth.h"
#include "wpg/robot/link_anchors.h"
#include "wpg/robot/robot_legs.h"
#include "wpg/robot/robot_tree.h"

namespace halfstep {
namespace {

constexpr double kShortest = 0.005;    // rods below this are not seen [m]
constexpr double kOfNeighbours = 0.6;  // a rod's radius, of the slenderest neighbour's half width

// Half of the least edge of the box around a link's bodies [m]; none: it has no body.
std::optional<double> HalfWidth(const RobotModel& robot, const UrdfLink& link) {
  std::optional<double> least;
  for (const RobotBody& body : robot.bodies) {
    if (body.name != link.name && !body.name.starts_with(link.name + "#")) continue;
    const ConvexBody& shape = body.shape;
    const Eigen::Vector3d edges =
        shape.vertices.rowwise().maxCoeff() - shape.vertices.rowwise().minCoeff();
    const double width = edges.minCoeff() / 2 + shape.ball_radius + shape.disc_radius;
    least = std::min(least.value_or(width), width);
  }
  return least;
}

class RodsOf {
 public:
  RodsOf(const RobotModel& robot, const RobotTree& tree) : robot_(robot), urdf_(tree.urdf) {
    std::array<std::array<int, 6>, 2> legs{};
    Complaints complaints;
    for (size_t side = 0; side < 2; ++side) {
      const auto joints = FindLegJoints(urdf_, tree.waist, Nth(tree.feet, side), &complaints);
      if (!joints) throw std::runtime_error("the legs are no longer those of the robot");
      Nth(legs, side) = *joints;
    }
    anchors_ = FindAnchors(urdf_, tree.waist, legs, tree.posture);
    for (const UrdfLink& link : urdf_.links) widths_.push_back(HalfWidth(robot, link));
  }

  std::vector<DrawnRod> All() const {
    std::vector<DrawnRod> rods;
    for (const UrdfJoint& joint : urdf_.joints) {
      if (Nth(widths_, joint.parent) && Nth(widths_, joint.child)) continue;
      const LinkAnchor& anchor = Nth(anchors_, joint.parent);
      DrawnRod rod{.leg = anchor.leg, .link = anchor.link, .from_B = {}, .to_B = {}};
      const Eigen::Isometry3d X_BLink = PoseOf(anchor) * anchor.X_AnchorLink;
      rod.from_B = X_BLink.translation();
      rod.to_B = X_BLink * joint.X_ParentChild.translation();
      rod.radius = kOfNeighbours * std::min(WidthAbove(joint.parent), WidthBelow(joint.child));
      const bool seen = (rod.to_B - rod.from_B).norm() > kShortest;
      if (seen && rod.radius < std::numeric_limits<double>::infinity()) rods.push_back(rod);
    }
    return rods;
  }

 private:
  Eigen::Isometry3d PoseOf(const LinkAnchor& anchor) const {
    if (anchor.leg < 0) return Eigen::Isometry3d::Identity();
    return Nth(Nth(robot_.legs, anchor.leg).joints, anchor.link).X_BLink;
  }

  // Of a link, or of what it hangs on.
  double WidthAbove(int link) const {
    while (!Nth(widths_, link)) {
      const int joint = Nth(urdf_.links, link).joint;
      if (joint < 0) return std::numeric_limits<double>::infinity();
      link = Nth(urdf_.joints, joint).parent;
    }
    return *Nth(widths_, link);
  }

  // Of a link, or the least of those that hang on it; ∞ where nothing that hangs there has a body.
  double WidthBelow(int link) const {
    if (Nth(widths_, link)) return *Nth(widths_, link);
    double least = std::numeric_limits<double>::infinity();
    for (const UrdfJoint& joint : urdf_.joints) {
      if (joint.parent == link) least = std::min(least, WidthBelow(joint.child));
    }
    return least;
  }

  const RobotModel& robot_;
  const UrdfTree& urdf_;
  std::vector<LinkAnchor> anchors_;            // by link
  std::vector<std::optional<double>> widths_;  // by link
};

}  // namespace

std::vector<DrawnRod> DrawnRods(const RobotModel& robot) {
  try {
    const WholeRobot whole = LoadWholeRobot(robot.files.at(0).path);
    return RodsOf(robot, whole.tree).All();
  } catch (const std::exception&) {
    return {};
  }
}

}  // namespace halfstep
