#pragma once

#include <string>

#include "wpg/geometry/convex_body.h"

namespace halfstep::replay {

/// A shape in MuJoCo's language.
struct MujocoGeom {
  std::string shape;  ///< attributes of a `geom` in the body's frame: type, size, place
  std::string asset;  ///< the element of `asset` that they name, "": none
};

/// Spheres, capsules and cylinders are MuJoCo's own, all else is the convex hull of its vertices as
/// a mesh called `name`. Precondition: the body is one that MakeBox … MakeHull make.
MujocoGeom GeomOf(const ConvexBody& body, const std::string& name);

/// ` name="value"`, the value as XML has it: of any text, `&`, `<` and `"` included.
std::string Attribute(const std::string& name, const std::string& value);

}  // namespace halfstep::replay
