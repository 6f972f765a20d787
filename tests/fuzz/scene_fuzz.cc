// A scene; its folder has meshes that it may name.

#include "planner/scene/scene.h"
#include "tests/fuzz/fuzz.h"
#include "tests/places.h"

using namespace halfstep;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const std::string folder = InSources("tests/fixtures/mesh/good/");
  Scene scene;
  const std::string text = fuzz::Text(data, size);
  if (!fuzz::Reads("", [&] { scene = ParseScene(folder + "fuzz.yaml", text); })) return 0;
  for (const Obstacle& obstacle : scene.obstacles) {
    fuzz::Require(obstacle.X_WO.matrix().allFinite(), "a pose is not finite");
    const bool finite = std::visit(
        [](const auto& shape) { return BodyOf(shape).vertices.allFinite(); }, obstacle.shape);
    fuzz::Require(finite, "a corner is not finite");
  }
  for (const Eigen::Matrix2Xd& area : scene.no_step) {
    fuzz::Require(area.cols() >= 3 && area.allFinite(), "an area is no polygon");
  }
  for (const GroundSolid& solid : scene.ground->Solids()) {
    fuzz::Require(solid.polygon.cols() >= 3 && solid.polygon.allFinite() &&
                      solid.bottom < solid.top && solid.bottom >= scene.ground->Floor(),
                  "a solid is no prism");
  }
  return 0;
}
