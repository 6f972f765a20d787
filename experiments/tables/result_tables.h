#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "experiments/config/experiment.h"
#include "experiments/tables/certificate_files.h"
#include "experiments/tables/csv_columns.h"
#include "experiments/tables/csv_writer.h"
#include "experiments/tables/walk_replay.h"
#include "smoothing/margins/margin_evaluator.h"
#include "smoothing/methods/smoothing_result.h"
#include "smoothing/walk/superposed_walk.h"

namespace halfstep {

/// The result of one method in an experiment, and a description of its walk.
struct MethodRun {
  /// A method that has not run.
  explicit MethodRun(std::string name) : method(std::move(name)) {}

  std::string method;                ///< the method's name
  SmoothingResult result;            ///< what it returned
  double processor = 0.0;            ///< processor time of this process while it ran [s]
  double duration = 0.0;             ///< of the walk [s]
  double lowest_apex = 0.0;          ///< least of the steps' highest sole heights [m]
  MarginSet margins;                 ///< smallest of each family, at the trajectory's instants
  CertifiedWalk certified;           ///< verdict on the walk and its proof
  CsvFile trajectory;                ///< trajectory.csv
  std::optional<WalkReplay> replay;  ///< none: it was not simulated
};

/// Whether a sole of the plan stands elsewhere than at z = 0.
bool HasHeights(const HalfStepSequence& sequence);
/// Whether the plan rests between half-steps.
bool HasRests(const HalfStepSequence& sequence);
/// Columns of footsteps.csv; those of a plan with a sole elsewhere than at z = 0 have its height,
/// those of a plan that rests its rests, those of a plan in which the waist changes its height
/// that.
CsvColumns FootstepsColumns(bool with_heights, bool with_rests, bool with_crouches);
/// Each table of a run folder; columns: experiments/files.md.
/// `before`: so many footsteps are taken before those of the sequence.
CsvFile FootstepsCsv(const HalfStepSequence& sequence, int before = 0);
/// Columns of overlaps.csv.
CsvColumns OverlapsColumns();
/// One row a junction.
CsvFile OverlapsCsv(const MarginEvaluator& evaluator, const MethodRun& run);
/// Columns of pareto.csv of a robot that has these families.
CsvColumns ParetoColumns(std::span<const MarginFamily> families);
/// One row a point of a Pareto curve: duration, proved least slack, and each family's least margin
/// sampled every 5 ms (inf: it is nowhere watched).
CsvFile ParetoCsv(const MarginEvaluator& evaluator, const HalfStepSequence& sequence,
                  const MethodRun& run);
/// One row a candidate of the method's search.
CsvFile IteratesCsv(const MethodRun& run);
/// Columns of summary.csv that only some runs have, so that the tables of others stay as they are.
struct SummaryParts {
  bool bound = false;   ///< gap_lipm: how far the walk is above the bound of `reference/lipm`
  bool replay = false;  ///< stands and tilt: how certified walks went on simulated robots
};
/// Of summary.csv, one row a method.
CsvColumns SummaryColumns(const SummaryParts& parts = {});
/// Gives the table into which a summary's cell of that column goes.
using SummaryCell = std::function<CsvWriter&(const CsvColumn&)>;
/// Adds the cells of one method's row, in the order of SummaryColumns(parts).
void AddSummaryRow(const MarginEvaluator& evaluator, const std::vector<MethodRun>& runs,
                   size_t index, const SummaryParts& parts, const SummaryCell& cell);
/// One row a method; speed-up against the first run, which is the planned motion. `with_replay`:
/// whether walks were to be simulated.
CsvFile SummaryCsv(const MarginEvaluator& evaluator, const std::vector<MethodRun>& runs,
                   bool with_replay = false);

/// Columns of trajectory.csv for a robot that tell its motion: all but the margins.
CsvColumns MotionColumns(const RobotModel& robot);
/// Their cells for a walk at t [s]. Where a leg does not reach, its joint angles are nan.
/// A number, a count or a text.
using MotionCell = std::variant<double, long, std::string_view>;
/// The cells of one row, in the order of MotionColumns().
std::vector<MotionCell> MotionRow(const RobotModel& robot, const SuperposedWalk& walk, double t);

/// Columns of trajectory.csv for a robot: those of the motion, and the margins.
CsvColumns TrajectoryColumns(const RobotModel& robot);

/// Writes trajectory.csv of a walk from 0 to `end` [s] in rows `period` [s] apart, the last one at
/// `end`, with its schema; margins are those of `evaluator_at(t)`. No more than a few rows are kept
/// in memory. Throws as RunFolder.
void WriteTrajectory(const SuperposedWalk& walk, double end, double period,
                     const std::function<const MarginEvaluator&(double)>& evaluator_at,
                     RunFolder* folder);

/// Samples the walk of `run->result.parameters` at a fixed period [s], the last row exactly at its
/// end, and fills the walk's part of `run`. Where a leg does not reach, its joint angles are nan.
void SampleTrajectory(const MarginEvaluator& evaluator, const HalfStepSequence& sequence,
                      double period, MethodRun* run);

}  // namespace halfstep
