#pragma once

#include <string>

#include "planner/swept/box_tree.h"

namespace halfstep {

/// The outer faces of a region as Wavefront OBJ text, in quadrilaterals counter-clockwise from
/// outside [m]. Closed, but neighbours need not share whole edges.
std::string BoxTreeObj(const BoxTree& tree);

}  // namespace halfstep
