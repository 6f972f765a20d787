// What an episode's records say was walked.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>

#include "experiments/checker/walk_run.h"
#include "experiments/checker/walk_statements.h"
#include "experiments/config/experiment.h"
#include "experiments/live/spare_boxes.h"
#include "experiments/verify/check_episode_proof.h"
#include "experiments/verify/check_episode_worlds.h"
#include "experiments/verify/config_plan.h"
#include "experiments/verify/csv_text.h"
#include "experiments/verify/episode_text.h"
#include "experiments/verify/found_inputs.h"
#include "experiments/verify/robot_numbers.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"

namespace halfstep::checker {
namespace {

namespace fs = std::filesystem;

constexpr double kNearer = 1e-3, kAtRest = 1e-9;  // [m], [s]
constexpr double kTwiceTold = 1e-9;               // numbers of two tables [m, rad, s]

// What a half-step is held to that begins at rest nearer to obstacles than demanded: from these it
// keeps what it has when it begins, less kNearer, and at least 0. To demand less of an obstacle is
// said here as a smaller error.
Scene FromRest(const WalkRun& run, const WalkMotion& motion, const StopBranch& branch,
               Scene world) {
  if (branch.last > 0) {
    const Interval before = run.tables.starts[branch.last - 1] +
                            Interval(run.tables.half_steps[branch.last - 1].duration);
    if (before.hi > branch.from + kAtRest) {
      throw InputError(
          {Formatted("half-step %zu begins near an obstacle, but not from rest", branch.last + 1)});
    }
  }
  verify::CertificateText distances;
  distances.demanded.fill(verify::kNotDemanded);
  distances.demanded[verify::kClearance] = 1e9;  // so that they are measured
  WalkStatements statements(run.robot, world, distances);
  const std::array<LegSolver, 2> solvers = {LegSolver(run.robot.legs[0]),
                                            LegSolver(run.robot.legs[1])};
  const WalkMotion cut = motion.CutAfter(branch.last, branch.from);
  WalkState state(run.robot, solvers, cut, Interval(run.robot.waist_height) - Interval(run.crouch),
                  branch.from, branch.from);
  const double demanded = run.certificate.demanded[verify::kClearance];
  std::vector<double> kept(world.obstacles.size(), demanded);
  for (WalkStatement& statement : statements.all()) {
    if (statement.b >= kept.size()) continue;  // the ground
    kept[statement.b] = std::min(kept[statement.b], statements.Look(&statement, &state).value);
  }
  for (size_t k = 0; k < kept.size(); ++k) {
    if (kept[k] < demanded) {
      world.obstacles[k].motion.error -= demanded - std::max(0.0, kept[k] - kNearer);
    }
  }
  return world;
}

bool Near(double a, double b) { return std::abs(a - b) <= kTwiceTold; }

// Whether a sole stands where the footsteps say that it does, with `num_steps` steps taken.
bool StandsThere(const verify::FootstepRow& sole, const std::vector<verify::FootstepRow>& footsteps,
                 size_t num_steps) {
  for (size_t row = 2 + num_steps; row-- > 0;) {
    const verify::FootstepRow& is = footsteps[row];
    if (is.foot != sole.foot) continue;
    return Near(is.X_WF.x, sole.X_WF.x) && Near(is.X_WF.y, sole.X_WF.y) &&
           Near(is.X_WF.yaw, sole.X_WF.yaw) && Near(is.z, sole.z);
  }
  return false;
}

// The tables of the last walk, whole: what is before a walk's own is that of the walk before it.
// Half-steps begin when half_steps.csv says, which is to agree with overlaps.csv.
WalkTables LastWalk(const verify::EpisodeText& episode) {
  WalkTables whole;
  for (size_t k = 0; k < episode.walks.size(); ++k) {
    const verify::EpisodeWalkText& walk = episode.walks[k];
    const auto refuse = [&](const std::string& what) {
      throw InputError({verify::FolderOfWalk(k) + what});
    };
    const auto first = static_cast<size_t>(walk.first);
    if (first % 2 != 0 || first > whole.half_steps.size()) {
      refuse("/half_steps.csv: does not begin where a step of the walk before it does");
    }
    const size_t before = first > 0 ? 1 : 0;  // overlaps before the first row
    if (walk.overlaps.size() + 1 != walk.half_steps.size() + before) {
      refuse("/overlaps.csv: has not one overlap for each two half-steps");
    }
    if (walk.footsteps.size() < 2) refuse("/footsteps.csv: does not say where the soles stand");
    for (size_t row = 0; first > 0 && row < 2; ++row) {
      if (StandsThere(walk.footsteps[row], whole.footsteps, first / 2)) continue;
      refuse(Formatted("/footsteps.csv:%zu: the foot does not stand there in the walk before it",
                       row + 2));
    }
    // Of a walk that goes on, where both soles stand is known.
    const auto begin = walk.footsteps.begin() + (first > 0 ? 2 : 0);
    whole.footsteps.resize(first > 0 ? 2 + first / 2 : 0);
    whole.footsteps.insert(whole.footsteps.end(), begin, walk.footsteps.end());
    whole.half_steps.resize(first);
    whole.half_steps.insert(whole.half_steps.end(), walk.half_steps.begin(), walk.half_steps.end());
    whole.starts.resize(first);
    for (size_t i = first; i < whole.half_steps.size(); ++i) {
      double start = 0.0;
      if (i > 0) {
        const verify::HalfStepRow& last = whole.half_steps[i - 1];
        start = last.start + last.duration - walk.overlaps[i - first + before - 1];
      }
      if (!Near(start, whole.half_steps[i].start)) {
        refuse(Formatted("/half_steps.csv: half-step %zu does not begin where overlaps.csv has it",
                         i + 1));
      }
      whole.starts.emplace_back(whole.half_steps[i].start);
    }
  }
  return whole;
}

}  // namespace

WalkRun RunOf(const verify::EpisodeToProve& of) {
  const verify::EpisodeText& episode = of.episode;
  WalkRun run{.robot = of.robot, .scene = of.scene, .certificate = of.demands};
  run.certificate.demanded[verify::kOwn] = verify::kNotDemanded;
  run.whole = false;
  run.crouch = of.form.crouch;
  run.tables = LastWalk(episode);
  run.tables.planned = of.form.form;
  run.tables.com_height = Interval(run.robot.com_height) - Interval(run.crouch);
  run.tables.crouch = run.crouch;
  std::set<int> near;
  for (const verify::EventRow& event : episode.events) {
    if (event.what == "near") near.insert(event.half_step);
  }
  std::optional<WalkMotion> motion;
  std::vector<std::shared_ptr<const Scene>> worlds(episode.worlds.size());
  for (size_t j = 0; j < episode.begun.size(); ++j) {
    const verify::BegunRow& begun = episode.begun[j];
    const auto grant = static_cast<size_t>(begun.grant);
    if (begun.half_step != static_cast<int>(j) + 1 || j >= run.tables.half_steps.size() ||
        grant >= episode.grants.size() ||
        static_cast<size_t>(episode.grants[grant].world) >= worlds.size()) {
      throw InputError({Formatted("begun.csv:%zu: names no half-step, grant or world", j + 2)});
    }
    const auto world = static_cast<size_t>(episode.grants[grant].world);
    if (!worlds[world]) {
      worlds[world] =
          std::make_shared<const Scene>(verify::SceneOfWorld(episode, run.scene, world));
    }
    StopBranch branch{Formatted("stopped after half-step %zu, in world %zu", j + 1, world), j,
                      run.tables.starts[j].lo, worlds[world]};
    if (near.contains(begun.half_step)) {
      if (!motion) motion.emplace(run.tables);
      branch.world = std::make_shared<const Scene>(FromRest(run, *motion, branch, *worlds[world]));
    }
    run.branches.push_back(std::move(branch));
  }
  return run;
}

WalkRun ReadEpisodeRun(const std::string& folder, const std::string& robot_file,
                       const std::string& scene_file) {
  const fs::path root(folder);
  const std::string path = (root / "manifest.json").string();
  const verify::EpisodeManifest manifest =
      verify::ReadEpisodeManifest(path, verify::ReadBytes(path));
  if (manifest.walks < 1) throw InputError({folder + ": nothing was walked"});
  const LiveConfig config = LoadLiveConfig((root / "config.yaml").string(), {});
  const ExperimentConfig& experiment = config.experiment;
  const RobotModel robot = verify::WithAccelerations(
      verify::FindRobot({"robot", root, {robot_file, RobotPath(experiment)}, manifest.robot_sha256})
          .input,
      experiment.smoothing.assumed_acceleration);
  Scene scene;
  if (const auto named = ScenePath(experiment)) {
    scene = verify::FindScene({"scene", root, {scene_file, *named}, manifest.scene_sha256}).input;
  }
  scene = WithSpareBoxes(std::move(scene), config.live);
  verify::Findings findings;
  const verify::CertificateText demands = verify::DemandsOf(experiment.smoothing.limits, &findings);
  const verify::EpisodeText episode =
      verify::ReadEpisode(root, static_cast<size_t>(manifest.walks));
  verify::CheckEpisodeNumbers(episode, scene, &findings);
  if (findings.disagreements() > 0) throw InputError(findings.reasons());
  WalkRun run = RunOf({.robot = robot,
                       .scene = scene,
                       .demands = demands,
                       .form = verify::HalfStepOf(experiment.half_step),
                       .episode = episode});
  run.not_covered = SentencesOf(manifest.not_covered);
  for (const char* const line :
       {"whether walks, worlds, grants and times belong together, and trajectory.csv (`halfstep "
        "verify`)",
        "the robot at rest, when obstacles come; families of a program's own"}) {
    run.not_covered.emplace_back(line);
  }
  return run;
}

}  // namespace halfstep::checker
