#include "experiments/verify/verify_episode.h"

#include <filesystem>
#include <set>

#include "experiments/config/experiment.h"
#include "experiments/config/known_names.h"
#include "experiments/live/live_config.h"
#include "experiments/live/spare_boxes.h"
#include "experiments/verify/check_episode_commands.h"
#include "experiments/verify/check_episode_grants.h"
#include "experiments/verify/check_episode_motion.h"
#include "experiments/verify/check_episode_promise.h"
#include "experiments/verify/check_episode_proof.h"
#include "experiments/verify/check_episode_times.h"
#include "experiments/verify/check_episode_walks.h"
#include "experiments/verify/check_episode_worlds.h"
#include "experiments/verify/check_files.h"
#include "experiments/verify/check_not_covered.h"
#include "experiments/verify/check_run.h"
#include "experiments/verify/config_plan.h"
#include "experiments/verify/csv_text.h"
#include "experiments/verify/episode_text.h"
#include "experiments/verify/found_inputs.h"
#include "experiments/verify/given_files.h"
#include "experiments/verify/robot_numbers.h"
#include "wpg/files/input_error.h"
#include "wpg/files/sha256.h"

namespace halfstep::verify {
namespace {

namespace fs = std::filesystem;

FolderFiles FilesOf(const fs::path& folder, size_t walks) {
  FolderFiles files;
  for (auto it = fs::recursive_directory_iterator(folder); it != fs::end(it); ++it) {
    const std::string name = it->path().lexically_relative(folder).string();
    if (!it->is_directory() && name != "manifest.json") files.there.insert(name);
  }
  files.needed = {"begun.csv",     "config.yaml", "events.csv",  "grants.csv",
                  "obstacles.csv", "plans.csv",   "timings.csv", "worlds.csv"};
  for (size_t k = 0; k < walks; ++k) {
    files.needed.insert(FolderOfWalk(k) + "/footsteps.csv");
    files.needed.insert(FolderOfWalk(k) + "/half_steps.csv");
    files.needed.insert(FolderOfWalk(k) + "/overlaps.csv");
  }
  if (walks > 0) files.needed.insert("trajectory.csv");
  return files;
}

// Robot and scene of an episode, by their hashes, with the boxes to spare.
Place PlaceOf(const VerifyOptions& options, const LiveConfig& config,
              const EpisodeManifest& manifest) {
  Place place;
  place.scene.name = "none";
  const ExperimentConfig& experiment = config.experiment;
  place.robot = options.robot ? LoadRobot(*options.robot)
                              : FindRobot({.what = "robot",
                                           .run = options.run,
                                           .places = {RobotPath(experiment)},
                                           .sha256 = manifest.robot_sha256})
                                    .input;
  const auto scene = ScenePath(experiment);
  if (scene && options.scene) {
    place.scene = LoadScene(scene->string());
  } else if (scene) {
    place.scene = FindScene({.what = "scene",
                             .run = options.run,
                             .places = {*scene},
                             .sha256 = manifest.scene_sha256})
                      .input;
  }
  place.robot =
      WithAccelerations(std::move(place.robot), experiment.smoothing.assumed_acceleration);
  place.scene = WithSpareBoxes(std::move(place.scene), config.live);
  return place;
}

// Whether manifest and config speak of the same episode, robot and scene.
void CheckEpisodeInputs(const EpisodeManifest& manifest, const LiveConfig& config,
                        const std::string& config_bytes, const Place& place, Findings* findings) {
  const auto agree = [findings](const char* what, bool same) {
    if (!same) findings->Disagree(std::string(what) + ": manifest.json disagrees with config.yaml");
  };
  agree("config_sha256", manifest.config_sha256 == Sha256(config_bytes));
  agree("name", manifest.name == config.experiment.name);
  agree("seed", manifest.seed == config.experiment.seed);
  agree("clock", manifest.clock == config.live.clock);
  agree("policy", manifest.policy == config.live.policy);
  CheckManifestInputs("robot", place.robot.files, manifest.robot_files, manifest.robot_sha256,
                      findings);
  CheckManifestInputs("scene", place.scene.files, manifest.scene_files, manifest.scene_sha256,
                      findings);
  findings->Say(
      Formatted("config.yaml and manifest.json: name, seed, clock, policy; %zu robot "
                "files, %zu scene files",
                place.robot.files.size(), place.scene.files.size()));
}

// All that is about walks; there is one.
void CheckEpisodeWalking(const VerifyOptions& options, const EpisodeText& episode,
                         const EpisodeManifest& manifest, const LiveConfig& config,
                         const Place& place, const EpisodePromise& promise, Findings* findings) {
  const ExperimentConfig& experiment = config.experiment;
  const LevelTops ground(place.scene);
  const auto start = StartOn(experiment, place.robot, ground, findings);
  if (!start) return;
  const EpisodeWalks all = CheckEpisodeWalks(episode,
                                             {.robot = place.robot,
                                              .start = *start,
                                              .half_step = HalfStepOf(experiment.half_step),
                                              .scene = place.scene},
                                             findings);
  const std::string path = (fs::path(options.run) / "trajectory.csv").string();
  const std::vector<PlayedRow> rows = ReadTrajectory(path, ReadBytes(path), place.robot);
  if (!all.last) return;
  if (!CheckGrantNumbers(episode, all, findings)) return;
  CheckSuccessors(episode, all, findings);
  CheckEpisodeGrants(episode, all, findings);
  const DescribedWalk executed = ExecutedWalk(episode, all, manifest.stopped);
  CheckWhatBegan(episode, manifest, executed, findings);
  const double period = experiment.output_period.value_or(kRowPeriod);
  CheckEpisodeTrajectory(rows, manifest, executed, period, findings);
  CheckEpisodeEnding(episode, manifest, all, executed,
                     {experiment.goal, ground.HeightNamed(experiment.goal.level)}, findings);
  const CertificateText demands = DemandsOf(experiment.smoothing.limits, findings);
  const HalfStep form = HalfStepOf(experiment.half_step);
  TellProved(
      [&] {
        return options.prove.of_episode({.robot = place.robot,
                                         .scene = place.scene,
                                         .demands = demands,
                                         .form = form,
                                         .episode = episode});
      },
      findings);
  CheckEpisodeCommands(episode, manifest, config.live, findings);
  CheckEpisodePromise(promise, {episode, &executed, manifest.end, place.scene, config.live},
                      findings);
}

}  // namespace

std::vector<NotCovered> VerifyEpisode(const VerifyOptions& options,
                                      const std::string& manifest_text, Findings* findings) {
  const fs::path folder(options.run);
  const EpisodeManifest manifest =
      ReadEpisodeManifest((folder / "manifest.json").string(), manifest_text);
  const auto walks = static_cast<size_t>(manifest.walks);
  CheckListedFiles(options.run, FilesOf(folder, walks), manifest.files, findings);
  const std::string config_path = (folder / "config.yaml").string();
  const LiveConfig config = LoadLiveConfig(config_path, GivenFiles(options), options.tools);
  const Place place = PlaceOf(options, config, manifest);
  CheckEpisodeInputs(manifest, config, ReadBytes(config_path), place, findings);
  if (NamesOfConfigs(options.tools).has_own_margins) {
    findings->NotExamined("whether the family `own` holds: its formula is not known here");
  }
  const std::vector<NotCovered> not_covered = FindNotCovered(
      DemandsOf(config.experiment.smoothing.limits, findings), place.robot, place.scene);
  CheckNotCovered("manifest.json", manifest.not_covered, not_covered, findings);
  const EpisodeText episode = ReadEpisode(folder, walks);
  if (!CheckEpisodeNumbers(episode, place.scene, findings)) return not_covered;
  CheckEpisodeWorlds(episode, config.live, place.scene, findings);
  CheckEpisodeTimes(episode, manifest, config.live, findings);
  const EpisodePromise promise =
      ReadEpisodePromise((folder / "manifest.json").string(), manifest_text, manifest);
  if (walks > 0) {
    CheckEpisodeWalking(options, episode, manifest, config, place, promise, findings);
    return not_covered;
  }
  CheckEpisodePromise(promise, {episode, nullptr, manifest.end, place.scene, config.live},
                      findings);
  findings->Say("ending: no walk");
  if (manifest.ending != "no_plan" || !episode.grants.empty() || !episode.begun.empty()) {
    findings->Disagree(
        "manifest.json: no walk, but not the ending no_plan, a grant or a half-step");
  }
  return not_covered;
}

}  // namespace halfstep::verify
