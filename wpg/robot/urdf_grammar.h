#pragma once

#include <string>

#include "wpg/robot/urdf_elements.h"

namespace halfstep {

/// Complains about what would be passed over in silence, though a walk depends on it: a second
/// element where one counts, two shapes in one `<geometry>`, a tag that is nearly one that is read
/// (`<colision>`), and attributes of places and shapes that nobody reads. (An rpy="0 0 0"
/// of an `<axis>` is usual, and means nothing.)
void CheckUrdfGrammar(const UrdfElements& elements, TiXmlElement& robot);

/// The URDF with nothing but what is read of it, and with every number as its shortest decimal
/// text, between them one blank: whatever reads it finds the numbers that were checked.
/// Precondition: all numbers that are left in it are numbers (UrdfElements::Numbers).
std::string PlainUrdf(TiXmlElement& robot);

}  // namespace halfstep
