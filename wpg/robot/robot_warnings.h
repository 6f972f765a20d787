#pragma once

#include <string>
#include <vector>

#include "wpg/robot/robot_model.h"
#include "wpg/robot/urdf_file.h"

namespace halfstep {

/// What is told of a leg whose axes do not meet, at its first joint; empty: they meet.
std::vector<std::string> OffsetWarnings(const Leg& leg, const UrdfJoint& first,
                                        const std::string& urdf_file);

/// Which joints are held still, and why. Joints with the same fault, such as the fingers of a hand,
/// share a line.
std::vector<std::string> HeldJointWarnings(const UrdfTree& urdf);

/// That meshes with more than `hull_vertices` on their hull got simpler ones; empty: none did.
std::vector<std::string> SimplifiedWarnings(const UrdfTree& urdf,
                                            const std::vector<RobotBody>& bodies,
                                            int hull_vertices);

}  // namespace halfstep
