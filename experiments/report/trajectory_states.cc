#include "experiments/report/trajectory_states.h"

#include <array>
#include <cstddef>

namespace halfstep {
namespace {

// The columns of the quantities, in the order of WalkState; what is not needed has none.
constexpr std::array<const char*, kNumQuantities> kColumns = {"com_x_m",
                                                              "com_y_m",
                                                              "",
                                                              "",
                                                              "waist_yaw_rad",
                                                              "left_foot_x_m",
                                                              "left_foot_y_m",
                                                              "left_foot_z_m",
                                                              "left_foot_yaw_rad",
                                                              "right_foot_x_m",
                                                              "right_foot_y_m",
                                                              "right_foot_z_m",
                                                              "right_foot_yaw_rad"};

}  // namespace

std::vector<WalkState> StatesOf(const CsvTable& trajectory) {
  std::vector<WalkState> states(trajectory.rows.size(), WalkState::Zero());
  for (size_t q = 0; q < kColumns.size(); ++q) {
    if (*kColumns[q] == '\0') continue;
    const std::vector<double> values = trajectory.Numbers(kColumns[q]);
    for (size_t i = 0; i < states.size(); ++i) states[i][static_cast<Eigen::Index>(q)] = values[i];
  }
  return states;
}

}  // namespace halfstep
