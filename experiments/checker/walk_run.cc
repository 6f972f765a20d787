#include "experiments/checker/walk_run.h"

#include <cmath>
#include <filesystem>
#include <map>
#include <optional>

#include "experiments/checker/check_walk.h"
#include "experiments/config/experiment.h"
#include "experiments/verify/config_plan.h"
#include "experiments/verify/csv_text.h"
#include "experiments/verify/episode_text.h"
#include "experiments/verify/found_inputs.h"
#include "experiments/verify/robot_numbers.h"
#include "experiments/verify/run_manifest.h"
#include "wpg/files/input_error.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"

namespace halfstep::checker {
namespace {

namespace fs = std::filesystem;
using verify::ReadBytes;

constexpr double kTwiceRounded = 1e-9;  // times that are computed twice [s]

// t_{i+1} = t_i + T_i − Δ_i, with the overlaps where there are any; half_steps.csv has to agree.
std::vector<Interval> StartsOf(const std::vector<verify::HalfStepRow>& rows,
                               const std::optional<std::vector<verify::OverlapRow>>& overlaps) {
  std::vector<Interval> starts;
  for (size_t i = 0; i < rows.size(); ++i) {
    if (i > 0 && overlaps && i <= overlaps->size()) {
      starts.push_back(starts[i - 1] + Interval(rows[i - 1].duration) -
                       Interval((*overlaps)[i - 1].overlap));
    } else {
      starts.emplace_back(i > 0 && !overlaps ? rows[i].start : 0.0);
    }
    if (std::abs(starts[i].Middle() - rows[i].start) <= kTwiceRounded) continue;
    throw InputError({Formatted(
        "half_steps.csv: half-step %zu does not begin where overlaps.csv has it", i + 1)});
  }
  return starts;
}

}  // namespace

std::vector<std::string> SentencesOf(const std::vector<verify::NotCoveredItem>& not_covered) {
  std::vector<std::string> sentences;
  for (const verify::NotCoveredItem& item : not_covered) {
    if (item.kind != "pair") sentences.push_back(item.sentence);
  }
  if (const size_t pairs = not_covered.size() - sentences.size(); pairs > 0) {
    sentences.push_back(Formatted("%zu pairs of bodies that the files list as not watched", pairs));
  }
  return sentences;
}

std::vector<std::string> CertifiedMethods(const std::string& run,
                                          const std::optional<std::string>& method) {
  const fs::path manifest = fs::path(run) / "manifest.json";
  if (!fs::is_regular_file(manifest)) {
    throw InputError({run + ": no such run folder (" + DidYouMeanRun(run) +
                      "valid: one that `halfstep run` wrote)"});
  }
  const std::string text = ReadBytes(manifest.string());
  if (verify::IsOfEpisode(manifest.string(), text)) {
    if (method) throw InputError({"--method: is of runs (valid: none, for an episode)"});
    return {""};
  }
  std::vector<std::string> folders, known;
  for (const auto& of : verify::ReadManifest(manifest.string(), text).methods) {
    const std::string folder = verify::FolderOfMethod(of.name);
    const fs::path certificate = fs::path(run) / folder / "certificate.json";
    if (!fs::is_regular_file(certificate)) continue;
    known.push_back(folder);
    if (method ? *method == of.name || *method == folder
               : verify::ReadCertificateJson(certificate.string(), ReadBytes(certificate.string()))
                         .verdict == "certified") {
      folders.push_back(folder);
    }
  }
  if (!folders.empty()) return folders;
  if (method) throw InputError({"--method: " + Quote(*method) + " (valid: " + Joined(known) + ")"});
  throw InputError({run + ": no walk is certified, so that nothing is claimed"});
}

WalkRun ReadWalkRun(const std::string& run, const std::string& method,
                    const std::string& robot_file, const std::string& scene_file) {
  const fs::path root(run), folder = root / method;
  const auto path = [](const fs::path& in, const char* name) { return (in / name).string(); };
  if (method.empty()) return ReadEpisodeRun(run, robot_file, scene_file);
  std::vector<InputFile> files;
  const auto read = [&](const auto& reader, const fs::path& in, const char* name) {
    const std::string text = ReadBytes(path(in, name));
    files.push_back(RecordOf(path(in, name), text));
    return reader(path(in, name), text);
  };
  const verify::CertificateText certificate =
      read(verify::ReadCertificateJson, folder, "certificate.json");
  const verify::RunManifest manifest = read(verify::ReadManifest, root, "manifest.json");
  const ExperimentConfig config = LoadConfig(path(root, "config.yaml"), {});
  const RobotModel robot = verify::WithAccelerations(
      verify::FindRobot({"robot",
                         root,
                         {robot_file, RobotPath(config), root / certificate.robot},
                         manifest.robot_sha256})
          .input,
      certificate.joint_acceleration);
  Scene scene;
  if (const auto named = ScenePath(config)) {
    scene =
        verify::FindScene(
            {"scene", root, {scene_file, *named, root / certificate.scene}, manifest.scene_sha256})
            .input;
  }
  files.push_back(RecordOf(path(root, "config.yaml"), ReadBytes(path(root, "config.yaml"))));
  files.insert(files.end(), robot.files.begin(), robot.files.end());
  files.insert(files.end(), scene.files.begin(), scene.files.end());
  const auto footsteps = read(verify::ReadFootsteps, root, "footsteps.csv");
  const auto half_steps = read(verify::ReadHalfSteps, folder, "half_steps.csv");
  std::optional<std::vector<verify::OverlapRow>> overlaps;
  if (fs::exists(folder / "overlaps.csv")) {
    overlaps = read(verify::ReadOverlaps, folder, "overlaps.csv");
  }
  WalkRun walk = RunOf({.robot = robot,
                        .scene = scene,
                        .certificate = certificate,
                        .form = verify::HalfStepOf(config.half_step),
                        .footsteps = footsteps,
                        .half_steps = half_steps,
                        .overlaps = overlaps,
                        .stop_branches = config.smoothing.stop_branches});
  walk.files = std::move(files);
  walk.not_covered = SentencesOf(walk.certificate.not_covered);
  walk.not_covered.push_back(
      "whether the files of the run belong together, and trajectory.csv (`halfstep verify`)");
  return walk;
}

WalkRun RunOf(const verify::WalkToProve& of) {
  WalkRun walk{.robot = of.robot, .scene = of.scene, .certificate = of.certificate};
  walk.crouch = of.form.crouch;
  walk.tables = {.footsteps = of.footsteps,
                 .half_steps = of.half_steps,
                 .starts = StartsOf(of.half_steps, of.overlaps),
                 .planned = of.form.form,
                 .com_height = Interval(of.robot.com_height) - Interval(walk.crouch),
                 .crouch = walk.crouch};
  if (of.overlaps) {
    walk.overlaps.emplace();
    for (const verify::OverlapRow& row : *of.overlaps) walk.overlaps->push_back(row.overlap);
  }
  const std::vector<Interval>& starts = walk.tables.starts;
  for (size_t k = 0; of.stop_branches != "none" && k + 1 < starts.size(); ++k) {
    if (of.stop_branches == "down" && k % 2 == 0) continue;
    walk.branches.push_back({Formatted("stopped after half-step %zu", k + 1), k, starts[k + 1].lo});
  }
  return walk;
}

TrajectoryCheck CheckRun(const WalkRun& run, const std::function<bool(double done)>& progress,
                         ProofHints* hints) {
  TrajectoryCheck all;
  std::map<std::pair<TrajectoryFinding::Kind, std::string>, TrajectoryFinding> worst;
  const double parts = static_cast<double>(run.branches.size() + (run.whole ? 1 : 0));
  double done = 0.0;
  const auto add = [&](const WalkMotion& motion, const StopBranch& of, ProofHints* with) {
    TrajectoryCheck part = CheckWalk(
        motion, run.robot, of.world ? *of.world : run.scene, run.certificate, run.crouch,
        [&](double share) { return !progress || progress((done + share) / parts); }, with, of.from);
    for (const TrajectoryFinding& finding : part.findings) {
      const auto [at, is_new] = worst.try_emplace({finding.kind, finding.subject});
      TrajectoryFinding& kept = at->second;
      const bool less = finding.least - finding.demanded < kept.least - kept.demanded;
      if (!is_new && !(kept.proved && (!finding.proved || less))) continue;
      kept = finding;
      if (!finding.proved && !of.name.empty()) kept.subject += ", " + of.name;
    }
    for (std::string& line : part.not_covered) {
      if (std::ranges::count(all.not_covered, line) == 0) all.not_covered.push_back(line);
    }
    all.intervals += part.intervals;
    all.stopped = part.stopped;
    done += 1.0;
  };
  const WalkMotion motion(run.tables);
  if (run.whole) add(motion, {}, hints);
  for (size_t i = 0; i < run.branches.size() && !all.stopped; ++i) {
    const StopBranch& branch = run.branches[i];
    add(motion.CutAfter(branch.last, branch.from), branch, nullptr);
  }
  for (auto& [key, finding] : worst) all.findings.push_back(std::move(finding));
  all.not_covered.insert(all.not_covered.end(), run.not_covered.begin(), run.not_covered.end());
  all.Sort();
  return all;
}

}  // namespace halfstep::checker
