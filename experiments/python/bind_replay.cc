#include <pybind11/stl.h>

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "experiments/config/replay_config.h"
#include "experiments/python/bindings.h"
#include "experiments/python/long_call.h"
#include "experiments/python/python_controller.h"
#include "experiments/python/walk_setting.h"
#include "experiments/replay/play_once.h"
#include "experiments/replay/recorded_run.h"
#include "experiments/replay/run_replay.h"
#include "experiments/replay/seeds_screen.h"

namespace py = pybind11;

namespace halfstep::python {
namespace {

// A walk to be played, as Python gives it.
struct ReplayCall {
  std::string run, method;
  ReplayConfig robot;
  std::optional<int> seeds;
  bool suggest_tube = false;
  std::optional<control::MakeController> make;  // none: the plan itself
  control::SensorOptions sensors;
};

// What is told of it as JSON, and its table.
struct Played {
  std::string json;
  CsvFile table;
};

void CheckSpring(const char* key, const std::vector<double>& spring) {
  const std::string mistake = MistakeInSpring(spring);
  if (!mistake.empty()) throw std::invalid_argument(std::string(key) + ": " + mistake);
}

Played Play(const ReplayCall& call, const Toolbox& tools, const LongCallHooks& hooks) {
  if (const std::string why = replay::WhyNoSimulation(); !why.empty()) {
    throw std::invalid_argument("replay: " + why);
  }
  replay::RecordedRun run = replay::ReadRun(call.run, call.method, tools);
  if (call.suggest_tube && run.world.ground.uneven()) {
    throw std::invalid_argument(
        "suggest_tube: the scene's ground has levels, and tubes know the flat floor only");
  }
  replay::ReplaySetup setup = replay::SetupOf(std::move(run.robot), run.world, call.robot);
  const RobotModel& robot = setup.robot.model;
  setup.measures_tube = call.suggest_tube;
  if (call.make) {
    if (!robot.masses.known()) {
      throw std::invalid_argument("controller: of " + robot.name + ", " + robot.masses.fault);
    }
    setup.control = {.make = *call.make, .sensors = call.sensors};
  }
  const replay::ReferenceMotion& motion = run.walks.front().motion;
  const auto tube = [&](const std::vector<const replay::ReplayResult*>& results) {
    return call.suggest_tube ? std::optional(replay::SuggestTube(results, robot)) : std::nullopt;
  };
  if (call.seeds) {
    replay::SeedsPlayed played{
        .method = call.method,
        .duration = motion.end(),
        .obstacles = setup.has_touchable(),
        .seeds = replay::PlaySeeds(
            setup, motion, *call.seeds, [&hooks](double done) { hooks.progress("seeds", done); },
            hooks.stop)};
    if (hooks.stop.stop_requested()) return {};
    played.tube = tube(replay::ResultsOf(played.seeds));
    return {replay::SeedsPlayedJson(played), replay::SeedsCsv(played.seeds)};
  }
  replay::Replayed replayed = replay::PlayOnce(setup, call.method, motion);
  replayed.controller = call.make ? "python" : "none";
  replayed.tube = tube({&replayed.result});
  return {replay::ReplayedJson(replayed), replay::ReplayCsv(replayed.result.rows)};
}

}  // namespace

void BindReplay(py::module_& module, const ModuleTools& tools) {
  module.def("replay", [tools](const std::string& run, const std::string& method,
                               const std::variant<std::string, py::function>& controller,
                               const py::dict& options, const py::object& progress) {
    ReplayCall call{.run = run,
                    .method = method,
                    .robot = {},
                    .seeds = options["seeds"].cast<std::optional<int>>(),
                    .suggest_tube = options["suggest_tube"].cast<bool>(),
                    .make = {},
                    .sensors = {}};
    call.robot.servos = options["servos"].cast<std::vector<double>>();
    call.robot.ankle = options["ankle"].cast<std::vector<double>>();
    call.robot.torque_limits = options["torque_limits"].cast<bool>();
    CheckSpring("servos", call.robot.servos);
    CheckSpring("ankle", call.robot.ankle);
    call.sensors.delay = options["sensor_delay"].cast<double>();
    call.sensors.seed = options["sensor_seed"].cast<std::optional<std::uint64_t>>();
    if (const auto* const name = std::get_if<std::string>(&controller)) {
      const auto known = control::Controllers::Standard();
      if (*name != "none") {
        call.make = [known, name = *name](const control::ControlledRobot& robot) {
          return known.Make(name, robot);
        };
      }
    } else {
      call.make = MakePythonControllers(std::get<py::function>(controller));
    }
    Played played;
    CallLong(progress, [&](const LongCallHooks& hooks) { played = Play(call, *tools, hooks); });
    return py::make_tuple(played.json, ToPython(played.table));
  });
  module.def("controllers", [] { return control::Controllers::Standard().names(); });
  module.attr("most_seeds") = kMostSeeds;
  module.attr("control_period") = control::kControlPeriod;
}

}  // namespace halfstep::python
