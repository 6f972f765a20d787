#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "experiments/checker/check_trajectory.h"
#include "experiments/config/toolbox.h"
#include "experiments/export/whole_trajectory.h"
#include "experiments/plot/plot.h"
#include "experiments/replay/simulated_robot.h"
#include "experiments/report/walk_video.h"
#include "experiments/run/exit_status.h"
#include "experiments/scenery/scenery_readers.h"
#include "experiments/survey/robot_survey.h"
#include "wpg/files/yaml_fields.h"

namespace halfstep {

struct RunCommand {
  std::string config;
  std::vector<std::string> methods;  ///< in place of smoothing.methods when not empty
  std::vector<YamlOverride> overrides;
  std::optional<std::string> out;  ///< run folder
  bool overwrite = false;
  bool quiet = false;
  bool json = false;   ///< prints the summary as one JSON object instead of a table
  Toolbox tools = {};  ///< that configs may name
};

/// `halfstep run`: plan, smooth with each method, write the run folder, print the table.
/// Throws InputError for bad input, std::runtime_error when files cannot be written.
ExitStatus Run(const RunCommand& command);

struct LiveCommand {
  RunCommand run;
  bool view = false;                  ///< serves a page
  int port = 0;                       ///< of the page; 0: any that is free
  std::optional<std::string> socket;  ///< serves messages there
  bool wait = false;                  ///< begins when a client has come
  bool in_physics = false;  ///< a simulated robot executes the walk, and is what is measured from
  replay::SimulatedRobot simulated;  ///< that robot; its controllers count
  std::vector<replay::Push> pushes;  ///< of its waist, in times of the walk
  /// Of a client that controls the robot (kClientController): how long is waited for an answer [s];
  /// none: as long as it takes.
  std::optional<double> answer_within = {};
};
/// Controller of a simulated robot: a client of the socket.
inline constexpr char kClientController[] = "client";

/// `halfstep live`: an episode of walking while the world changes, by a config with `live`, into a
/// folder; with clients it goes on until one asks for its end. kFailed when the robot does not
/// arrive, or falls in physics. Throws as Run.
ExitStatus Live(const LiveCommand& command);

struct RecoverCommand {
  std::string episode;     ///< the folder that the episode would have written
  bool overwrite = false;  ///< replaces an older one
  bool quiet = false;
  Toolbox tools = {};  ///< that configs may name
};

/// `halfstep recover`: writes the folder of an episode whose process was killed, from what it left
/// (EpisodeJournal). Throws as Run.
ExitStatus Recover(const RecoverCommand& command);

struct RobotCommand {
  SurveyRequest survey;
  std::optional<std::string> out;  ///< the robot file; none: NAME.yaml
  bool overwrite = false;
  bool quiet = false;
};

/// `halfstep robot`: a robot file of a URDF, a picture and the config of six steps beside it, and
/// what became of the six steps. kFailed when they are not certified; the files stand all the same.
/// Throws InputError for a URDF that is no robot of the class; then the robot file has what was
/// found of it, marked as refused, and nothing else is written.
ExitStatus SurveyRobotFile(const RobotCommand& command);

struct RobotCheckCommand {
  std::string robot;   ///< a shipped robot's name or a robot file
  bool json = false;   ///< one JSON object in place of the screen
  bool quiet = false;  ///< no progress and no warnings
};

/// `halfstep robot --check`: what is known of a robot, what is not, and what it can do
/// (CheckRobot). Writes no file.
ExitStatus CheckRobotFile(const RobotCheckCommand& command);

struct SceneCommand {
  std::string file;          ///< of another program
  std::string out;           ///< the scene file
  SceneryRequest request;    ///< how it is read
  std::vector<double> pose;  ///< of its frame: x, y, z [m], yaw [deg]; empty: that of the world
  double up = 0.0;           ///< by which it is moved up besides [m]
  bool overwrite = false;    ///< replaces older files
  bool quiet = false;
};

/// `halfstep scene`: a scene file of what another program has, and the meshes beside it that no
/// file has which a scene can name. Throws InputError for what cannot be read; then nothing is
/// written.
ExitStatus ConvertScene(const SceneCommand& command);

struct CheckCommand {
  std::string trajectory;                  ///< anybody's, of joints; or the folder of a run
  std::optional<std::string> method = {};  ///< of a run; none: all that are certified
  std::string robot;                       ///< URDF, robot file or shipped robot's name
  std::string scene;                       ///< file or shipped scene's name; "": no obstacles
  std::optional<checker::Interpolation> interpolation = {};  ///< none: by what the file has
  checker::TrajectoryDemands demands;                        ///< what is asked
  std::map<std::string, std::string> packages = {};          ///< of package:// names
  bool quiet = false, json = false;
};

/// `halfstep check`: whether a trajectory keeps what is asked at every time between its knots
/// (CheckTrajectory), or the walks of a run what their certificates demand (CheckWalk). kFailed
/// where that is not proved. Writes no file. Throws InputError.
ExitStatus CheckMotion(const CheckCommand& command);

struct SmoothCommand {
  RunCommand run;  ///< `config` may be a run folder too; then its config.yaml
  /// Tables of a walk of one's own: then the methods are `given` and `methods`.
  std::vector<std::string> given;
};

/// `halfstep smooth`: what `run` does, for given footsteps. Writes the result of a run folder RUN
/// into RUN-smooth unless `out` is given. Throws as Run.
ExitStatus Smooth(const SmoothCommand& command);

struct CompareCommand {
  std::vector<std::string> runs;   ///< RUN or LABEL=RUN
  std::optional<std::string> out;  ///< folder for the tables; none: the screen only
  bool overwrite = false;
  bool quiet = false;
  Toolbox tools = {};  ///< that configs may name
};

/// `halfstep compare`: methods against each other over runs. Throws InputError for what is no run,
/// or cannot be compared; then nothing is written.
ExitStatus CompareRuns(const CompareCommand& command);

struct CertifyCommand {
  std::string run;  ///< a run folder
  std::vector<YamlOverride> overrides;
  bool quiet = false;
  Toolbox tools = {};  ///< that configs may name
};

/// `halfstep certify`: makes the certificates of a run's walks again, from its config and overlaps,
/// and replaces them. kFailed when a walk is not certified. Throws InputError for a run that cannot
/// be read.
ExitStatus Certify(const CertifyCommand& command);

struct ExportCommand {
  std::vector<std::string> runs;  ///< one run folder; several for "ompl"
  std::string format;             ///< what `halfstep export -h` lists
  std::optional<std::string> method;
  std::optional<std::string> out;    ///< folder; none: RUN-FORMAT
  std::optional<double> period;      ///< between rows [s], a multiple of the run's
  std::vector<std::string> columns;  ///< globs, for csv and npz; empty: all
  TrajectoryForm form;               ///< of csv and npz
  std::vector<std::string>
      joints;  ///< globs in joint order, hrpsys, joint_trajectory, lafan1; empty: URDF's
  std::optional<int> fps;  ///< of mjlab, lafan1, json [1/s]; none: the format's
  bool all_links = false;  ///< of mjlab, json: also links that are fixed to another
  bool overwrite = false;
  bool quiet = false;
  Toolbox tools = {};  ///< that configs may name
};

/// `halfstep export`: walks of a run in other programs' formats. Throws InputError.
ExitStatus Export(const ExportCommand& command);

struct ReplayCommand {
  std::string run;  ///< folder of a run or of an episode
  std::optional<std::string> method;
  bool push = false;                 ///< finds the largest push that is survived
  int push_directions = 4;           ///< of pushes, evenly around: 4 or 8
  std::vector<double> push_at;       ///< instants [s]; none: a quarter, half, three quarters
  replay::SimulatedRobot simulated;  ///< and what moves it
  std::optional<int> seeds;          ///< plays each walk in the worlds of so many seeds; none: once
  bool suggest_tube = false;         ///< tells how wide `smoothing.tube` has to be
  /// Write METHOD/replay.csv, of an episode replay.csv, there; with seeds replays.csv.
  bool out = false;
  bool quiet = false;
  bool json = false;
  Toolbox tools = {};  ///< that configs may name
};

/// `halfstep replay`: plays the walks of a run, or the walk of an episode, on a simulated robot
/// among the obstacles. kFailed when one falls, and where no engine is compiled in. Throws
/// InputError.
ExitStatus Replay(const ReplayCommand& command);

struct ReportCommand {
  std::string run;                   ///< a run folder
  std::optional<std::string> out;    ///< the page; none: report.html in the run folder, renewed
  std::optional<std::string> video;  ///< a WebM in place of the page
  VideoOptions options;              ///< of the video
  bool overwrite = false;            ///< replaces `out` or `video` when it is there
  bool quiet = false;
  Toolbox tools = {};  ///< that configs may name
};

/// `halfstep report`: the page of a run (report/report.h), or a video of it (report/walk_video.h).
/// Throws InputError for a run that cannot be read, also when robot or scene are no longer those of
/// the run; std::runtime_error when this build has no page, or no browser draws the video.
ExitStatus Report(const ReportCommand& command);

struct PlotCommand {
  plot::PlotRequest request;
  std::string out;         ///< the file, which ends in .pdf, .svg or .png
  bool overwrite = false;  ///< replaces it when it is there
  bool quiet = false;
  Toolbox tools = {};  ///< that configs may name
};

/// `halfstep plot`: a figure of a run, a comparison or a sweep (plot/plot.h). kFailed where this
/// build cannot draw. Throws InputError as FigureOf, std::runtime_error when the file is there
/// already or cannot be written.
ExitStatus Plot(const PlotCommand& command);

struct PlanCommand {
  std::string config;
  std::vector<YamlOverride> overrides;
  bool quiet = false;
  bool json = false;
  Toolbox tools = {};  ///< that configs may name
};

/// `halfstep plan`: the footsteps to the goal, as YAML that can replace it, or as JSON. kFailed
/// when there is no plan. Throws InputError.
ExitStatus Plan(const PlanCommand& command);
/// `halfstep bake`: certifies the set of half-steps and bakes their volumes into the cache. kFailed
/// when they cannot be kept there.
ExitStatus Bake(const PlanCommand& command);
/// `halfstep list half-steps CONFIG`.
ExitStatus ListHalfSteps(const PlanCommand& command);

struct SweepCommand {
  std::string sweep;                    ///< a sweep file
  std::vector<YamlOverride> overrides;  ///< of its keys
  std::optional<std::string> out;       ///< folder; none: sweeps/NAME
  int jobs = 1;                         ///< worker processes
  bool list_cases = false;              ///< only prints the cases
  std::string one_case;                 ///< runs only this case, in this process; "": all
  std::string range;                    ///< "FROM-TO", numbers of cases from 1; "": all
  bool check = false;                   ///< only reads the configs of the cases
  bool collect = false;                 ///< writes runs.csv from cases that are done
  bool quiet = false;
  Toolbox tools = {};  ///< that configs may name
};

/// `halfstep sweep`: every case of a sweep, each by a process of its own, then runs.csv. Cases that
/// are done already are not run again. Throws InputError for bad input and for a folder of
/// something else, std::runtime_error when files cannot be written.
int Sweep(const SweepCommand& command);

struct ExplainCommand {
  std::string key;    ///< a key, or the end of one; "": all keys
  std::string robot;  ///< name or path of a robot whose defaults are told; "": their formulas
  bool json_schema = false, markdown = false;
  Toolbox tools = {};  ///< that configs may name
};

/// `halfstep explain-config`: the keys of a config as its reader declares them. Throws InputError
/// for an unknown key.
ExitStatus ExplainConfig(const ExplainCommand& command);

/// `halfstep list robots|scenes|configs|solvers|methods|planners`. Precondition: `what` is one of
/// these.
ExitStatus List(const std::string& what, bool json, const Toolbox& tools = {});

}  // namespace halfstep
