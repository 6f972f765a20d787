#pragma once

#include <string>
#include <vector>

#include "wpg/robot/link_anchors.h"
#include "wpg/robot/robot_masses.h"
#include "wpg/robot/urdf_file.h"

namespace halfstep {

/// Adds up the links' masses by their anchors. The result's `fault` says which leg has no mass,
/// which link an inertia with a negative principal moment that is not negligible beside the rest of
/// its body, or what has an inertia that its mass could have only farther than `farthest` [m] from
/// its centre: files have inertias in other units.
RobotMasses AddUpMasses(const UrdfTree& urdf, const std::vector<LinkAnchor>& anchors,
                        double farthest);

/// What of the links' masses is hard to believe, as "file:line:column: …": principal moments of
/// inertia of which one exceeds the sum of the others, which no rigid body has, and densities
/// beyond 10 … 20000 kg/m³. For the density, a link fills the boxes around its collision shapes
/// that are boxes, spheres or cylinders; a link with a mesh is not judged.
std::vector<std::string> MassWarnings(const UrdfTree& urdf);

}  // namespace halfstep
