// The keys of a robot file against the shipped robot's URDF, which is read once; no model is built.

#include "tests/fuzz/fuzz.h"
#include "tests/places.h"
#include "wpg/files/yaml_fields.h"
#include "wpg/robot/robot_fields.h"

using namespace halfstep;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const std::string folder = InSources("wpg/robots");
  static const UrdfTree urdf = ReadUrdf(folder + "/hrp2.urdf");
  RobotFile file;
  file.urdf = urdf;
  const auto declare = [&file](Fields& fields) { DeclareFields(fields, &file); };
  fuzz::Reads("fuzz.yaml",
              [&] { ReadYamlText(fuzz::Text(data, size), "fuzz.yaml", folder, {}, declare); });
  return 0;
}
