// The same bytes as STL, ASCII or binary, as OBJ and as DAE.

#include "tests/fuzz/fuzz.h"
#include "wpg/files/mesh_file.h"

using namespace halfstep;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string bytes = fuzz::Text(data, size);
  for (const char* path : {"fuzz.stl", "fuzz.OBJ", "fuzz.dae"}) {
    LoadedMesh mesh;
    if (!fuzz::Reads(path, [&] { mesh = ParseMesh(path, bytes); })) continue;
    fuzz::Require(mesh.vertices.allFinite() && mesh.vertices.cwiseAbs().maxCoeff() <= 1e9,
                  "a corner is beyond the bounds");
    fuzz::Require(mesh.triangles.cols() > 0 && mesh.triangles.minCoeff() >= 0 &&
                      mesh.triangles.maxCoeff() < mesh.vertices.cols(),
                  "a triangle names no corner");
  }
  return 0;
}
