// The same bytes as each kind of file that `halfstep scene` reads by itself.

#include "experiments/scenery/scenery_readers.h"
#include "tests/fuzz/fuzz.h"

using namespace halfstep;

namespace {

void RequireSound(const OwnMesh& mesh) {
  fuzz::Require(mesh.vertices.allFinite() && mesh.vertices.cwiseAbs().maxCoeff() <= 1e9,
                "a corner is beyond the bounds");
  fuzz::Require(mesh.triangles.cols() > 0 && mesh.triangles.minCoeff() >= 0 &&
                    mesh.triangles.maxCoeff() < mesh.vertices.cols(),
                "a triangle names no corner");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string bytes = fuzz::Text(data, size);
  const SceneryRequest request{.cell = 0.1, .height = 1.0};
  using Reader = Scenery (*)(const std::string&, const std::string&, const SceneryRequest&);
  for (const auto& [path, read] : {std::pair<const char*, Reader>{"fuzz.scene", ReadMoveItScene},
                                   {"fuzz.yaml", ReadPlanningScene},
                                   {"fuzz.urdf", ReadUrdfScenery},
                                   {"fuzz.world", ReadSdfScenery},
                                   {"fuzz.pgm", ReadHeightmap}}) {
    Scenery scenery;
    if (!fuzz::Reads(path, [&] { scenery = read(path, bytes, request); })) continue;
    fuzz::Require(scenery.things.size() <= kMostThings, "too many things");
    for (const SceneryThing& thing : scenery.things) {
      fuzz::Require(thing.X_WO.matrix().allFinite(), "a pose is not finite");
      if (const auto* mesh = std::get_if<OwnMesh>(&thing.shape)) RequireSound(*mesh);
    }
  }
  OwnMesh mesh;
  std::vector<std::string> told;
  if (fuzz::Reads("fuzz.ply", [&] { mesh = ReadPlyMesh("fuzz.ply", bytes); })) RequireSound(mesh);
  if (fuzz::Reads("fuzz.glb", [&] { mesh = ReadGltfMesh("fuzz.glb", bytes, &told); })) {
    RequireSound(mesh);
  }
  return 0;
}
