#include "experiments/checker/walk_run.h"

#include <cmath>
#include <filesystem>
#include <optional>

#include "experiments/config/experiment.h"
#include "experiments/verify/csv_text.h"
#include "experiments/verify/found_inputs.h"
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
                               const std::optional<std::vector<verify::OverlapRow>>& overlaps,
                               const std::string& path) {
  std::vector<Interval> starts;
  for (size_t i = 0; i < rows.size(); ++i) {
    if (i > 0 && overlaps && i <= overlaps->size()) {
      starts.push_back(starts[i - 1] + Interval(rows[i - 1].duration) -
                       Interval((*overlaps)[i - 1].overlap));
    } else {
      starts.emplace_back(i > 0 && !overlaps ? rows[i].start : 0.0);
    }
    if (std::abs(starts[i].Middle() - rows[i].start) <= kTwiceRounded) continue;
    throw InputError(
        {path + Formatted(": half-step %zu does not begin where overlaps.csv has it", i + 1)});
  }
  return starts;
}

}  // namespace

std::vector<std::string> CertifiedMethods(const std::string& run,
                                          const std::optional<std::string>& method) {
  const fs::path manifest = fs::path(run) / "manifest.json";
  if (!fs::is_regular_file(manifest)) {
    throw InputError({run + ": no such run folder (valid: one that `halfstep run` wrote)"});
  }
  std::vector<std::string> folders, known;
  for (const auto& of :
       verify::ReadManifest(manifest.string(), ReadBytes(manifest.string())).methods) {
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
  WalkRun walk;
  const auto read = [&](const auto& reader, const fs::path& in, const char* name) {
    const std::string text = ReadBytes(path(in, name));
    walk.files.push_back(RecordOf(path(in, name), text));
    return reader(path(in, name), text);
  };
  walk.certificate = read(verify::ReadCertificateJson, folder, "certificate.json");
  const verify::RunManifest manifest = read(verify::ReadManifest, root, "manifest.json");
  const ExperimentConfig config = LoadConfig(path(root, "config.yaml"), {});
  walk.robot = verify::FindRobot({"robot",
                                  root,
                                  {robot_file, RobotPath(config), root / walk.certificate.robot},
                                  manifest.robot_sha256})
                   .input;
  for (Leg& leg : walk.robot.legs) {
    for (LegJoint& joint : leg.joints) {
      if (std::isinf(joint.max_acceleration) && walk.certificate.joint_acceleration) {
        joint.max_acceleration = *walk.certificate.joint_acceleration;
      }
    }
  }
  if (const auto scene = ScenePath(config)) {
    walk.scene = verify::FindScene({"scene",
                                    root,
                                    {scene_file, *scene, root / walk.certificate.scene},
                                    manifest.scene_sha256})
                     .input;
  }
  walk.files.push_back(RecordOf(path(root, "config.yaml"), ReadBytes(path(root, "config.yaml"))));
  for (const auto* files : {&walk.robot.files, &walk.scene.files}) {
    walk.files.insert(walk.files.end(), files->begin(), files->end());
  }
  walk.tables.footsteps = read(verify::ReadFootsteps, root, "footsteps.csv");
  walk.tables.half_steps = read(verify::ReadHalfSteps, folder, "half_steps.csv");
  const HalfStepConfig& form = config.half_step;
  walk.crouch = form.crouch;
  walk.tables.com_height = Interval(walk.robot.com_height) - Interval(walk.crouch);
  walk.tables.planned = {.via_lateral = form.via_lateral,
                         .foot_ramp = form.foot_ramp,
                         .foot_delay = form.foot_delay,
                         .lift_share = form.lift_share,
                         .zmp_shift = form.zmp_shift / form.duration,
                         .zmp_bump_ramp = form.zmp_bump_ramp.value_or(1.0)};
  std::optional<std::vector<verify::OverlapRow>> overlaps;
  if (fs::exists(folder / "overlaps.csv")) {
    overlaps = read(verify::ReadOverlaps, folder, "overlaps.csv");
    walk.overlaps.emplace();
    for (const verify::OverlapRow& row : *overlaps) walk.overlaps->push_back(row.overlap);
  }
  walk.tables.starts = StartsOf(walk.tables.half_steps, overlaps, path(folder, "half_steps.csv"));
  if (config.smoothing.stop_branches != "none") {
    walk.not_covered.push_back("stop branches, which config.yaml demands");
  }
  const auto count = [&](const char* kind) {
    return std::ranges::count(walk.certificate.not_covered, kind, &verify::NotCoveredItem::kind);
  };
  for (const verify::NotCoveredItem& item : walk.certificate.not_covered) {
    if (item.kind != "pair") walk.not_covered.push_back(item.sentence);
  }
  if (const auto pairs = count("pair"); pairs > 0) {
    walk.not_covered.push_back(
        Formatted("%td pairs of bodies that certificate.json lists as not watched", pairs));
  }
  walk.not_covered.push_back(
      "whether the files of the run belong together, and trajectory.csv (`halfstep verify`)");
  return walk;
}

}  // namespace halfstep::checker
