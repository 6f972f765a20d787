#include "experiments/report/trajectory_states.h"

#include <string>

namespace halfstep {
namespace {

// The ZMP is no part of a posture.
bool IsNeeded(const QuantityTraits& row) { return row.quantity != kZmpX && row.quantity != kZmpY; }

}  // namespace

std::vector<WalkState> StatesOf(const CsvTable& trajectory) {
  std::vector<WalkState> states(trajectory.rows.size(), WalkState::Zero());
  for (const QuantityTraits& row : kQuantities) {
    if (!IsNeeded(row)) continue;
    const std::vector<double> values = trajectory.Numbers(std::string(row.column));
    for (size_t i = 0; i < states.size(); ++i) states[i][row.quantity] = values[i];
  }
  return states;
}

}  // namespace halfstep
