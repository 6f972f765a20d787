#pragma once

#include "wpg/robot/urdf_check.h"
#include "wpg/robot/urdf_elements.h"

namespace halfstep {

/// Whether the links of a URDF hang on each other as one tree. Complains to `elements` about links
/// that hang twice or on themselves, and about no or several roots. A link on which nothing hangs,
/// and which hangs on nothing, is left out of `robot` and `found`, with a warning to `warn`.
void CheckUrdfTree(const UrdfElements& elements, const UrdfElements& warn, TiXmlElement* robot,
                   UrdfFindings* found);

}  // namespace halfstep
