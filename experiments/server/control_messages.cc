#include "experiments/server/control_messages.h"

#include <array>
#include <optional>

namespace halfstep {
namespace {

using nlohmann::json;

// A vector as a list, a matrix as the list of its rows.
json Json(const Eigen::MatrixXd& values) {
  json all = json::array();
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    if (values.cols() == 1) {
      all.push_back(values(i, 0));
      continue;
    }
    json& row = all.emplace_back(json::array());
    for (Eigen::Index j = 0; j < values.cols(); ++j) row.push_back(values(i, j));
  }
  return all;
}

template <typename Value>
json OfBoth(const std::array<Value, 2>& values) {
  return {Json(values[0]), Json(values[1])};
}

json SpringJson(const std::optional<control::JointSpring>& spring) {
  return spring ? json{spring->stiffness, spring->damping} : json(nullptr);
}

json Json(const control::MeasuredState& state) {
  const auto& [left, right] = state.loads;
  return {{"t_s", state.t},
          {"q_rad", OfBoth(state.q)},
          {"speeds_rad_s", OfBoth(state.speeds)},
          {"R_WB", Json(state.R_WB)},
          {"turn_B_rad_s", Json(state.turn_B)},
          {"forces_n", {left.force, right.force}},
          {"centres_m", {Json(left.centre), Json(right.centre)}}};
}

json Json(const control::PlannedState& state) {
  const auto& [left, right] = state.X_WSole;
  return {{"t_s", state.t},
          {"q_rad", OfBoth(state.q)},
          {"speeds_rad_s", OfBoth(state.speeds)},
          {"torques_n_m", OfBoth(state.torques)},
          {"ankle_moments_n_m", OfBoth(state.ankle_moments)},
          {"X_WB", Json(state.X_WB.matrix())},
          {"X_WSole", {Json(left.matrix()), Json(right.matrix())}},
          {"stands", state.stands},
          {"com_m", Json(state.com)},
          {"com_velocity_m_s", Json(state.com_velocity)},
          {"zmp_m", Json(state.zmp)},
          {"force_n", state.force}};
}

}  // namespace

json ControlledMessage(const control::ControlledRobot& robot) {
  json joints = json::array();
  for (const Leg& leg : robot.model.legs) {
    json& names = joints.emplace_back(json::array());
    for (const LegJoint& joint : leg.joints) names.push_back(joint.name);
  }
  return {{"type", "controlled"},
          {"robot", robot.model.name},
          {"period_s", control::kControlPeriod},
          {"joints", joints},
          {"servos", SpringJson(robot.servos)},
          {"ankle", SpringJson(robot.ankle)},
          {"mass_kg", robot.model.mass},
          {"com_height_m", robot.model.com_height},
          {"sole_size_m", Json(robot.model.sole_size)}};
}

json ControlMessage(long number, const control::MeasuredState& measured,
                    const control::PlannedState& then, const control::PlannedState& next) {
  return {{"type", "control"},
          {"n", number},
          {"measured", Json(measured)},
          {"then", Json(then)},
          {"next", Json(next)}};
}

}  // namespace halfstep
