#pragma once

#include <string>

namespace halfstep {

/// An episode of two half-steps in scene.yaml, on coarse cells that are baked in a moment. Keys of
/// `live` are to follow, indented.
inline constexpr char kShortEpisode[] =
    "robot: hrp2\n"
    "scene: scene.yaml\n"
    "goal: {x_m: 0.6, y_m: 0.1, radius_m: 0.05}\n"
    "step_set: {x_min_m: 0, x_max_m: 0.2, y_min_m: -0.21, y_max_m: -0.21,\n"
    "           spacing_m: 0.2, yaws_rad: [0]}\n"
    "swept_volumes: {cell_m: 0.05, displacement_m: 0.05, cache: cache}\n"
    "planner: {unimproved_nodes: 0, max_nodes: 2000}\n"
    "live:\n";

/// A scene of a box beside the way, with its middle at y [m], a text.
inline std::string BoxAside(const std::string& y) {
  return "obstacles:\n"
         "  - name: box\n"
         "    box: {size_m: [0.1, 0.3, 0.3]}\n"
         "    pose: {xyz: [0.45, " +
         y + ", 0.15]}\n";
}

}  // namespace halfstep
