// The same bytes as PLY and as PCD.

#include "tests/fuzz/fuzz.h"
#include "wpg/files/point_file.h"

using namespace halfstep;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string bytes = fuzz::Text(data, size);
  for (const char* path : {"fuzz.ply", "fuzz.pcd"}) {
    LoadedPoints loaded;
    if (!fuzz::Reads(path, [&] { loaded = ParsePoints(path, bytes); })) continue;
    fuzz::Require(loaded.points.cols() > 0 && loaded.points.allFinite() &&
                      loaded.points.cwiseAbs().maxCoeff() <= 1e9,
                  "a point is beyond the bounds");
  }
  return 0;
}
