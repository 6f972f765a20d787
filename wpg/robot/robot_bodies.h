#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "wpg/files/input_error.h"
#include "wpg/robot/robot_model.h"
#include "wpg/robot/urdf_file.h"

namespace halfstep {

/// What BuildBodies needs beside the URDF.
struct BodyRequest {
  int waist = -1;                                ///< link index.
  std::array<std::array<int, 6>, 2> leg_joints;  ///< URDF joint indices by Index(Side).
  std::vector<double> posture;                   ///< standing posture by URDF joint index [rad].
  std::map<std::string, std::string> packages;   ///< package name → folder.
  std::array<Eigen::Matrix3d, 2> R_FootSole;   ///< of the soles in the last links, by Index(Side).
  std::map<std::string, int> mesh_parts = {};  ///< link → convex parts of its meshes; others: one.
  int hull_vertices = 64;                      ///< at most, of a mesh's hull, or of a part's.
  bool dae_up_axis = false;                    ///< meshes in DAE are turned by their `up_axis`
  double farthest = 100.0;  ///< of a body from its link's frame, or the waist's [m]
};

/// Package names in the `package://` paths of the collision meshes, sorted.
std::vector<std::string> MeshPackages(const UrdfTree& urdf);

/// Bodies and, in the same order, the URDF links that they belong to.
struct LinkBodies {
  std::vector<InputFile> meshes;  ///< one entry for each reading of a mesh, in bodies' order.
  std::vector<RobotBody> bodies;  ///< convex, each in the frame of its link
  std::vector<int> links;         ///< indices of URDF links
};

/// Convex bodies of all links. A link that hangs on a leg's link by joints outside the leg is rigid
/// with that link, any other link with the waist, in the standing posture. A mesh becomes its
/// convex hull, or `mesh_parts` convex bodies that contain it together (CutIntoConvexParts); what
/// has more than `hull_vertices` vertices becomes a body around it with at most so many (that
/// reaches no farther along the axes of the sole when it belongs to a foot); and a cylinder that is
/// not parallel to its frame's z becomes a prism of 32 sides around it. The bodies of a link are
/// named after it, the second and further ones with #2, #3 … behind. Complains about meshes that
/// cannot be read or have no volume, and about bodies that reach farther than `farthest`.
LinkBodies BuildBodies(const UrdfTree& urdf, const BodyRequest& request, Complaints* complaints);

/// The collision shapes of one link in its frame, a mesh as its convex hull: each contains the
/// URDF's shape. `packages` and `dae_up_axis` as in BodyRequest, complaints as there.
std::vector<ConvexBody> LinkShapes(const UrdfTree& urdf, int link,
                                   const std::map<std::string, std::string>& packages,
                                   bool dae_up_axis, Complaints* complaints);

}  // namespace halfstep
