#include "experiments/report/trajectory_states.h"

#include <string>

namespace halfstep {
namespace {

// The ZMP is no part of a posture.
bool IsNeeded(const QuantityTraits& row) { return row.quantity != kZmpX && row.quantity != kZmpY; }

}  // namespace

std::vector<WalkState> StatesOf(const RobotModel& robot, const CsvTable& trajectory) {
  std::vector<WalkState> states(trajectory.rows.size(), WalkState::Zero());
  for (const QuantityTraits& row : kQuantities) {
    if (!IsNeeded(row)) continue;
    const std::vector<double> values = trajectory.Numbers(std::string(row.column));
    const double standing = row.quantity == kWaistZ ? robot.waist_height : 0.0;
    for (size_t i = 0; i < states.size(); ++i) states[i][row.quantity] = values[i] - standing;
  }
  return states;
}

}  // namespace halfstep
