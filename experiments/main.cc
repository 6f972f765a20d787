#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <new>
#include <thread>

#include "experiments/build_info.h"
#include "experiments/commands/commands.h"
#include "experiments/commands/printable_stream.h"
#include "experiments/config/random_scenes.h"
#include "experiments/verify/verify_run.h"
#include "wpg/files/input_error.h"

namespace {

using namespace halfstep;

YamlOverride ParseOverride(const std::string& text) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw InputError(
        {"--set " + text + ": not an assignment (valid: --set smoothing.sampling_s=0.002)"});
  }
  return {text.substr(0, equals), text.substr(equals + 1)};
}

// `halfstep verify`: nothing of the smoothing takes part.
ExitStatus Verify(const verify::VerifyOptions& options, bool quiet) {
  ExitStatus status = kSuccess;
  for (const verify::MethodVerification& result : verify::VerifyRun(options)) {
    if (!quiet) std::cout << verify::Describe(result);
    for (const std::string& complaint : result.complaints) std::cerr << complaint << '\n';
    if (quiet && result.disagreements > 0) {
      std::cerr << result.method << ": NOT verified: " << result.reasons.front() << '\n';
    }
    if (quiet && result.disagreements == 0 && !result.too_coarse.empty()) {
      std::cerr << result.method << ": too coarse to verify: " << result.too_coarse << '\n';
    }
    // Of several methods the worst counts.
    const ExitStatus of_method = !result.readable           ? kBadInput
                                 : result.disagreements > 0 ? kNotVerified
                                 : result.verified          ? kSuccess
                                                            : kTooCoarse;
    if (of_method == kBadInput || status == kSuccess ||
        (status == kTooCoarse && of_method == kNotVerified)) {
      status = of_method;
    }
  }
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  const PrintableStream out(&std::cout), err(&std::cerr);
  CLI::App app{
      "Plans and smooths humanoid walks made of half-steps.\n\n"
      "  example: halfstep run experiments/configs/bar_8cm.yaml"};
  app.set_version_flag("--version", std::string(kVersion) + " (" + std::string(kCommit) + ")");
  app.require_subcommand(0, 1);  // none at all is told below, so that a misspelt one is named

  RunCommand run;
  std::vector<std::string> sets;
  CLI::App* run_app =
      app.add_subcommand("run",
                         "Concatenate, smooth with each method, write the run folder.\n\n"
                         "  example: halfstep run experiments/configs/bar_8cm.yaml --set "
                         "smoothing.margins.clearance_m=0.004");
  run_app->add_option("CONFIG", run.config, "experiment, a YAML file")->required();
  run_app->add_option("--set", sets, "override a key of the config: KEY=VALUE")
      ->allow_extra_args(false);
  run_app->add_option("--out", run.out, "run folder (default: output.directory, or runs/NAME)");
  run_app->add_flag("--overwrite", run.overwrite, "replace an older run");
  run_app->add_flag("--quiet", run.quiet, "print nothing but errors");
  run_app->add_flag("--json", run.json, "print the summary as JSON");

  SmoothCommand smooth;
  std::vector<std::string> smooth_sets;
  CLI::App* smooth_app = app.add_subcommand(
      "smooth",
      "Smooth given footsteps with each method, write a run folder.\n\n"
      "  example: halfstep smooth runs/bar_8cm --method ipopt --method halfstep/barrier");
  smooth_app->add_option("CONFIG", smooth.run.config, "config with footsteps, or a run folder")
      ->required();
  smooth_app->add_option("--method", smooth.methods, "in place of smoothing.methods; repeatable")
      ->allow_extra_args(false);
  smooth_app->add_option("--set", smooth_sets, "override a key of the config: KEY=VALUE")
      ->allow_extra_args(false);
  smooth_app->add_option("--out", smooth.run.out,
                         "run folder (default: as `run`; RUN-smooth of a run folder)");
  smooth_app->add_flag("--overwrite", smooth.run.overwrite, "replace an older run");
  smooth_app->add_flag("--quiet", smooth.run.quiet, "print nothing but errors");
  smooth_app->add_flag("--json", smooth.run.json, "print the summary as JSON");

  CompareCommand compare;
  CLI::App* compare_app =
      app.add_subcommand("compare",
                         "Compare the methods of runs; failures count as failures.\n\n"
                         "  example: halfstep compare runs/bar_5cm runs/bar_8cm --out runs/bars");
  compare_app->add_option("RUN", compare.runs, "run folder, or LABEL=RUN")->required();
  compare_app->add_option("--out", compare.out, "folder for the tables as CSV");
  compare_app->add_flag("--overwrite", compare.overwrite, "replace an older comparison");
  compare_app->add_flag("--quiet", compare.quiet, "print nothing but errors");

  CertifyCommand certify;
  std::vector<std::string> certify_sets;
  CLI::App* certify_app = app.add_subcommand(
      "certify",
      "Prove the walks of a run for all time and write the certificates.\n\n"
      "  example: halfstep certify runs/bar_8cm --set smoothing.resolution_s=1e-5");
  certify_app->add_option("RUN", certify.run, "run folder")->required();
  certify_app->add_option("--set", certify_sets, "override a key of the run's config: KEY=VALUE")
      ->allow_extra_args(false);
  certify_app->add_flag("--quiet", certify.quiet, "print nothing but errors");

  verify::VerifyOptions verify;
  bool verify_quiet = false;
  CLI::App* verify_app = app.add_subcommand(
      "verify",
      "Check a run's certificates independently: played motion, forward kinematics, distances\n"
      "of its own; none of the code that smoothed. Exit status 3 when it disagrees, 4 when the\n"
      "rows are too coarse to tell.\n\n"
      "  example: halfstep verify runs/bar_8cm --method dichotomy");
  verify_app->add_option("RUN", verify.run, "run folder")->required();
  verify_app->add_option("--method", verify.method, "only this one (default: all)");
  verify_app->add_option("--tolerance", verify.tolerance,
                         "between the certified walk and its trajectory, 0.001 by default [m]");
  verify_app->add_option("--robot", verify.robot, "robot file in place of the certificate's");
  verify_app->add_option("--scene", verify.scene, "scene file in place of it, or none");
  verify_app->add_flag("--quiet", verify_quiet, "print nothing but what is wrong");

  ExportCommand exported;
  CLI::App* export_app = app.add_subcommand(
      "export",
      "Write the walks of a run in other programs' formats.\n\n"
      "  example: halfstep export runs/bar_8cm --format hrpsys --method dichotomy\n"
      "  example: halfstep export runs/bar_8cm --format csv --columns 'com_*' 'q_R*'");
  export_app->add_option("RUN", exported.runs, "run folder; several for ompl")->required();
  export_app->add_option("--format", exported.format, "csv, hrpsys or ompl")
      ->required()
      ->check(CLI::IsMember({"csv", "hrpsys", "ompl"}));
  export_app->add_option("--method", exported.method, "only this one (default: all)");
  export_app->add_option("--out", exported.out, "folder (default: RUN-FORMAT)");
  export_app->add_option("--period", exported.period, "between rows [s] (default: the run's)");
  export_app->add_option("--columns", exported.columns, "csv: patterns of columns (default: all)");
  export_app->add_option("--joints", exported.joints,
                         "hrpsys: patterns of joints in their order (default: the URDF's)");
  export_app->add_flag("--overwrite", exported.overwrite, "replace an older export");
  export_app->add_flag("--quiet", exported.quiet, "print nothing but errors");

  ReplayCommand replay;
  std::string engine = "mujoco";
  CLI::App* replay_app = app.add_subcommand(
      "replay",
      "Play the walks of a run on a robot with masses and contacts, by simulation.\n\n"
      "  example: halfstep replay runs/bar_8cm --method dichotomy --push");
  replay_app->add_option("RUN", replay.run, "run folder")->required();
  replay_app->add_option("--engine", engine, "mujoco")->check(CLI::IsMember({"mujoco"}));
  replay_app->add_option("--method", replay.method, "only this one (default: all)");
  replay_app->add_flag("--push", replay.push, "find the largest push that each walk survives");
  replay_app->add_option("--push-at", replay.push_at, "instants of the push [s]");
  replay_app->add_flag("--out", replay.out, "write METHOD/replay.csv into the run folder");
  replay_app->add_flag("--quiet", replay.quiet, "print nothing but errors");
  replay_app->add_flag("--json", replay.json, "print JSON");
  ReportCommand report;
  CLI::App* report_app =
      app.add_subcommand("report",
                         "Write a run's report anew: one HTML file that shows its walks.\n\n"
                         "  example: halfstep report runs/bar_8cm --out bar_8cm.html");
  report_app->add_option("RUN", report.run, "run folder")->required();
  report_app->add_option("--out", report.out, "the file (default: report.html in the run folder)");
  report_app->add_flag("--overwrite", report.overwrite, "replace --out");
  report_app->add_flag("--quiet", report.quiet, "print nothing but errors");

  PlanCommand plan;
  std::vector<std::string> plan_sets;
  CLI::App* plan_app = app.add_subcommand(
      "plan",
      "Plan footsteps to the goal of a config and print them as YAML.\n\n"
      "  example: halfstep plan experiments/configs/island.yaml --set planner.name=astar");
  CLI::App* bake_app = app.add_subcommand(
      "bake",
      "Certify a config's set of half-steps and bake their swept volumes into the cache.\n\n"
      "  example: halfstep bake experiments/configs/island.yaml");
  for (CLI::App* planning : {plan_app, bake_app}) {
    planning->add_option("CONFIG", plan.config, "experiment, a YAML file")->required();
    planning->add_option("--set", plan_sets, "override a key of the config: KEY=VALUE")
        ->allow_extra_args(false);
    planning->add_flag("--quiet", plan.quiet, "print nothing but errors");
    planning->add_flag("--json", plan.json, "print JSON");
  }

  std::string draw_name;
  int draw_count = 40, draw_seed = 1;
  CLI::App* draw_app = app.add_subcommand("draw",
                                          "Print a scene that is drawn at random, as YAML.\n\n"
                                          "  example: halfstep draw cylinders --count 40 --seed 1");
  draw_app->add_option("WHAT", draw_name, "cylinders or random_room")
      ->required()
      ->check(CLI::IsMember(RandomSceneNames()));
  draw_app->add_option("--count", draw_count, "obstacles (default: 40)")
      ->check(CLI::Range(0, 100000));
  draw_app->add_option("--seed", draw_seed, "of the draw (default: 1)")
      ->check(CLI::Range(0, 2147483647));

  SweepCommand sweep;
  std::vector<std::string> sweep_sets;
  CLI::App* sweep_app = app.add_subcommand(
      "sweep",
      "Run a config with every combination of some keys; the same command goes on where it was\n"
      "stopped.\n\n"
      "  example: halfstep sweep experiments/sweeps/bar_8cm_speed_clearance.yaml --jobs 2");
  sweep.jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  sweep_app->add_option("SWEEP", sweep.sweep, "sweep, a YAML file")->required();
  sweep_app->add_option("--set", sweep_sets, "override a key of the sweep file: KEY=VALUE")
      ->allow_extra_args(false);
  sweep_app->add_option("--out", sweep.out, "folder (default: sweeps/NAME)");
  sweep_app->add_option("--jobs", sweep.jobs, "cases at a time (default: as many as cores)")
      ->check(CLI::Range(1, 1024));
  CLI::Option* list_cases =
      sweep_app->add_flag("--list-cases", sweep.list_cases, "print the cases and their keys");
  CLI::Option* one_case =
      sweep_app->add_option("--case", sweep.one_case, "do this one only, for schedulers")
          ->excludes(list_cases);
  sweep_app->add_flag("--collect", sweep.collect, "write runs.csv from cases that are done")
      ->excludes(list_cases)
      ->excludes(one_case);
  sweep_app->add_flag("--quiet", sweep.quiet, "print nothing but errors");

  ExplainCommand explain;
  CLI::App* explain_app =
      app.add_subcommand("explain-config",
                         "Every key of a config: type, unit, default, range, meaning.\n\n"
                         "  example: halfstep explain-config smoothing.margins");
  explain_app->add_option("KEY", explain.key, "a key or its last part (default: all)");
  explain_app->add_flag("--json-schema", explain.json_schema, "print a JSON schema, for editors");
  explain_app->add_flag("--markdown", explain.markdown, "print a Markdown table");

  std::string what;
  std::string list_config;
  bool list_json = false;
  CLI::App* list_app =
      app.add_subcommand("list", "What there is.\n\n  example: halfstep list methods");
  list_app->add_option("WHAT", what, "robots, scenes, solvers, methods, planners or half-steps")
      ->required()
      ->check(CLI::IsMember({"robots", "scenes", "solvers", "methods", "planners", "half-steps"}));
  list_app->add_option("CONFIG", list_config, "whose half-steps (half-steps only)");
  list_app->add_flag("--json", list_json, "print JSON");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kSuccess : kBadInput;
  }
  if (app.get_subcommands().empty()) {
    std::cerr << "halfstep: which command? (valid: run, smooth, compare, plan, bake, draw, "
                 "certify, verify, sweep, explain-config, report, export, replay, list; "
                 "`halfstep -h` explains)\n";
    return kBadInput;
  }
  try {
    if (*run_app) {
      for (const std::string& set : sets) run.overrides.push_back(ParseOverride(set));
    }
    for (const std::string& set : smooth_sets) smooth.run.overrides.push_back(ParseOverride(set));
    for (const std::string& set : certify_sets) certify.overrides.push_back(ParseOverride(set));
    if (*draw_app) {
      std::cout << DrawScene(draw_name, draw_count, static_cast<std::uint64_t>(draw_seed));
      return std::cout.flush() ? kSuccess : kFailed;
    }
    for (const std::string& set : sweep_sets) sweep.overrides.push_back(ParseOverride(set));
    for (const std::string& set : plan_sets) plan.overrides.push_back(ParseOverride(set));
    if (*list_app && what == "half-steps") {
      if (list_config.empty()) {
        throw InputError({"list half-steps: of which config? (valid: a YAML file)"});
      }
      plan.config = list_config;
      plan.json = list_json;
    }
    const int status = *run_app               ? Run(run)
                       : *smooth_app          ? Smooth(smooth)
                       : *compare_app         ? CompareRuns(compare)
                       : *plan_app            ? Plan(plan)
                       : *bake_app            ? Bake(plan)
                       : !plan.config.empty() ? ListHalfSteps(plan)
                       : *certify_app         ? Certify(certify)
                       : *report_app          ? Report(report)
                       : *sweep_app           ? Sweep(sweep)
                       : *explain_app         ? ExplainConfig(explain)
                       : *verify_app          ? Verify(verify, verify_quiet)
                       : *export_app          ? Export(exported)
                       : *replay_app          ? Replay(replay)
                                              : List(what, list_json);
    if (!std::cout.flush()) throw std::runtime_error("standard output cannot be written");
    return status;
  } catch (const InputError& error) {
    for (const std::string& complaint : error.complaints()) std::cerr << complaint << '\n';
    return kBadInput;
  } catch (const std::bad_alloc&) {
    std::cerr << "halfstep: out of memory (smaller input, a coarser period or fewer obstacles)\n";
    return kFailed;
  } catch (const std::exception& error) {
    std::cerr << "halfstep: " << error.what() << '\n';
    return kFailed;
  }
}
