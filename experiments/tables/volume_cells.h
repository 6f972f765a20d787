#pragma once

#include <nlohmann/json.hpp>

#include "planner/swept/box_tree.h"

namespace halfstep {

/// A region as cells, for pictures: `size` cells along x, y, z from `lower` [m], and `runs`, the
/// lengths of runs of free and occupied cells in turn, z fastest, x slowest. `merged` cells of the
/// region along each axis make one, which is occupied where one of them is: what is drawn contains
/// the region.
nlohmann::json VolumeCells(const BoxTree& volume, int merged);

}  // namespace halfstep
