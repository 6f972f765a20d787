#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "experiments/config/toolbox.h"
#include "planner/scene/scene.h"
#include "wpg/files/yaml_fields.h"

namespace halfstep {

/// What a command does once its options are read. Returns the exit status; throws as the commands
/// of commands.h.
using CommandAction = std::function<int()>;

/// A command of `halfstep`: its name, its help, and the function that declares its options, for
/// configs that may name what `tools` hold.
struct CommandEntry {
  const char* name;
  const char* help;
  CommandAction (*declare)(CLI::App* app, const Toolbox& tools);
};

/// Every command. To add one, write its file with a Declare function and add a row in the source.
std::span<const CommandEntry> CommandEntries();

/// A command as it is declared in a program, and what it does.
using DeclaredCommand = std::pair<CLI::App*, CommandAction>;

/// Declares all commands and options of the program in `app`.
std::vector<DeclaredCommand> DeclareProgram(CLI::App* app, const Toolbox& tools);

/// Declares `--set KEY=VALUE`, repeatable, for the keys of `what`.
void DeclareOverrides(CLI::App* app, const std::string& what, std::vector<std::string>* sets);
/// Parses the assignments KEY=VALUE of an option. Throws InputError for a text that is none.
std::vector<YamlOverride> ParseOverrides(const std::vector<std::string>& sets,
                                         const std::string& option = "--set");

struct ExperimentConfig;
struct RobotModel;
struct RunCommand;
/// Declares --overwrite, --quiet and --json, for commands that write a run.
void DeclareRunFlags(CLI::App* app, RunCommand* command);
/// Declares --method of a command that smooths.
void DeclareMethods(CLI::App* app, RunCommand* command);

/// The folder that a command writes: `--out`, the config's, or runs/NAME. Throws InputError for an
/// empty `--out`.
std::filesystem::path OutputFolder(const RunCommand& command, const ExperimentConfig& config);

/// What of the robot's URDF and of the scene was repaired, left out or made larger, on standard
/// error.
void TellWarnings(const RobotModel& robot, const Scene& scene = {});

/// Lines under a heading, on standard error.
void TellUnder(const std::string& heading, const std::vector<std::string>& lines);

CommandAction DeclareInit(CLI::App* app, const Toolbox& tools);
CommandAction DeclareRun(CLI::App* app, const Toolbox& tools);
CommandAction DeclareSmooth(CLI::App* app, const Toolbox& tools);
CommandAction DeclareCompare(CLI::App* app, const Toolbox& tools);
CommandAction DeclarePlan(CLI::App* app, const Toolbox& tools);
CommandAction DeclareBake(CLI::App* app, const Toolbox& tools);
CommandAction DeclareDraw(CLI::App* app, const Toolbox& tools);
CommandAction DeclareCertify(CLI::App* app, const Toolbox& tools);
CommandAction DeclareVerify(CLI::App* app, const Toolbox& tools);
CommandAction DeclareSweep(CLI::App* app, const Toolbox& tools);
CommandAction DeclareExplain(CLI::App* app, const Toolbox& tools);
CommandAction DeclareReport(CLI::App* app, const Toolbox& tools);
CommandAction DeclarePlot(CLI::App* app, const Toolbox& tools);
CommandAction DeclareExport(CLI::App* app, const Toolbox& tools);
CommandAction DeclareReplay(CLI::App* app, const Toolbox& tools);
CommandAction DeclareList(CLI::App* app, const Toolbox& tools);
CommandAction DeclareLive(CLI::App* app, const Toolbox& tools);
CommandAction DeclareRecover(CLI::App* app, const Toolbox& tools);
CommandAction DeclareRobot(CLI::App* app, const Toolbox& tools);
CommandAction DeclareScene(CLI::App* app, const Toolbox& tools);
CommandAction DeclareCheck(CLI::App* app, const Toolbox& tools);
CommandAction DeclareBench(CLI::App* app, const Toolbox& tools);

}  // namespace halfstep
