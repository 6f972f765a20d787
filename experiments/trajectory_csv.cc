#include <algorithm>
#include <cmath>

#include "experiments/csv_writer.h"
#include "experiments/result_tables.h"
#include "wpg/posture.h"

namespace halfstep {
namespace {

// In the order of the margin columns.
constexpr std::array<std::pair<MarginFamily, const char*>, 6> kMarginColumns = {{
    {MarginFamily::kZmp, "zmp_margin_m"},
    {MarginFamily::kJoint, "joint_margin_rad"},
    {MarginFamily::kJointSpeed, "joint_speed_margin_rad_s"},
    {MarginFamily::kFootSpeed, "foot_speed_margin_m_s"},
    {MarginFamily::kClearance, "clearance_m"},
    {MarginFamily::kSelfClearance, "self_clearance_m"},
}};

std::string_view SupportName(const SuperposedWalk& walk, const LocalTime& at) {
  const int step = walk.StepInAir(at);
  return step < 0 ? "both" : Name(walk.half_step(2 * step).support);
}

void WriteRow(const MarginEvaluator& evaluator, const SuperposedWalk& walk, double t,
              const MarginSet& margins, CsvWriter* csv) {
  const LocalTime at = walk.Locate(t);
  const WalkJet jet = walk.At(at);
  const Posture posture = SolvePosture(evaluator.robot(), jet.value);
  const Eigen::Vector3d waist = posture.X_WB.translation();
  csv->Cell(t).Cell(at.half_step + 1).Cell(SupportName(walk, at));
  csv->Cell(jet.value[kComX]).Cell(jet.value[kComY]).Cell(walk.lipm().com_height);
  csv->Cell(jet.first[kComX]).Cell(jet.first[kComY]);
  csv->Cell(jet.second[kComX]).Cell(jet.second[kComY]);
  csv->Cell(jet.value[kZmpX]).Cell(jet.value[kZmpY]);
  csv->Cell(waist.x()).Cell(waist.y()).Cell(waist.z()).Cell(jet.value[kWaistYaw]);
  for (int q = kLeftX; q < kNumQuantities; ++q) csv->Cell(jet.value[q]);
  for (const LegIkSolution& ik : posture.ik) {
    for (int j = 0; j < 6; ++j) csv->Cell(posture.reachable ? ik.q[j] : std::nan(""));
  }
  for (const auto& [family, column] : kMarginColumns) {
    csv->Cell(margins[static_cast<size_t>(family)].value);
  }
  csv->EndRow();
}

}  // namespace

std::vector<std::string> TrajectoryColumns(const RobotModel& robot) {
  std::vector<std::string> columns = {"t_s",
                                      "half_step",
                                      "support",
                                      "com_x_m",
                                      "com_y_m",
                                      "com_z_m",
                                      "com_vx_m_s",
                                      "com_vy_m_s",
                                      "com_ax_m_s2",
                                      "com_ay_m_s2",
                                      "zmp_x_m",
                                      "zmp_y_m",
                                      "waist_x_m",
                                      "waist_y_m",
                                      "waist_z_m",
                                      "waist_yaw_rad",
                                      "left_foot_x_m",
                                      "left_foot_y_m",
                                      "left_foot_z_m",
                                      "left_foot_yaw_rad",
                                      "right_foot_x_m",
                                      "right_foot_y_m",
                                      "right_foot_z_m",
                                      "right_foot_yaw_rad"};
  for (const Leg& leg : robot.legs) {
    for (const LegJoint& joint : leg.joints) columns.push_back("q_" + joint.name + "_rad");
  }
  for (const auto& [family, column] : kMarginColumns) columns.emplace_back(column);
  return columns;
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
      double& highest = apex[static_cast<size_t>(step)];
      highest = std::max(highest, walk.At(at).value[z]);
    }
    WriteRow(evaluator, walk, t, margins, &csv);
  }
  run->lowest_apex = *std::min_element(apex.begin(), apex.end());
  run->trajectory = csv.text();
}

}  // namespace halfstep
