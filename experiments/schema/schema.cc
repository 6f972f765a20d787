#include "experiments/schema/schema.h"

#include <set>

#include "experiments/compare/comparison_tables.h"
#include "experiments/config/experiment_config.h"
#include "experiments/live/episode_tables.h"
#include "experiments/live/live_config.h"
#include "experiments/replay/replay.h"
#include "experiments/sweep/sweep_tables.h"
#include "experiments/tables/certificate_files.h"
#include "experiments/tables/parameter_tables.h"
#include "experiments/tables/result_tables.h"
#include "wpg/robot/robot_fields.h"

namespace halfstep {
namespace {

// Of a robot with every column that a robot may have; its joints have one name.
CsvColumns TrajectoryColumns() {
  RobotModel robot;
  for (Leg& leg : robot.legs) {
    for (LegJoint& joint : leg.joints) {
      joint.name = "JOINT";
      joint.max_acceleration = 1.0;
    }
  }
  CsvColumns columns = TrajectoryColumns(robot);
  std::set<std::string> names;
  std::erase_if(columns,
                [&](const CsvColumn& column) { return !names.insert(column.name).second; });
  return columns;
}

// A table without rows has its columns.
std::vector<TableSchema> Tables() {
  const Comparison none;
  SweepConfig sweep;
  sweep.parts = {.bound = true, .replay = true};
  std::vector<TableSchema> tables = {
      {"run/footsteps", FootstepsColumns(true, true, true)},
      {"run/half_steps", HalfStepsColumns(HalfStepsExtent::kHeights)},
      {"run/trajectory", TrajectoryColumns()},
      {"run/overlaps", OverlapsColumns()},
      {"run/pareto", ParetoColumns(FamiliesWith({}))},
      {"run/iterates", IteratesCsv(MethodRun("")).columns},
      {"run/certificate", CertificateColumns()},
      {"run/summary", SummaryColumns(sweep.parts)},
      {"comparison/comparison", ComparisonColumns(true)},
      {"comparison/performance_profile", PerformanceProfileCsv(none).columns},
      {"comparison/anytime", AnytimeCsv(none).columns},
      {"comparison/means", MeansCsv(none).columns},
      {"sweep/runs", EmptyRuns(sweep).columns},
      {"sweep/timings", EmptyTimings().columns},
      {"replay/replay", replay::ReplayCsv({}).columns},
  };
  for (const EpisodeTable& table : EpisodeTables({}, {})) {
    tables.push_back({"episode/" + table.name, table.file.columns});
  }
  return tables;
}

// Keys that are the names of a robot's links and joints are not among them.
std::vector<KeyDescription> RobotKeys() {
  RobotFile file;
  return DescribeKeys([&file](Fields& fields) { DeclareFields(fields, &file); });
}

}  // namespace

Schema MakeSchema() {
  const auto parameters = AllParameterFamilies();
  const auto margins = FamiliesWith({});
  return {.parameters = {parameters.begin(), parameters.end()},
          .margins = {margins.begin(), margins.end()},
          .tables = Tables(),
          .files = {{"config", ConfigKeys()},
                    {"sweep", SweepKeys()},
                    {"episode", EpisodeKeys()},
                    {"robot", RobotKeys()}}};
}

}  // namespace halfstep
