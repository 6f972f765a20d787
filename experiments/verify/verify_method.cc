#include "experiments/verify/verify_method.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "experiments/config/experiment.h"
#include "experiments/config/known_names.h"
#include "experiments/verify/certificate_text.h"
#include "experiments/verify/check_certificate.h"
#include "experiments/verify/check_chosen.h"
#include "experiments/verify/check_claims.h"
#include "experiments/verify/check_episode_proof.h"
#include "experiments/verify/check_files.h"
#include "experiments/verify/check_margin_columns.h"
#include "experiments/verify/check_not_covered.h"
#include "experiments/verify/check_overlaps.h"
#include "experiments/verify/check_played.h"
#include "experiments/verify/check_rows.h"
#include "experiments/verify/check_run.h"
#include "experiments/verify/check_stop_branches.h"
#include "experiments/verify/check_summary.h"
#include "experiments/verify/check_walk.h"
#include "experiments/verify/config_plan.h"
#include "experiments/verify/csv_text.h"
#include "experiments/verify/described_walk.h"
#include "experiments/verify/found_inputs.h"
#include "experiments/verify/given_files.h"
#include "experiments/verify/level_tops.h"
#include "experiments/verify/own_names.h"
#include "experiments/verify/robot_numbers.h"
#include "experiments/verify/tolerances.h"
#include "experiments/verify/tube_raise.h"
#include "smoothing/methods/dichotomy.h"
#include "wpg/files/input_error.h"
#include "wpg/files/sha256.h"

namespace halfstep::verify {
namespace {

namespace fs = std::filesystem;

void CheckHash(const char* what, const std::string& bytes, const std::string& stated,
               Findings* findings) {
  if (Sha256(bytes) == stated) return;
  findings->Disagree(std::string(what) +
                     ": not the one that the certificate is about (SHA-256 differs)");
}

// Says so where config.yaml names another file than that of the certificate. A shipped robot, which
// is named by a word, may be another one in another copy of halfstep.
void CheckPassed(const std::string& what, const std::string& passed, const std::string& named,
                 Findings* findings) {
  const fs::path name(named);
  if (passed.empty() || (!name.has_parent_path() && !name.has_extension())) return;
  findings->Disagree("config.yaml names the " + what + " " + Quote(named) +
                     ", which is not the one that the certificate is about");
}

// The config of a run, read as `halfstep run` reads it: unknown keys are refused. Names that the
// run's program registered are told, since only that one knows what they do. Defaults go by the
// robot's size; where the config's robot is not to be had, the certificate's place of it serves.
ExperimentConfig ReadConfig(const VerifyOptions& options, const std::string& path,
                            const std::string& text, const InputSearch& robot,
                            const InputSearch& scene, Findings* findings) {
  const OwnNames own = FindOwnNames(path, text, options.tools);
  std::vector<YamlOverride> overrides = GivenFiles(options);
  overrides.insert(overrides.end(), own.overrides.begin(), own.overrides.end());
  ExperimentConfig config;
  try {
    config = ParseConfig(path, text, overrides, options.tools);
  } catch (const InputError& error) {
    std::vector<std::string> complaints = error.complaints();
    for (const InputSearch* search : {&robot, &scene}) {
      const fs::path& place = search->places.front();
      std::error_code ignored;
      if (place.filename() != "none" && !fs::is_regular_file(place, ignored)) {
        complaints.push_back(NotFound(*search));
      }
    }
    if (options.robot || complaints.size() > error.complaints().size())
      throw InputError(complaints);
    overrides.push_back(NamedInstead("robot", robot.places.front().string()));
    config = ParseConfig(path, text, overrides, options.tools);
    // What it names in the run's folder has to be there.
    const fs::path named = fs::path(own.robot).lexically_normal();
    if (named.is_relative() && named.has_parent_path() && *named.begin() != "..") {
      CheckPassed("robot", robot.places.front().string(), own.robot, findings);
    }
  }
  if (own.methods) config.smoothing.methods = *own.methods;
  if (!NamesOfConfigs(options.tools).has_own_margins) {
    config.smoothing.limits.demanded_of(MarginFamily::kOwn) =
        own.own_margin.value_or(verify::kNotDemanded);
  }
  std::string told;
  for (const std::string& name : own.told) told += (told.empty() ? "" : ", ") + name;
  if (!told.empty()) {
    findings->Say("names in config.yaml that this program does not have: " + told +
                  "; what a walk is does not depend on them");
  }
  if (config.footsteps.empty()) {
    throw InputError({path + ": footsteps: are missing (valid: the config.yaml of a run)"});
  }
  return config;
}

// All files of one method, and of its run, as they were read.
struct MethodFiles {
  MethodFiles(const VerifyOptions& options, const std::string& folder_name)
      : folder(fs::path(options.run) / folder_name), run(options.run) {}

  std::string PathOf(const char* file) const { return (folder / file).string(); }
  std::string Read(const char* file) const { return ReadBytes(PathOf(file)); }
  bool Has(const char* file) const { return fs::exists(PathOf(file)); }
  std::string PathInRun(const char* file) const { return (run / file).string(); }
  std::string ReadOfRun(const char* file) const { return ReadBytes(PathInRun(file)); }

  fs::path folder, run;
};

// The tables that describe a walk, and the walk; none when they do not fit.
struct MethodWalk {
  std::vector<FootstepRow> footsteps;
  std::vector<HalfStepRow> half_steps;
  std::optional<std::vector<OverlapRow>> overlaps = {};
  std::optional<DescribedWalk> walk = {};
};

MethodWalk WalkOf(const MethodFiles& files, const ExperimentConfig& config, const RobotModel& robot,
                  const Scene& scene, const RunManifest::Method* of_method, Findings* findings) {
  const LevelTops ground(scene);
  MethodWalk of{
      .footsteps =
          ReadFootsteps(files.PathInRun("footsteps.csv"), files.ReadOfRun("footsteps.csv")),
      .half_steps = ReadHalfSteps(files.PathOf("half_steps.csv"), files.Read("half_steps.csv"))};
  if (files.Has("overlaps.csv")) {
    of.overlaps = ReadOverlaps(files.PathOf("overlaps.csv"), files.Read("overlaps.csv"));
  }
  const std::optional<WalkPlan> on_ground = PlanOf(config, robot, ground, findings);
  if (!on_ground) return of;
  const WalkPlan& planned = *on_ground;
  CheckFootsteps(of.footsteps, planned, findings);
  if (!CheckOverlaps(of.half_steps, of.overlaps, planned, findings)) return of;
  const std::string& method = of_method == nullptr ? "" : of_method->name;
  if (of.overlaps) {
    CheckFixed(of.half_steps, *of.overlaps, planned, config.smoothing.fixed, findings);
    CheckUpperBounds(method, of.half_steps, *of.overlaps, planned,
                     config.smoothing.options.Get(DichotomyGroup()), findings);
    CheckChosen(method, of.half_steps, planned, config.smoothing, findings);
  }
  try {
    if (ground.even()) {
      of.walk.emplace(robot, planned, of.half_steps);
    } else {
      of.walk.emplace(robot, planned, of.half_steps, scene.ground->Floor());
    }
  } catch (const std::logic_error& error) {
    findings->Disagree(std::string("half_steps.csv: describes no walk: ") + error.what());
  }
  return of;
}

// Robot and scene that the certificate is about, by their hashes.
struct Inputs {
  RobotModel robot;
  Scene scene;
};

Inputs InputsOf(const VerifyOptions& options, const ExperimentConfig& config,
                const RunManifest& manifest, const CertificateText& certificate,
                InputSearch of_robot, Findings* findings) {
  Inputs inputs;
  if (options.robot) {
    inputs.robot = LoadRobot(*options.robot);
  } else {
    of_robot.places.insert(of_robot.places.begin(), RobotPath(config));
    Found<RobotModel> found = FindRobot(of_robot);
    CheckPassed("robot", found.passed, config.robot, findings);
    inputs.robot = std::move(found.input);
  }
  inputs.scene.name = "none";
  const fs::path run(options.run);
  const auto named = ScenePath(config);
  if (!options.scene && named.has_value() == (certificate.scene == "none")) {
    findings->Disagree("the certificate is about the scene " + Quote(certificate.scene) +
                       ", config.yaml about " + Quote(config.scene));
  }
  if (options.scene) {
    if (*options.scene != "none") inputs.scene = LoadScene(*options.scene);
  } else if (named) {
    Found<Scene> found = FindScene({.what = "scene",
                                    .run = run,
                                    .places = {*named, run / certificate.scene},
                                    .sha256 = manifest.scene_sha256});
    CheckPassed("scene", found.passed, config.scene, findings);
    inputs.scene = std::move(found.input);
  }
  return inputs;
}

bool IsFinite(const std::vector<ClaimRow>& rows) {
  return std::all_of(rows.begin(), rows.end(), [](const ClaimRow& row) {
    return std::isfinite(row.begin) && std::isfinite(row.end) && !std::isnan(row.margin) &&
           std::isfinite(row.bound);
  });
}

// What the files of a method claim.
struct MethodClaims {
  const CertificateText& certificate;
  const std::vector<ClaimRow>& claims;
  const std::vector<PlayedRow>& rows;
};

// Whether the walk keeps what is demanded, and rows, played motion and claims are true of it. No
// scene: these are not the certificate's files, so that distances say nothing.
void CheckMotion(const VerifyOptions& options, const ExperimentConfig& config,
                 const MethodClaims& claimed, const MethodWalk& of, const Scene* scene,
                 Findings* findings) {
  const auto& [certificate, claims, rows] = claimed;
  const DescribedWalk& walk = *of.walk;
  const PlayedMotion motion(walk.robot(), rows);
  const double period = RowPeriodOf(config, rows[1].t);
  const double tolerance = options.tolerance.value_or(Tolerances(walk.robot()).played);
  CheckRowsOnWalk(rows, walk, period, walk.end(), findings);
  CheckConsistency(motion, walk, findings);
  if (scene == nullptr) {
    findings->Say("clearances: not examined, for these are not the certificate's files");
    return;
  }
  const HalfStep form = HalfStepOf(config.half_step);
  TellProved(
      [&] {
        return options.prove.of_run({.robot = walk.robot(),
                                     .scene = *scene,
                                     .certificate = certificate,
                                     .form = form,
                                     .footsteps = of.footsteps,
                                     .half_steps = of.half_steps,
                                     .overlaps = of.overlaps,
                                     .stop_branches = config.smoothing.stop_branches});
      },
      findings);
  for (const Family family : {kZmpRobot, kTorque, kFriction, kJointAcceleration}) {
    const bool may_be = family != kJointAcceleration || LimitsAccelerations(walk.robot());
    if (certificate.demanded[family] != kNotDemanded || !may_be) continue;
    findings->Say(std::string(NameOf(family)) + ": nothing is demanded");
  }
  Distances distances(walk.robot(), *scene, certificate.tube ? certificate.tube->tube : Tube{});
  CheckPlayed(motion, walk.floor(), certificate, tolerance, &distances, findings);
  CheckMarginColumns(rows, walk, certificate, &distances, findings);
  if (IsFinite(claims)) CheckClaims(walk, certificate, claims, &distances, findings);
  findings->Say("distances measured: " + Count(distances.queries()));
}

}  // namespace

VerifiedStatement VerifyMethod(const VerifyOptions& options, const RunManifest& manifest,
                               const std::string& folder, Findings* findings) {
  const MethodFiles files(options, folder);
  const CertificateText certificate =
      ReadCertificateJson(files.PathOf("certificate.json"), files.Read("certificate.json"));
  const std::string claims = files.Read("certificate.csv");
  const std::string trajectory = files.Read("trajectory.csv");
  const std::string config_bytes = files.ReadOfRun("config.yaml");
  const InputSearch of_robot{.what = "robot",
                             .run = files.run,
                             .places = {files.run / certificate.robot},
                             .sha256 = manifest.robot_sha256};
  const InputSearch of_scene{.what = "scene",
                             .run = files.run,
                             .places = {files.run / certificate.scene},
                             .sha256 = manifest.scene_sha256};
  const ExperimentConfig config = ReadConfig(options, files.PathInRun("config.yaml"), config_bytes,
                                             of_robot, of_scene, findings);
  const auto [of_files, scene] =
      InputsOf(options, config, manifest, certificate, of_robot, findings);
  const RobotModel robot = WithAccelerations(of_files, certificate.joint_acceleration);

  CheckHash("trajectory.csv", trajectory, certificate.trajectory_hash, findings);
  CheckHash("certificate.csv", claims, certificate.certificate_hash, findings);
  CheckRun({.config = config,
            .manifest = manifest,
            .certificate = certificate,
            .robot = robot,
            .scene = scene,
            .folder = folder},
           config_bytes, findings);
  const bool same_files = findings->disagreements() == 0;
  findings->Say(Formatted("SHA-256: trajectory, certificate, %zu robot files, %zu scene files",
                          robot.files.size(), scene.files.size()));
  CheckFiles(options.run, folder, manifest, findings);
  SmoothingConfig demanded = config.smoothing;
  demanded.limits = WithTube(config.smoothing, robot);
  CheckTube(certificate, config.smoothing, robot, findings);
  const RobotModel by_config = WithAccelerations(of_files, demanded.assumed_acceleration);
  CheckAgainstConfig(certificate, by_config, demanded, findings);
  CheckDemandOfStopBranches(config.smoothing.stop_branches, manifest.acceptance, findings);
  const auto iterations =
      !files.Has("iterates.csv")
          ? 0
          : std::ranges::count(files.Read("iterates.csv"), '\n') - 1;  // and the header
  const std::vector<SummaryRow> summary =
      ReadSummary(files.PathInRun("summary.csv"), files.ReadOfRun("summary.csv"));
  CheckSummary(summary, manifest, folder, certificate, iterations, findings);

  const std::vector<ClaimRow> claimed = ReadCertificateCsv(files.PathOf("certificate.csv"), claims);
  const std::vector<PlayedRow> rows =
      ReadTrajectory(files.PathOf("trajectory.csv"), trajectory, robot);
  CheckWorstMargin(summary, folder, rows, robot, certificate, demanded.limits, findings);
  CheckArithmetic(certificate, claimed, robot, scene, rows.empty() ? 0 : rows.back().t, findings);
  const std::vector<NotCovered> not_covered = FindNotCovered(certificate, robot, scene);
  CheckNotCovered("certificate.json", certificate.not_covered, not_covered, findings);
  CheckNotCovered("manifest.json", manifest.not_covered,
                  FindNotCovered(DemandsOf(config.smoothing.limits, findings), by_config, scene),
                  findings);
  const MethodWalk of = WalkOf(files, config, robot, scene, manifest.MethodOf(folder), findings);
  const VerifiedStatement verified{certificate.statement, not_covered,
                                   certificate.verdict == "certified"};
  if (!CheckIsMotion(rows, findings) || !of.walk) return verified;
  CheckMotion(options, config, {certificate, claimed, rows}, of, same_files ? &scene : nullptr,
              findings);
  return verified;
}

}  // namespace halfstep::verify
