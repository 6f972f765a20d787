#include "experiments/replay/episode_folder.h"

#include <optional>

#include "experiments/config/experiment.h"
#include "experiments/live/spare_boxes.h"
#include "experiments/tables/json_file.h"
#include "wpg/files/input_error.h"

namespace halfstep::replay {
namespace {

// The script's time when the robot began to walk [s].
double WaitedOf(const nlohmann::json& manifest, const std::filesystem::path& path) {
  const auto waited = manifest.find("waited_s");
  if (waited == manifest.end() || !waited->is_number()) {
    throw InputError({path.string() + ": waited_s: is missing or no number"});
  }
  return *waited;
}

}  // namespace

RecordedEpisode ReadEpisode(const std::filesystem::path& folder, const Toolbox& tools) {
  LiveConfig config = LoadLiveConfig((folder / "config.yaml").string(), {}, tools);
  WholeRobot robot = LoadWholeRobot(RobotPath(config.experiment).string());
  const std::optional<std::filesystem::path> scene = ScenePath(config.experiment);
  if (config.live.sensing.source == "client") {
    throw InputError({folder.string() +
                      ": where obstacles truly were is not known: clients measured them (valid: an "
                      "episode with live.sensing.source: stand_in)"});
  }
  const TrueWorld script(WithSpareBoxes(scene ? LoadScene(scene->string()) : Scene(), config.live),
                         config.experiment.goal, config.live);
  const std::filesystem::path path = folder / "manifest.json";
  const nlohmann::json manifest = ReadJsonObject(path);
  TrueWorld truth = script.Since(WaitedOf(manifest, path));
  // In physics the robot strayed by itself, and nothing else did.
  if (manifest.contains("physics")) truth = truth.SeenFrom([](double) { return Pose2(); });
  ReferenceMotion motion(ReadTrajectory(folder / "trajectory.csv", robot.model));
  return {std::move(config), std::move(robot), std::move(truth), std::move(motion)};
}

}  // namespace halfstep::replay
