// The same bytes as .bt and as .ot.

#include "tests/fuzz/fuzz.h"
#include "wpg/files/octomap_file.h"

using namespace halfstep;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string bytes = fuzz::Text(data, size);
  for (const char* path : {"fuzz.bt", "fuzz.ot"}) {
    LoadedOctomap map;
    if (!fuzz::Reads(path, [&] { map = ParseOctomap(path, bytes); })) continue;
    fuzz::Require(!map.cubes.empty() && map.resolution > 0, "nothing is known");
    for (const LoadedOctomap::Cube& cube : map.cubes) {
      fuzz::Require(cube.size >= 1 && cube.lower.minCoeff() >= -32768 &&
                        cube.lower.maxCoeff() + cube.size <= 32768,
                    "a cube is beyond the map");
    }
  }
  return 0;
}
