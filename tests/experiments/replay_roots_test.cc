// Roots of URDFs, as people have them, in simulation.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "experiments/replay/mujoco_model.h"
#include "experiments/replay/simulation.h"
#include "tests/places.h"
#include "tests/replaced.h"
#include "tests/temporary_folder.h"
#include "wpg/robot/robot_tree.h"

namespace halfstep::replay {
namespace {

namespace fs = std::filesystem;

const fs::path kRobotFiles = InSources("wpg/robots");

// Wren, whose root is its waist, by another URDF and with another name of the waist.
WholeRobot Wren(const std::string& urdf, const std::string& waist) {
  const TemporaryFolder place;
  WriteText(place / "wren.urdf", urdf);
  std::string yaml = Replaced(ReadText(kRobotFiles / "wren.yaml"), "wren_bodies: ./wren",
                              "wren_bodies: " + (kRobotFiles / "wren").string());
  yaml = Replaced(yaml, "waist_link: trunk", "waist_link: " + waist);
  return LoadWholeRobot(WriteText(place / "wren.yaml", yaml));
}

double WeightInSimulation(const WholeRobot& whole, const std::string& waist) {
  return Simulation(MujocoModel(whole.model, whole.tree, {}), whole.model, waist).weight();
}

TEST(ReplayRoots, MayHaveAnyNameAndHangOnAWorld) {
  if (!WhyNoSimulation().empty()) GTEST_SKIP() << WhyNoSimulation();
  const std::string urdf = ReadText(kRobotFiles / "wren.urdf");
  const WholeRobot wren = Wren(urdf, "trunk");
  const double weight = 9.81 * wren.model.mass;
  const auto renamed = [&urdf](const std::string& root) {
    std::string text = urdf;
    for (const char* where : {"<link name=\"", "<parent link=\""}) {
      const std::string from = std::string(where) + "trunk\"", to = where + root + "\"";
      for (size_t at; (at = text.find(from)) != std::string::npos;)
        text.replace(at, from.size(), to);
    }
    return text;
  };
  const auto on_world = [](const std::string& text, const std::string& type,
                           const std::string& root) {
    return Replaced(text, "</robot>",
                    "<link name='world'/><joint name='to_world' type='" + type +
                        "'><parent link='world'/><child link='" + root +
                        "'/><origin xyz='0.3 -0.2 1' rpy='0 0 0.5'/></joint></robot>");
  };
  struct Case {
    std::string urdf, waist;
  };
  for (const auto& [text, waist] :
       {Case{renamed("world"), "world"}, Case{renamed("floor"), "floor"},
        Case{on_world(urdf, "fixed", "trunk"), "trunk"},
        Case{on_world(urdf, "floating", "trunk"), "trunk"},
        Case{on_world(urdf, "planar", "trunk"), "trunk"},
        Case{on_world(renamed("world_"), "fixed", "world_"), "world_"}}) {
    const WholeRobot whole = Wren(text, waist);
    EXPECT_EQ(whole.model.mass, wren.model.mass);
    // MuJoCo gives a body without mass 0.1 g.
    EXPECT_NEAR(WeightInSimulation(whole, waist), weight, 2e-3) << waist;
  }
}

}  // namespace
}  // namespace halfstep::replay
