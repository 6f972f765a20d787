#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace halfstep {

/// Kinds of scenes that are drawn at random: cylinders, random_room, blocks.
std::vector<std::string> RandomSceneNames();

/// The YAML text of a scene with `count` obstacles drawn from a seed, the same everywhere.
/// cylinders: upright on the floor in [0.2, 2.8] × [−0.8, 0.8] m, radius 1–3 cm, height 1–10 cm.
/// random_room: boxes of 5–40 cm and cylinders of 3–15 cm radius, 2 cm to 1 m high, in
/// [−2, 2]² m, at least 0.6 m from the corners (±1.5, ±1.5).
/// blocks: surfaces of 0.4 m × 0.4 m in five rows, from x = 0.3 m on and about y = 0, 0 to 15 cm
/// high in whole centimetres. Precondition: a name of RandomSceneNames(), count ≥ 0
/// (std::logic_error).
std::string DrawScene(const std::string& name, int count, std::uint64_t seed);

}  // namespace halfstep
