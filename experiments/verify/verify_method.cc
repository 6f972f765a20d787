#include "experiments/verify/verify_method.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "experiments/config/experiment.h"
#include "experiments/verify/certificate_text.h"
#include "experiments/verify/check_certificate.h"
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
#include "experiments/verify/csv_text.h"
#include "experiments/verify/described_walk.h"
#include "experiments/verify/given_files.h"
#include "experiments/verify/own_names.h"
#include "smoothing/margins/own_margin.h"
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

// The config of a run, read as `halfstep run` reads it: unknown keys are refused. Names that the
// run's program registered are told, since only that one knows what they do.
ExperimentConfig ReadConfig(const VerifyOptions& options, const std::string& path,
                            const std::string& text, Findings* findings) {
  const OwnNames own = FindOwnNames(path, text);
  std::vector<YamlOverride> overrides = GivenFiles(options);
  overrides.insert(overrides.end(), own.overrides.begin(), own.overrides.end());
  ExperimentConfig config = ParseConfig(path, text, overrides);
  if (own.methods) config.smoothing.methods = *own.methods;
  if (OwnMargins().empty()) {
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

HalfStepSequence PlannedOf(const ExperimentConfig& config, const RobotModel& robot) {
  std::vector<Footstep> footsteps;
  for (const FootstepConfig& step : config.footsteps) {
    footsteps.push_back({.side = step.foot == "left" ? Side::kLeft : Side::kRight,
                         .X_WF = step.X_WF,
                         .via_height = step.via_height.value_or(config.half_step.via_height),
                         .duration = step.duration.value_or(config.half_step.duration)});
  }
  return CompensatedAsAsked(
      config, robot,
      MakeSequence(StartOf(config, robot), footsteps, config.half_step.via_lateral,
                   ShapeOf(config.half_step), {.com_height = robot.com_height}));
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

// The walk that half_steps.csv and overlaps.csv describe; none when they do not fit.
std::optional<DescribedWalk> WalkOf(const MethodFiles& files, const ExperimentConfig& config,
                                    const RobotModel& robot, Findings* findings) {
  const HalfStepSequence planned = PlannedOf(config, robot);
  CheckFootsteps(ReadFootsteps(files.PathInRun("footsteps.csv"), files.ReadOfRun("footsteps.csv")),
                 planned, findings);
  const auto half_steps =
      ReadHalfSteps(files.PathOf("half_steps.csv"), files.Read("half_steps.csv"));
  std::optional<std::vector<OverlapRow>> overlaps;
  if (files.Has("overlaps.csv")) {
    overlaps = ReadOverlaps(files.PathOf("overlaps.csv"), files.Read("overlaps.csv"));
  }
  if (!CheckOverlaps(half_steps, overlaps, planned, findings)) return std::nullopt;
  if (overlaps) CheckFixed(half_steps, *overlaps, planned, config.smoothing.fixed, findings);
  try {
    return DescribedWalk(robot, planned, half_steps);
  } catch (const std::logic_error& error) {
    findings->Disagree(std::string("half_steps.csv: describes no walk: ") + error.what());
    return std::nullopt;
  }
}

bool IsFinite(const std::vector<ClaimRow>& rows) {
  return std::all_of(rows.begin(), rows.end(), [](const ClaimRow& row) {
    return std::isfinite(row.begin) && std::isfinite(row.end) && !std::isnan(row.margin) &&
           std::isfinite(row.bound);
  });
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
  const ExperimentConfig config =
      ReadConfig(options, files.PathInRun("config.yaml"), config_bytes, findings);
  const RobotModel robot = LoadRobot(
      options.robot ? *options.robot : (files.run / certificate.robot).lexically_normal().string());
  Scene scene;
  scene.name = "none";
  if (const std::string named = options.scene.value_or(certificate.scene); named != "none") {
    scene = LoadScene(options.scene ? named : (files.run / named).lexically_normal().string());
  }

  CheckHash("trajectory.csv", trajectory, certificate.trajectory_hash, findings);
  CheckHash("certificate.csv", claims, certificate.certificate_hash, findings);
  CheckRun({.config = config,
            .manifest = manifest,
            .certificate = certificate,
            .robot = robot,
            .scene = scene,
            .run = files.run,
            .folder = folder,
            .robot_given = options.robot.has_value(),
            .scene_given = options.scene.has_value()},
           config_bytes, findings);
  const bool same_files = findings->disagreements() == 0;
  findings->Say(Formatted("SHA-256: trajectory, certificate, %zu robot files, %zu scene files",
                          robot.files.size(), scene.files.size()));
  CheckFiles(options.run, folder, manifest, findings);
  CheckAgainstConfig(certificate, robot, config.smoothing.limits, findings);
  CheckDemandOfStopBranches(config.smoothing.stop_branches, manifest.acceptance, findings);
  const auto iterations =
      !files.Has("iterates.csv")
          ? 0
          : std::ranges::count(files.Read("iterates.csv"), '\n') - 1;  // and the header
  CheckSummary(ReadSummary(files.PathInRun("summary.csv"), files.ReadOfRun("summary.csv")),
               manifest, folder, certificate, iterations, findings);

  const std::vector<ClaimRow> claimed = ReadCertificateCsv(files.PathOf("certificate.csv"), claims);
  const std::vector<PlayedRow> rows =
      ReadTrajectory(files.PathOf("trajectory.csv"), trajectory, robot);
  CheckArithmetic(certificate, claimed, robot, rows.empty() ? 0 : rows.back().t, findings);
  const std::vector<NotCovered> not_covered = FindNotCovered(certificate, robot, scene);
  CheckNotCovered("certificate.json", certificate.not_covered, not_covered, findings);
  CheckNotCovered("manifest.json", manifest.not_covered,
                  FindNotCovered(DemandsOf(config.smoothing.limits, findings), robot, scene),
                  findings);
  const std::optional<DescribedWalk> walk = WalkOf(files, config, robot, findings);
  if (!CheckIsMotion(rows, findings) || !walk) return {certificate.statement, not_covered};
  const PlayedMotion motion(robot, rows);
  Distances distances(robot, scene);
  const double period = RowPeriodOf(config, rows[1].t);
  CheckRowsOnWalk(rows, *walk, period, walk->end(), findings);
  CheckConsistency(motion, *walk, findings);
  if (!same_files) {
    findings->Say("clearances: not examined, for these are not the certificate's files");
    return {certificate.statement, not_covered};
  }
  CheckPlayed(motion, *walk, certificate, options.tolerance, &distances, findings);
  CheckStopBranches(*walk, {config.smoothing.stop_branches, period}, certificate, options.tolerance,
                    &distances, findings);
  CheckMarginColumns(rows, *walk, certificate, &distances, findings);
  if (IsFinite(claimed)) CheckClaims(*walk, certificate, claimed, &distances, findings);
  findings->Say("distances measured: " + Count(distances.queries()));
  return {certificate.statement, not_covered};
}

}  // namespace halfstep::verify
