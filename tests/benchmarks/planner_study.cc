// Planners in the shipped and drawn scenes: success, time to the first plan, footsteps.
//   planner_study [RUNS [SCENARIO|PLANNER...]]     default: 100 runs, all scenarios and planners
// Swept volumes of HRP-2 from the user's cache, baked when they are not there. `flat_*`: the query
// of the tests, poles and areas only.

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "experiments/config/experiment.h"
#include "experiments/config/random_scenes.h"
#include "experiments/run/planning.h"
#include "planner/search/plan_shortcut.h"
#include "planner/swept/swept_volume_query.h"
#include "tests/places.h"
#include "tests/planner/flat_world.h"
#include "wpg/motion/lipm.h"

namespace {

using namespace halfstep;

// One problem; the seed draws what is random about it.
struct Problem {
  Scene scene;
  std::array<Foothold, 2> start;
  GoalRegion goal;
  std::optional<Eigen::AlignedBox2d> workspace;
};

struct Scenario {
  std::string name;
  bool random = false;  // the problem depends on the seed
  std::function<Problem(int seed)> problem;
  int certified = 1000;  // so many plans are certified: with meshes that takes seconds each
};

Problem Shipped(const std::string& name) {
  const ExperimentConfig config =
      LoadConfig(InSources("experiments/configs/") + name + ".yaml", {});
  const Place place = LoadPlace(config);
  Problem problem{
      place.scene, StartOf(config, place.robot, *place.scene.ground), config.goal.Region(), {}};
  if (const auto& w = config.planner.workspace; !w.empty()) {
    problem.workspace = {Eigen::Vector2d(w[0], w[1]), Eigen::Vector2d(w[2], w[3])};
  }
  return problem;
}

Scene Drawn(const std::string& name, int count, int seed) {
  const auto path = std::filesystem::temp_directory_path() / ("planner_study_" + name + ".yaml");
  std::ofstream(path) << DrawScene(name, count, static_cast<std::uint64_t>(seed));
  const Scene scene = LoadScene(path.string());
  std::filesystem::remove(path);
  return scene;
}

// Another room and another goal in one of its corners for each seed.
Problem RandomRoom(int seed) {
  Problem problem = Shipped("random_room");
  problem.scene = Drawn("random_room", 14, seed);
  const double corners[3][2] = {{1.5, 1.5}, {1.5, -1.5}, {-1.5, 1.5}};
  problem.goal.X_WG.x = corners[seed % 3][0];
  problem.goal.X_WG.y = corners[seed % 3][1];
  return problem;
}

// A ball of 2·n·n triangles, on the floor.
Obstacle MeshBall(int i, double x, double y, double radius, int n) {
  TriangleMesh mesh{Eigen::Matrix3Xd(3, n * (n + 1)), Eigen::Matrix3Xi(3, 2 * n * n)};
  for (int a = 0; a <= n; ++a) {
    for (int b = 0; b < n; ++b) {
      const double polar = std::numbers::pi * (a + 0.01) / (n + 0.02);
      const double around = 2.0 * std::numbers::pi * b / n;
      mesh.vertices.col(a * n + b) << radius * std::sin(polar) * std::cos(around),
          radius * std::sin(polar) * std::sin(around), radius * std::cos(polar);
      if (a == n) continue;
      const int p = a * n + b, q = a * n + (b + 1) % n;
      mesh.triangles.col(2 * p) << p, p + n, q;
      mesh.triangles.col(2 * p + 1) << q, p + n, q + n;
    }
  }
  Obstacle obstacle{.name = "ball " + std::to_string(i), .shape = mesh};
  obstacle.X_WO.translation() << x, y, radius;
  return obstacle;
}

// 4 m among twelve balls, 60,000 triangles in all.
Problem Meshes(int seed) {
  Problem problem = Shipped("cylinders");
  std::mt19937_64 random(static_cast<std::uint64_t>(seed));
  problem.scene = {.name = "meshes", .files = {}, .obstacles = {}, .no_step = {}, .warnings = {}};
  for (int i = 0; i < 12; ++i) {
    const double x = Uniform(0.6, 3.4, random), y = Uniform(-1.0, 1.0, random);
    problem.scene.obstacles.push_back(MeshBall(i, x, y, Uniform(0.04, 0.12, random), 50));
  }
  problem.goal.X_WG = {4.0, 0.0, 0.0};
  problem.workspace = {Eigen::Vector2d(-0.5, -1.8), Eigen::Vector2d(4.5, 1.8)};
  return problem;
}

struct Row {
  int solved = 0, checked = 0, certified = 0, runs = 0;
  std::vector<double> first, steps, nodes, queries;
};

double Quantile(std::vector<double> values, double q) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  return values[static_cast<size_t>(q * static_cast<double>(values.size() - 1) + 0.5)];
}

void Print(const std::string& scenario, const std::string& planner, const Row& row) {
  std::printf("%-12s %-14s %3d/%-3d %4d/%-4d %10.2f %10.2f %7.0f %7.0f %8.0f\n", scenario.c_str(),
              planner.c_str(), row.solved, row.runs, row.certified, row.checked,
              1e3 * Quantile(row.first, 0.5), 1e3 * Quantile(row.first, 0.95),
              Quantile(row.steps, 0.5), Quantile(row.nodes, 0.5), Quantile(row.queries, 0.5));
  std::fflush(stdout);
}

// Ends with the first plan, or after two seconds.
PlanRequest RequestFor(const Problem& problem, const StepSet& set, const HalfStepQuery& query) {
  return {.start = problem.start,
          .goal = problem.goal,
          .set = set,
          .query = query,
          .workspace = problem.workspace,
          .stop = AnyOf(
              {AtFirstPlan(), AfterNodes(200000), AtTime(SteadySeconds, SteadySeconds() + 2.0)}),
          .clock = SteadySeconds};
}

void Record(const PlanResult& result, Row* row) {
  ++row->runs;
  row->nodes.push_back(static_cast<double>(result.nodes));
  row->queries.push_back(static_cast<double>(result.queries));
  if (result.status != PlanStatus::kSolved) return;
  ++row->solved;
  row->first.push_back(result.time_to_first);
  row->steps.push_back(static_cast<double>(result.footsteps.size()));
}

void StudySwept(const Scenario& scenario, const std::string& planner, const SweptVolumes& volumes,
                const ExperimentConfig& config, const RobotModel& robot, int runs) {
  Row row;
  if (!scenario.random && planner != "rrt") runs = 1;  // nothing in it is random
  for (int seed = 1; seed <= runs; ++seed) {
    const Problem problem = scenario.problem(seed);
    const SweptVolumeQuery query(volumes, robot.sole_outline, problem.scene);
    const HalfStepCertifier certifier(robot, problem.scene, config);
    PlanRequest request = RequestFor(problem, volumes.set, query);
    request.start_is_free = [&](const HalfStep& up, const Foothold& X_WS) {
      return certifier.Certifies(up, X_WS);
    };
    std::mt19937_64 random(static_cast<std::uint64_t>(seed));
    const PlanResult result =
        Planners::Standard().Make(planner, problem.scene)->Plan(request, random);
    Record(result, &row);
    if (result.footsteps.empty() || seed > scenario.certified) continue;
    ++row.checked;
    const MarginEvaluator evaluator(robot, problem.scene, config.smoothing.limits);
    const CertifiedFeasibility test(evaluator, config.smoothing.certification);
    const HalfStep prototype = PrototypeOf(config);
    row.certified +=
        CertifyPlan(test, MakeSequence(problem.start, result.footsteps, prototype.via_lateral,
                                       prototype.shape, std::make_shared<Lipm>(robot.com_height)))
            .accepted;
  }
  Print(scenario.name, planner, row);
}

void StudyFlat(const std::string& name, const FlatWorld& world, const Pose2& goal,
               const std::vector<std::string>& planners, int runs) {
  const StepSet set = PlausibleSet();
  const FlatQuery query(set, world);
  Problem problem{world.ToScene(),
                  {Foothold::Level({0.0, 0.1, 0.0}), Foothold::Level({0.0, -0.1, 0.0})},
                  {},
                  {}};
  problem.goal.X_WG = goal;
  for (const std::string& planner : planners) {
    Row row;
    for (int seed = 1; seed <= (planner == "rrt" ? runs : 1); ++seed) {
      std::mt19937_64 random(static_cast<std::uint64_t>(seed));
      Record(Planners::Standard()
                 .Make(planner, problem.scene)
                 ->Plan(RequestFor(problem, set, query), random),
             &row);
    }
    Print(name, planner, row);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const int runs = argc > 1 ? std::atoi(argv[1]) : 100;
  const std::vector<std::string> chosen(argv + std::min(argc, 2), argv + argc);
  // Names of planners choose among the planners, others among the scenarios; none: all.
  std::vector<std::string> planners, scenario_names;
  for (const std::string& name : chosen) {
    const std::vector<std::string> all = Planners::Standard().Names();
    (std::find(all.begin(), all.end(), name) != all.end() ? planners : scenario_names)
        .push_back(name);
  }
  if (planners.empty()) {
    planners = Planners::Standard().Names();
    std::erase(planners, "best");  // its first plan is one of `rrt` or of `astar`
  }
  const auto wanted = [&names = scenario_names](const std::string& name) {
    return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
  };
  std::printf("%-12s %-14s %7s %9s %10s %10s %7s %7s %8s\n", "scenario", "planner", "solved",
              "certified", "median ms", "p95 ms", "steps", "nodes", "queries");
  if (wanted("flat_open")) StudyFlat("flat_open", {}, {4.0, 0.0, 0.0}, planners, runs);
  if (wanted("flat_wall"))
    StudyFlat("flat_wall", WallWithGap(0.6, 1.2), {2.0, 0.0, 0.0}, planners, runs);
  if (wanted("flat_island"))
    StudyFlat("flat_island", Island(0.6, 0.05), {2.0, 0.3, 0.0}, planners, runs);

  std::vector<Scenario> scenarios;
  for (const char* name : {"island", "clutter", "fence"}) {
    scenarios.push_back({name, false, [name](int) { return Shipped(name); }});
  }
  scenarios.push_back({"cylinders", true, [](int seed) {
                         Problem problem = Shipped("cylinders");
                         problem.scene = Drawn("cylinders", 40, seed);
                         return problem;
                       }});
  scenarios.push_back({"random_room", true, RandomRoom});
  scenarios.push_back({"meshes", true, Meshes, 3});
  ExperimentConfig config = LoadConfig(InSources("experiments/configs/island.yaml"), {});
  const RobotModel robot = LoadPlace(config).robot;
  std::optional<BakedHalfSteps> baked;
  for (const Scenario& scenario : scenarios) {
    if (!wanted(scenario.name)) continue;
    if (!baked) baked = BakeHalfSteps(robot, config, {});
    for (const std::string& planner : planners) {
      StudySwept(scenario, planner, *baked->cached.volumes, config, robot, runs);
    }
  }
}
