#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "experiments/about/build_info.h"
#include "experiments/commands/command_line.h"
#include "experiments/commands/command_mistake.h"
#include "experiments/commands/commands.h"
#include "experiments/config/experiment.h"
#include "experiments/config/folder_name.h"
#include "experiments/export/footstep_files.h"
#include "experiments/export/frame_files.h"
#include "experiments/export/hrpsys_files.h"
#include "experiments/export/joint_trajectory.h"
#include "experiments/export/npz_file.h"
#include "experiments/export/ompl_log.h"
#include "experiments/replay/mujoco_keyframes.h"
#include "experiments/tables/certificate_files.h"
#include "experiments/tables/csv_subset.h"
#include "experiments/tables/given_walk_file.h"
#include "experiments/tables/result_tables.h"
#include "experiments/tables/run_folder.h"
#include "experiments/tables/trajectory_match.h"
#include "smoothing/walk/footstep_families.h"
#include "wpg/files/input_error.h"
#include "wpg/files/number_text.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;

constexpr double kKeyPeriod = 0.05;  // of mjcf's keyframes, where nothing else is asked for [s]

void Refuse(const std::string& what) { throw InputError({what}); }

// Options that the format would ignore are mistakes.
void CheckOptions(const ExportCommand& command) {
  const bool ompl = command.format == "ompl";
  if (!ompl && command.runs.size() != 1) Refuse("RUN: --format " + command.format + " takes one");
  if (ompl && command.method) Refuse("--method: --format ompl exports all methods");
  const auto only_of = [&](const std::string& option, bool is_set,
                           const std::vector<std::string>& formats) {
    if (!is_set || std::ranges::find(formats, command.format) != formats.end()) return;
    std::string valid;
    for (const std::string& format : formats) valid += (valid.empty() ? "" : ", ") + format;
    Refuse(option + ": not of --format " + command.format + " (valid: " + valid + ")");
  };
  only_of("--period", command.period.has_value(),
          {"csv", "npz", "hrpsys", "joint_trajectory", "mjcf"});
  only_of("--columns", !command.columns.empty(), {"csv", "npz"});
  only_of("--all-joints", command.form.all_joints, {"csv", "npz"});
  only_of("--waist", command.form.waist_quaternion, {"csv", "npz"});
  only_of("--joints", !command.joints.empty(), {"hrpsys", "joint_trajectory", "lafan1"});
  only_of("--fps", command.fps.has_value(), {"mjlab", "lafan1", "json"});
  only_of("--all-links", command.all_links, {"mjlab", "json"});
  if (command.out && command.out->empty()) Refuse("--out: no folder is named (valid: a path)");
}

fs::path OutputFolder(const ExportCommand& command) {
  if (command.out) return *command.out;
  fs::path run = fs::path(command.runs.front()).lexically_normal();
  if (!run.has_filename()) run = run.parent_path();
  return run += "-" + command.format;
}

// How many rows of a trajectory.csv, `apart` [s], make a period.
size_t Stride(double apart, const std::optional<double>& period) {
  if (!period) return 1;
  const double rows = *period / apart;
  if (!(rows > 0.5) || std::abs(rows - std::round(rows)) > 1e-6) {
    Refuse("--period " + ShortestText(*period) +
           ": is no multiple of the run's output.period_s (valid: " + ShortestText(apart) + ", " +
           ShortestText(2 * apart) + ", ...)");
  }
  return static_cast<size_t>(std::lround(rows));
}

/// The walks of a run on their way into one format, method by method.
class WalkExport {
 public:
  WalkExport(const ExportCommand& command, RunFolder* folder)
      : command_(command),
        run_(command.runs.front()),
        config_(LoadConfig((run_ / "config.yaml").string(), {}, command.tools)),
        whole_(LoadWholeRobot(RobotPath(config_).string())),
        joints_(OrderedJoints(whole_.tree, command.joints)),
        folder_(*folder) {
    if (command.format == "mjcf") world_ = World();
    frames_ = FindFrameFormat(command.format);
    if (IsOfMotion()) experiment_ = Prepare(config_);
    if (frames_ != nullptr) bodies_.emplace(RobotPath(config_).string());
  }

  void Write(const std::string& method) {
    const std::string name = MethodFolder(method);
    const std::string trajectory = (run_ / name / "trajectory.csv").string();
    period_ = PeriodOf(trajectory);
    stride_ = command_.format == "mjcf" && !command_.period
                  ? static_cast<size_t>(std::max(1L, std::lround(kKeyPeriod / period_)))
                  : Stride(period_, command_.period);
    if (IsOfMotion()) return WriteMotion(name, trajectory);
    if (command_.format == "hrpsys") return WriteHrpsysFiles(name, trajectory);
    const DeclaredTable whole =
        InForm(ReadCsv(trajectory), whole_.model, whole_.tree, command_.form);
    const CsvFile table = CsvSubset(whole.table, whole.columns, command_.columns, stride_);
    if (command_.format == "csv") return WriteCsv(name, table, &folder_);
    folder_.Write(name + ".npz", NpzFile(table, trajectory));
  }

 private:
  // Formats that need the walk itself, for derivatives or where its feet stand.
  bool IsOfMotion() const {
    return frames_ != nullptr || IsOfFootsteps() || command_.format == "mjcf" ||
           command_.format == "joint_trajectory";
  }
  bool IsOfFootsteps() const {
    return command_.format == "footsteps" || command_.format == "humanoid_nav_msgs";
  }
  // Between the rows of a trajectory.csv [s].
  double PeriodOf(const std::string& trajectory) const {
    if (config_.output_period) return *config_.output_period;
    const std::vector<TrajectoryRow> rows = ReadTrajectory(trajectory, whole_.model);
    return RowPeriodOf(config_, rows.size() > 1 ? rows[1].t : kRowPeriod);
  }

  replay::SimulatedObstacles World() const {
    const auto scene = ScenePath(config_);
    if (!scene) return {};
    replay::SimulatedObstacles world = replay::ObstaclesOf(LoadScene(scene->string()));
    for (const std::string& note : world.notes) std::cerr << "halfstep: " << note << '\n';
    return world;
  }

  void WriteHrpsysFiles(const std::string& name, const std::string& trajectory) {
    const double period = static_cast<double>(stride_) * period_;
    const HrpsysFiles files =
        WriteHrpsys(whole_.model, whole_.tree, joints_, ReadTrajectory(trajectory, whole_.model),
                    stride_, period);
    folder_.Write(name + ".pos", files.pos);
    folder_.Write(name + ".zmp", files.zmp);
    folder_.Write(name + ".waist", files.waist);
    folder_.Write(name + ".joints", files.joints);
  }

  void WriteMotion(const std::string& name, const std::string& trajectory) {
    const CsvTable table = ReadCsv(trajectory);
    const std::vector<TrajectoryRow> rows = ReadTrajectory(trajectory, whole_.model);
    const HalfStepSequence& sequence = experiment_->sequence;
    const SuperposedWalk walk(sequence, ReadParameters(run_ / name, sequence));
    const std::string mismatch = TrajectoryMismatch(whole_.model, walk, table);
    if (!mismatch.empty()) {
      Refuse(trajectory + ": is not of the walk that config and tables make: " + mismatch +
             " (valid: a run as it was written)");
    }
    if (IsOfFootsteps()) return WriteFootsteps(name, walk);
    if (frames_ != nullptr) return WriteFrames(name, walk, trajectory);
    const std::vector<JointMotion> motion =
        MotionOfRows(whole_.model, walk, rows, stride_, trajectory);
    if (command_.format == "mjcf") {
      folder_.Write(name + ".xml",
                    replay::MujocoKeyframes(whole_.model, whole_.tree, world_, motion));
    } else {
      folder_.Write(name + ".yaml",
                    JointTrajectoryYaml(whole_.model, whole_.tree, joints_, motion));
    }
  }

  void WriteFootsteps(const std::string& name, const SuperposedWalk& walk) {
    const HalfStepSequence steps = WithFootsteps(experiment_->sequence, walk.parameters());
    if (command_.format == "footsteps") return WriteCsv(name, FootstepsCsv(steps), &folder_);
    folder_.Write(name + ".yaml", StepTargetsYaml(steps));
  }

  void WriteFrames(const std::string& name, const SuperposedWalk& walk, const std::string& path) {
    const FrameFileOptions options{.fps = command_.fps.value_or(frames_->fps),
                                   .joints = joints_,
                                   .all_links = command_.all_links};
    folder_.Write(
        name + frames_->ending,
        FrameFile(*frames_, *bodies_, FramesOf(*bodies_, walk, options.fps, path), options, path));
  }

  const ExportCommand& command_;
  fs::path run_;
  ExperimentConfig config_;
  WholeRobot whole_;
  std::vector<int> joints_;
  RunFolder& folder_;
  double period_ = kRowPeriod;  // of the method that is written
  size_t stride_ = 1;
  replay::SimulatedObstacles world_;
  std::optional<Experiment> experiment_;
  const FrameFormat* frames_ = nullptr;  // null: a format of something else
  std::optional<BodyMotion> bodies_;     // of such a format
};

}  // namespace

ExitStatus Export(const ExportCommand& command) {
  CheckOptions(command);
  for (const std::string& run : command.runs) MethodsOfRun(run, std::nullopt);
  RunFolder folder(OutputFolder(command), command.overwrite);
  if (command.format == "ompl") {
    for (const auto& [scenario, log] : OmplLogs(command.runs)) folder.Write(scenario + ".log", log);
  } else {
    WalkExport walks(command, &folder);
    for (const std::string& method : MethodsOfRun(command.runs.front(), command.method)) {
      walks.Write(method);
    }
  }
  nlohmann::ordered_json manifest = {{"format", 1},         {"program", "halfstep"},
                                     {"kind", "export"},    {"version", kVersion},
                                     {"commit", kCommit},   {"exported", command.format},
                                     {"runs", command.runs}};
  folder.Write(
      "manifest.json",
      manifest.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
  folder.Publish();
  if (!command.quiet) std::cout << "written: " << folder.path().string() << '\n';
  return kSuccess;
}

CommandAction DeclareExport(CLI::App* app, const Toolbox& tools) {
  const auto command = std::make_shared<ExportCommand>();
  command->tools = tools;
  app->add_option("RUN", command->runs, "run folder; several for ompl")->required();
  app->add_option("--format", command->format,
                  "csv: columns of trajectory.csv; npz: the same as NumPy arrays; hrpsys: files of "
                  "its SequencePlayer; joint_trajectory: ROS' trajectory_msgs/JointTrajectory as "
                  "YAML; mjcf: robot, obstacles and keyframes for MuJoCo; mjlab: motion of joints "
                  "and bodies as mjlab and BeyondMimic load it; lafan1: CSV of the retargeted "
                  "LAFAN1; json: the same with names; footsteps: CSV; humanoid_nav_msgs: "
                  "StepTargets as YAML; ompl: benchmark logs")
      ->required()
      ->check(OneOf({"csv", "npz", "hrpsys", "joint_trajectory", "mjcf", "mjlab", "lafan1", "json",
                     "footsteps", "humanoid_nav_msgs", "ompl"}));
  app->add_option("--method", command->method, "only this one (default: all)");
  app->add_option("--out", command->out, "folder (default: RUN-FORMAT)");
  app->add_option("--period", command->period,
                  "between rows [s] (default: the run's; mjcf: about 0.05)");
  app->add_option("--columns", command->columns, "csv, npz: patterns of columns (default: all)");
  app->add_flag("--all-joints", command->form.all_joints,
                "csv, npz: columns for all joints of the robot, not only those of the legs");
  const auto waist = std::make_shared<std::string>();
  app->add_option("--waist", *waist,
                  "csv, npz: yaw, or quaternion: waist_qw, qx, qy, qz in place of waist_yaw_rad "
                  "(default: yaw)")
      ->check(OneOf({"yaw", "quaternion"}));
  app->add_option("--joints", command->joints,
                  "hrpsys, joint_trajectory, lafan1: patterns of joints in their order (default: "
                  "the URDF's)");
  app->add_option("--fps", command->fps,
                  "mjlab, lafan1, json: frames a second (default: 50; lafan1: 30)")
      ->check(CLI::Range(1, 1000));
  app->add_flag("--all-links", command->all_links,
                "mjlab, json: also links that are fixed to another");
  app->add_flag("--overwrite", command->overwrite, "replace an older export");
  app->add_flag("--quiet", command->quiet, "print nothing but errors");
  return [command, waist] {
    command->form.waist_quaternion = *waist == "quaternion";
    return Export(*command);
  };
}

}  // namespace halfstep
