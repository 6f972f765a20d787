#include <signal.h>
#include <memory>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <iostream>
#include <map>
#include <thread>

#include "experiments/commands/command_line.h"
#include "experiments/commands/commands.h"
#include "experiments/replay/run_replay.h"
#include "experiments/report/report_page.h"
#include "experiments/report/sweep_report.h"
#include "experiments/run/interrupt.h"
#include "experiments/run/progress_bar.h"
#include "experiments/sweep/sweep_case.h"
#include "experiments/sweep/worker_processes.h"
#include "experiments/tables/csv_reader.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"
#include "wpg/files/whole_file.h"

namespace halfstep {
namespace {

std::filesystem::path OutputFolder(const SweepCommand& command, const SweepConfig& sweep) {
  if (command.out && command.out->empty()) {
    throw InputError({"--out: no folder is named (valid: a path)"});
  }
  return command.out ? std::filesystem::path(*command.out)
                     : std::filesystem::path("sweeps") / sweep.name;
}

// The case of an ID, "0007-3f2a9c1b".
SweepCase CaseOfId(const SweepConfig& sweep, const std::string& id) {
  size_t number = 0;
  std::from_chars(id.data(), id.data() + id.size(), number);
  if (number >= 1 && number <= NumSweepCases(sweep)) {
    SweepCase one = SweepCaseAt(sweep, number - 1);
    if (one.id == id) return one;
  }
  throw InputError({"--case " + Quote(id) + ": no such case (valid: what --list-cases prints)"});
}

// The cases with the numbers "FROM-TO", all when `range` is "".
std::vector<SweepCase> CasesOf(const SweepConfig& sweep, const std::string& range) {
  if (range.empty()) return SweepCases(sweep);
  const size_t last = NumSweepCases(sweep);
  const char* const end = range.data() + range.size();
  size_t from = 0, to = 0;
  const auto [dash, error] = std::from_chars(range.data(), end, from);
  const bool has_dash = error == std::errc() && dash != end && *dash == '-';
  const bool is_range = has_dash && std::from_chars(dash + 1, end, to).ptr == end;
  if (!is_range || from < 1 || to < from || to > last) {
    throw InputError({"--cases " + Quote(range) +
                      ": no numbers of cases (valid: FROM-TO from 1-1 to 1-" +
                      std::to_string(last) + ")"});
  }
  std::vector<SweepCase> cases;
  for (size_t number = from; number <= to; ++number) {
    cases.push_back(SweepCaseAt(sweep, number - 1));
  }
  return cases;
}

std::vector<SweepCase> Missing(const SweepFolder& folder, const std::vector<SweepCase>& cases) {
  std::vector<SweepCase> missing;
  std::copy_if(cases.begin(), cases.end(), std::back_inserter(missing),
               [&](const SweepCase& one) { return !folder.IsDone(one); });
  return missing;
}

// The command that does one case; the folder is named, so that it is the same one.
std::vector<std::string> CaseArguments(const SweepCommand& command, const SweepFolder& folder,
                                       const SweepCase& one) {
  std::vector<std::string> arguments = {"sweep", command.sweep, "--case",
                                        one.id,  "--out",       folder.path().string()};
  for (const YamlOverride& set : command.overrides) {
    arguments.push_back("--set");
    arguments.push_back(set.key + "=" + set.value);
  }
  return arguments;
}

// Signals that a program raises by its own mistake; others come from outside, and the case is done
// again next time.
bool IsCrash(int signal) {
  return signal == SIGSEGV || signal == SIGBUS || signal == SIGFPE || signal == SIGILL ||
         signal == SIGABRT;
}

std::vector<NotCovered> ThingsOf(const SweepFolder& folder, const std::vector<SweepCase>& cases) {
  std::vector<NotCovered> things;
  for (const SweptNotCovered& one : folder.NotCoveredOf(cases)) things.push_back(one.thing);
  return things;
}

int Finish(const SweepCommand& command, const SweepFolder& folder,
           const std::vector<SweepCase>& cases) {
  const CsvTable runs = ParseCsv(folder.Collect(cases), "runs.csv");
  const std::filesystem::path report = folder.path() / "report.html";
  if (HasReport()) WriteWhole(report, {SweepReport(folder.path(), report)});
  if (command.quiet) return kSuccess;
  std::map<std::string, int> statuses;
  for (const std::string& status : runs.Texts("status")) ++statuses[status];
  std::cout << folder.sweep().name << ": " << cases.size() << " cases, " << runs.rows.size()
            << " rows:";
  std::string separator = " ";
  for (const auto& [status, count] : statuses) {
    std::cout << separator << count << " " << status;
    separator = ", ";
  }
  const std::vector<std::string> certified = runs.Texts("certified");
  std::cout << "; " << std::count(certified.begin(), certified.end(), "true") << " certified\n"
            << NotCoveredText(ThingsOf(folder, cases), "not_covered.json")
            << "written: " << (HasReport() ? report : folder.path() / "runs.csv").string() << '\n';
  return kSuccess;
}

// Runs those of the cases that are missing, each in a process of its own, and collects them when
// they are all cases of the sweep.
int RunAll(const SweepCommand& command, const SweepFolder& folder,
           const std::vector<SweepCase>& cases, InterruptGuard& interrupt) {
  const std::vector<SweepCase> missing = Missing(folder, cases);
  if (!command.quiet && missing.size() < cases.size()) {
    std::cout << cases.size() - missing.size() << " of " << cases.size()
              << " cases are done already\n"
              << std::flush;
  }
  interrupt.Keep();  // the cases that are under way end first
  std::vector<std::vector<std::string>> arguments;
  for (const SweepCase& one : missing) arguments.push_back(CaseArguments(command, folder, one));
  size_t done = 0;
  int failure = kSuccess;
  {
    ProgressBar bar(folder.sweep().name, command.quiet);
    RunWorkers(
        arguments, command.jobs,
        [&](size_t index, const WorkerEnd& end) {
          const SweepCase& one = missing[index];
          if (IsCrash(end.signal)) {
            WriteSweepFailure(folder, one, "crashed",
                              "ended by signal " + std::to_string(end.signal) + " (" +
                                  strsignal(end.signal) + ")",
                              end.wall);
          } else if (end.status != kSuccess) {
            const bool stopped = end.signal != 0 || end.status == kInterrupted;
            if (!stopped) failure = end.status;
            return stopped;
          }
          ++done;
          return true;
        },
        [&] { bar.Update(static_cast<double>(done) / static_cast<double>(missing.size())); },
        interrupt.token());
  }
  if (done == missing.size()) {
    return command.range.empty() ? Finish(command, folder, cases) : kSuccess;
  }
  std::cerr << "halfstep: " << (interrupt.requested() ? "stopped; " : "") << missing.size() - done
            << " of " << cases.size() << " cases are not done (the same command goes on)\n";
  return interrupt.requested() ? kInterrupted : failure != kSuccess ? failure : kFailed;
}

}  // namespace

int Sweep(const SweepCommand& command) {
  InterruptGuard interrupt;
  const bool all = command.one_case.empty() && command.range.empty();
  const SweepConfig sweep =
      LoadSweep(command.sweep, command.overrides, all && !command.collect && !command.list_cases,
                command.tools);
  if (command.check) {
    if (!command.quiet) std::cout << sweep.name << ": " << NumSweepCases(sweep) << " cases\n";
    return kSuccess;
  }
  if (!command.one_case.empty()) {
    const SweepCase one = CaseOfId(sweep, command.one_case);
    return DoSweepCase(SweepFolder(OutputFolder(command, sweep), sweep), one, interrupt.token(),
                       replay::ReplayerOf);
  }
  const std::vector<SweepCase> cases = CasesOf(sweep, command.range);
  if (command.list_cases) {
    for (const SweepCase& one : cases) std::cout << one.id << " " << OverrideText(one) << '\n';
    return kSuccess;
  }
  const SweepFolder folder(OutputFolder(command, sweep), sweep);
  if (!command.collect) return RunAll(command, folder, cases, interrupt);
  const std::vector<SweepCase> missing = Missing(folder, cases);
  if (missing.empty()) return Finish(command, folder, cases);
  std::cerr << "halfstep: " << missing.size() << " of " << cases.size()
            << " cases are not done, the first is " << missing.front().id << '\n';
  return kFailed;
}

CommandAction DeclareSweep(CLI::App* app, const Toolbox& tools) {
  const auto command = std::make_shared<SweepCommand>();
  command->tools = tools;
  const auto sets = std::make_shared<std::vector<std::string>>();
  command->jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  app->add_option("SWEEP", command->sweep, "sweep, a YAML file or a shipped one's name")
      ->required();
  DeclareOverrides(app, "the sweep file", sets.get());
  app->add_option("--out", command->out, "folder (default: sweeps/NAME)");
  app->add_option("--jobs", command->jobs, "cases at a time (default: as many as cores)")
      ->check(CLI::Range(1, 1024));
  CLI::Option* list_cases =
      app->add_flag("--list-cases", command->list_cases, "print the cases and their keys");
  CLI::Option* one_case =
      app->add_option("--case", command->one_case, "do this one only, for schedulers")
          ->excludes(list_cases);
  CLI::Option* range =
      app->add_option("--cases", command->range, "do those with the numbers FROM-TO only")
          ->excludes(list_cases)
          ->excludes(one_case);
  app->add_flag("--check", command->check, "read the configs of the cases and do none")
      ->excludes(list_cases)
      ->excludes(one_case)
      ->excludes(range);
  app->add_flag("--collect", command->collect, "write runs.csv from cases that are done")
      ->excludes(list_cases)
      ->excludes(one_case)
      ->excludes(range);
  app->add_flag("--quiet", command->quiet, "print nothing but errors");
  return [command, sets] {
    command->overrides = ParseOverrides(*sets);
    return Sweep(*command);
  };
}

}  // namespace halfstep
