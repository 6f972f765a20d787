#include <cmath>
#include <iomanip>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "experiments/commands/command_line.h"
#include "experiments/commands/commands.h"
#include "experiments/config/experiment.h"
#include "experiments/run/interrupt.h"
#include "experiments/run/plan_json.h"
#include "experiments/run/plan_yaml.h"
#include "experiments/run/planning.h"
#include "experiments/run/progress_bar.h"
#include "wpg/files/input_error.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

// One bar after the other, as the work goes on.
class Bars {
 public:
  explicit Bars(bool quiet) : quiet_(quiet) {}
  void Update(const std::string& what, double done) {
    if (!bar_ || what != what_) {
      bar_.emplace(what, quiet_);
      what_ = what;
    }
    bar_->Update(done);
  }

 private:
  bool quiet_;
  std::string what_;
  std::optional<ProgressBar> bar_;
};

PlanningHooks HooksOf(Bars* bars, const InterruptGuard& interrupt) {
  return {.progress = [bars](const std::string& what, double done) { bars->Update(what, done); },
          .stop = interrupt.token()};
}

void WarnAboutCache(const CachedVolumes& cached) {
  for (const std::string& sentence : {cached.refused, cached.not_kept}) {
    if (!sentence.empty()) std::cerr << "halfstep: " << sentence << '\n';
  }
}

// The footsteps as a config has them. Where none is needed there are none, and a config cannot say
// that, so nothing is printed.
void PrintPlan(const PlannedWalk& walk) {
  const PlanResult& plan = walk.plan;
  if (plan.footsteps.empty()) {
    std::cerr << "halfstep: " << plan.sentence << '\n';
    return;
  }
  std::cout << "# " << walk.config.planner.name << ": " << plan.sentence << ", " << plan.nodes
            << " nodes, " << plan.queries << " queries of " << walk.half_steps.size
            << " half-steps, effort " << std::fixed << std::setprecision(3)
            << plan.effort() + walk.proof_effort << ", " << std::setprecision(1) << 1e3 * plan.time
            << " ms\n"
            << std::defaultfloat << std::setprecision(6)
            << (walk.detour.empty() ? "" : "# " + walk.detour + "\n")
            << NotCoveredText(walk.not_covered, "--json", "# ") << PlanYaml(walk);
}

std::uintmax_t SizeOf(const std::string& path) {
  std::error_code ignored;
  const std::uintmax_t size = std::filesystem::file_size(path, ignored);
  return ignored ? 0 : size;
}

}  // namespace

ExitStatus Plan(const PlanCommand& command) {
  InterruptGuard interrupt;
  const ExperimentConfig config = LoadConfig(command.config, command.overrides, command.tools);
  if (!config.has_goal) {
    throw InputError(
        {command.config + ": goal: is missing (valid: a `goal` in place of footsteps)"});
  }
  const Place place = LoadPlace(config);
  TellWarnings(place.robot, place.scene);
  std::optional<PlannedWalk> walk;
  {
    Bars bars(command.quiet || command.json);
    walk = PlanWalk(config, place, HooksOf(&bars, interrupt));
  }
  WarnAboutCache(walk->half_steps.cached);
  const bool solved = walk->plan.status == PlanStatus::kSolved;
  if (command.json) {
    std::cout << PlanJson(*walk);
  } else if (solved && !command.quiet) {
    PrintPlan(*walk);
  }
  if (solved) return kSuccess;
  std::cerr << "halfstep: no plan: " << walk->plan.sentence << '\n';
  return interrupt.requested() ? kInterrupted : kFailed;
}

ExitStatus Bake(const PlanCommand& command) {
  InterruptGuard interrupt;
  const ExperimentConfig config = LoadConfig(command.config, command.overrides, command.tools);
  const Place place = LoadPlace(config);
  TellWarnings(place.robot, place.scene);
  std::optional<BakedHalfSteps> baked;
  {
    Bars bars(command.quiet || command.json);
    baked = BakeHalfSteps(place.robot, config, *place.scene.ground, HooksOf(&bars, interrupt));
  }
  WarnAboutCache(baked->cached);
  if (!baked->cached.volumes) {
    std::cerr << "halfstep: interrupted; what was baked is "
              << (baked->cached.not_kept.empty() ? "kept\n" : "not kept\n");
    return kInterrupted;
  }
  if (command.json) {
    std::cout << nlohmann::ordered_json({{"half_steps", baked->size},
                                         {"baked", baked->cached.baked},
                                         {"set_wall_s", baked->set_wall},
                                         {"wall_s", baked->wall},
                                         {"bytes", SizeOf(baked->cached.path)},
                                         {"file", baked->cached.path}})
                     .dump(2)
              << '\n';
  } else if (!command.quiet) {
    std::cout << baked->size << " half-steps certified in " << baked->set_wall << " s; volumes "
              << (baked->cached.baked ? "baked" : "read") << " in " << baked->wall << " s, "
              << static_cast<double>(SizeOf(baked->cached.path)) * 1e-6
              << " MB: " << baked->cached.path << '\n';
  }
  return baked->cached.not_kept.empty() ? kSuccess : kFailed;  // to keep them is its purpose
}

ExitStatus ListHalfSteps(const PlanCommand& command) {
  const ExperimentConfig config = LoadConfig(command.config, command.overrides, command.tools);
  const StepSet set = CertifiedHalfSteps(LoadPlace(config).robot, config);
  if (command.json) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Foothold& placement : set.placements) {
      const Pose2 X_SF = placement.LevelPose();
      list.push_back({{"x_m", X_SF.x}, {"y_m", X_SF.y}, {"yaw_rad", X_SF.yaw}});
    }
    std::cout << list.dump(2) << '\n';
    return kSuccess;
  }
  std::cout << "half_step,x_m,y_m,yaw_rad\n";
  for (int i = 0; i < set.size(); ++i) {
    const Pose2 X_SF = Nth(set.placements, i).LevelPose();
    std::cout << i + 1 << ',' << X_SF.x << ',' << X_SF.y << ',' << X_SF.yaw << '\n';
  }
  return kSuccess;
}

namespace {

CommandAction DeclarePlanning(CLI::App* app, const Toolbox& tools,
                              ExitStatus (*run)(const PlanCommand&)) {
  const auto command = std::make_shared<PlanCommand>();
  command->tools = tools;
  const auto sets = std::make_shared<std::vector<std::string>>();
  app->add_option("CONFIG", command->config, "experiment, a YAML file or a shipped one's name")
      ->required();
  DeclareOverrides(app, "the config", sets.get());
  app->add_flag("--quiet", command->quiet, "print nothing but errors");
  app->add_flag("--json", command->json, "print JSON");
  return [command, sets, run] {
    command->overrides = ParseOverrides(*sets);
    return run(*command);
  };
}

}  // namespace

CommandAction DeclarePlan(CLI::App* app, const Toolbox& tools) {
  return DeclarePlanning(app, tools, Plan);
}
CommandAction DeclareBake(CLI::App* app, const Toolbox& tools) {
  return DeclarePlanning(app, tools, Bake);
}

}  // namespace halfstep
