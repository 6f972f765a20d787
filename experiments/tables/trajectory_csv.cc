#include <algorithm>
#include <cmath>
#include <tuple>

#include "experiments/tables/csv_writer.h"
#include "experiments/tables/margin_columns.h"
#include "experiments/tables/result_tables.h"
#include "experiments/tables/run_folder.h"
#include "wpg/motion/posture.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using enum CsvType;
constexpr CsvInterpolation kConstant = CsvInterpolation::kPiecewiseConstant;
constexpr CsvInterpolation kLinear = CsvInterpolation::kLinear;

// Columns of a place on the floor's axes, "com" …, in W.
void AddPlace(const std::string& name, const std::string& what, bool with_z, bool with_yaw,
              CsvColumns* columns) {
  for (const char* axis : {"x", "y", "z"}) {
    if (*axis == 'z' && !with_z) continue;
    columns->push_back({name + "_" + axis + "_m", kNumber, "m", what + ", " + axis, "W", kLinear});
  }
  if (with_yaw) {
    columns->push_back({name + "_yaw_rad", kNumber, "rad", what + ", yaw", "W", kLinear});
  }
}

std::string_view SupportName(const SuperposedWalk& walk, const LocalTime& at) {
  const int step = walk.StepInAir(at);
  return step < 0 ? "both" : Name(walk.half_step(2 * step).support);
}

void WriteRow(const MarginEvaluator& evaluator, const SuperposedWalk& walk, double t,
              const MarginSet& margins, CsvWriter* csv) {
  for (const MotionCell& cell : MotionRow(evaluator.robot(), walk, t)) {
    std::visit([csv](const auto& value) { csv->Cell(value); }, cell);
  }
  for (const MarginFamily family : FamiliesOfTrajectory(evaluator.robot())) {
    csv->Cell(Nth(margins, family).value);
  }
  csv->EndRow();
}

}  // namespace

CsvColumns MotionColumns(const RobotModel& robot) {
  CsvColumns columns = {
      {"t_s", kNumber, "s", "time since the start", "", kLinear},
      {"half_step", kInteger, "", "latest half-step that has begun, from 1", "", kConstant},
      {"support", kString, "", "sole that carries: left, right or both", "", kConstant}};
  AddPlace("com", "CoM", true, false, &columns);
  for (const auto& [letter, what, unit] :
       {std::tuple{"v", "velocity", "m/s"}, std::tuple{"a", "acceleration", "m/s2"}}) {
    for (const std::string axis : {"x", "y"}) {
      std::string ending = unit;
      std::replace(ending.begin(), ending.end(), '/', '_');
      columns.push_back({"com_" + std::string(letter) + axis + "_" + ending, kNumber, unit,
                         "CoM's " + std::string(what) + ", " + axis, "W", kLinear});
    }
  }
  AddPlace("zmp", "ZMP, on the floor", false, false, &columns);
  AddPlace("waist", "waist frame B, upright", true, true, &columns);
  AddPlace("left_foot", "centre of the left sole", true, true, &columns);
  AddPlace("right_foot", "centre of the right sole", true, true, &columns);
  for (const Leg& leg : robot.legs) {
    for (const LegJoint& joint : leg.joints) {
      columns.push_back({"q_" + joint.name + "_rad", kNumber, "rad",
                         "angle of joint " + joint.name + "; nan: the leg does not reach", "",
                         kLinear});
    }
  }
  return columns;
}

std::vector<MotionCell> MotionRow(const RobotModel& robot, const SuperposedWalk& walk, double t) {
  const LocalTime at = walk.Locate(t);
  const WalkJet jet = walk.At(at);
  const Posture posture = SolvePosture(robot, jet.value);
  const Eigen::Vector3d waist = posture.X_WB.translation();
  std::vector<MotionCell> row = {t, static_cast<long>(at.half_step + 1), SupportName(walk, at)};
  const auto add = [&row](auto... values) { (row.emplace_back(values), ...); };
  add(jet.value[kComX], jet.value[kComY], robot.com_height + jet.value[kWaistZ]);
  add(jet.first[kComX], jet.first[kComY], jet.second[kComX], jet.second[kComY]);
  add(jet.value[kZmpX], jet.value[kZmpY]);
  add(waist.x(), waist.y(), waist.z(), jet.value[kWaistYaw]);
  for (int q = kLeftX; q <= kRightYaw; ++q) add(jet.value[q]);
  for (const LegIkSolution& ik : posture.ik) {
    for (int j = 0; j < 6; ++j) add(posture.reachable ? ik.q[j] : std::nan(""));
  }
  return row;
}

CsvColumns TrajectoryColumns(const RobotModel& robot) {
  CsvColumns columns = MotionColumns(robot);
  for (const MarginFamily family : FamiliesOfTrajectory(robot)) {
    columns.push_back({*TrajectoryColumnOf(family), kNumber, std::string(Unit(family)),
                       "smallest margin of " + std::string(Name(family)) + " at this instant"});
  }
  return columns;
}

void WriteTrajectory(const SuperposedWalk& walk, double end, double period,
                     const std::function<const MarginEvaluator&(double)>& evaluator_at,
                     RunFolder* folder) {
  constexpr size_t kMostKept = 1 << 16;  // bytes
  const CsvColumns columns = TrajectoryColumns(evaluator_at(0.0).robot());
  folder->WriteParts("trajectory.csv", [&](const RunFolder::TextSink& add) {
    CsvWriter csv(columns);
    const long full = static_cast<long>(std::floor(end / period * (1.0 - 1e-12)));
    for (long i = 0; i <= full + 1; ++i) {
      const double t = i <= full ? static_cast<double>(i) * period : end;
      const MarginEvaluator& evaluator = evaluator_at(t);
      MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
      WriteRow(evaluator, walk, t, evaluator.At(walk, walk.Locate(t), &scratch), &csv);
      if (csv.text().size() <= kMostKept) continue;
      add(csv.text());
      csv.ForgetText();
    }
    add(csv.text());
  });
  folder->Write("trajectory.schema.json", SchemaJson(columns));
}

void SampleTrajectory(const MarginEvaluator& evaluator, const HalfStepSequence& sequence,
                      double period, MethodRun* run) {
  const SuperposedWalk walk(sequence, run->result.parameters);
  MarginEvaluator::Scratch scratch = evaluator.MakeScratch();
  CsvWriter csv(TrajectoryColumns(evaluator.robot()));
  std::vector<double> apex(static_cast<size_t>(sequence.num_steps()), 0.0);
  run->duration = walk.duration();
  const long full = static_cast<long>(std::floor(walk.duration() / period * (1.0 - 1e-12)));
  for (long i = 0; i <= full + 1; ++i) {
    const double t = i <= full ? static_cast<double>(i) * period : walk.duration();
    const LocalTime at = walk.Locate(t);
    const MarginSet margins = evaluator.At(walk, at, &scratch);
    if (i == 0) {
      run->margins = margins;
    } else {
      for (size_t f = 0; f < margins.size(); ++f) {
        if (margins[f].value < run->margins[f].value) run->margins[f] = margins[f];
      }
    }
    const int step = walk.StepInAir(at);
    if (step >= 0) {
      const int z = FootIndex(walk.half_step(2 * step).swing()) + 2;
      double& highest = Nth(apex, step);
      highest = std::max(highest, walk.At(at).value[z]);
    }
    WriteRow(evaluator, walk, t, margins, &csv);
  }
  run->lowest_apex = *std::min_element(apex.begin(), apex.end());
  run->trajectory = csv.file();
}

}  // namespace halfstep
