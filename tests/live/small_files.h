#pragma once

#include <filesystem>
#include <string>

#include "tests/live/small_episode.h"
#include "tests/replaced.h"
#include "tests/temporary_folder.h"

namespace halfstep {

/// Writes small.yaml, the small world with `live` before the keys there, and its scene of one box,
/// a bar beside the way unless told otherwise; `size` and `xyz` are lists in YAML [m]. Bakes what
/// commands read from the cache.
inline void WriteSmallWorld(const std::filesystem::path& place, const std::string& live,
                            const std::string& name = "bar",
                            const std::string& size = "[0.03, 0.3, 0.04]",
                            const std::string& xyz = "[0.75, 2.0, 0.02]") {
  SmallWorld::Get();
  const std::string config = Replaced(kSmallConfig, "scene: none", "scene: " + name + ".yaml");
  WriteText(place / "small.yaml", Replaced(config, "live: {", "live: {" + live));
  WriteText(place / (name + ".yaml"), "name: " + name + "\nobstacles:\n  - {name: " + name +
                                          ", box: {size_m: " + size + "}, pose: {xyz: " + xyz +
                                          "}}\n");
}

}  // namespace halfstep
