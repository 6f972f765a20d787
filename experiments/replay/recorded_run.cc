#include "experiments/replay/recorded_run.h"

#include <filesystem>

#include "experiments/config/experiment.h"
#include "experiments/config/folder_name.h"

namespace halfstep::replay {

RecordedRun ReadRun(const std::string& run, const std::optional<std::string>& method,
                    const Toolbox& tools) {
  const std::vector<std::string> methods = MethodsOfRun(run, method);
  const std::filesystem::path folder = run;
  const ExperimentConfig config = LoadConfig((folder / "config.yaml").string(), {}, tools);
  RecordedRun recorded{
      .robot = LoadWholeRobot(RobotPath(config).string()), .world = {}, .walks = {}};
  if (const auto scene = ScenePath(config))
    recorded.world = ObstaclesOf(LoadScene(scene->string()));
  for (const std::string& name : methods) {
    const std::string its = MethodFolder(name) + "/";
    recorded.walks.push_back(
        {name, its,
         ReferenceMotion(ReadTrajectory(folder / its / "trajectory.csv", recorded.robot.model))});
  }
  return recorded;
}

}  // namespace halfstep::replay
