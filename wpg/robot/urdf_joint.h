#pragma once

#include <string>
#include <vector>

#include "wpg/robot/urdf_elements.h"

namespace halfstep {

/// Looks at what moves a joint: axis, limits, speed, mimicry. Returns complaints, which matter when
/// the joint belongs to a leg; outside the legs one that cannot be understood is made fixed, so
/// that urdfdom takes it, and a speed or an effort that is not valid is made 0. A continuous joint
/// becomes a revolute one of one turn. `file` stands for the text in complaints.
std::vector<std::string> RepairMotion(const std::string& file, const std::string& name,
                                      TiXmlElement* joint);

}  // namespace halfstep
