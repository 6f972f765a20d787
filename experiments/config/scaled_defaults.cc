#include "experiments/config/scaled_defaults.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/config/experiment_config.h"
#include "wpg/files/number_text.h"
#include "wpg/files/number_visit.h"
#include "wpg/robot/reference_leg.h"

namespace halfstep {
namespace {

constexpr double kStance = 0.21;      // its standing width [m]
constexpr double kSoleWidth = 0.137;  // of its soles, the shorter side [m]
constexpr double kSpacing = 0.05;     // of its step set [m]
constexpr double kDuration = 2.0;     // of its half-steps, T [s]
// A leg joint's speed in a half-step over the highest bar of the shipped scenes is at most this
// over T [rad]: experiments/config.md, "Defaults that go by the robot".
constexpr double kTurn = 6.8;
constexpr double kViaHeight = 0.25;  // of HRP-2's half-steps [m]
constexpr double kRise = 6e-3;    // of a foot before it moves ahead: more than the floor margin [m]
constexpr double kOfLift = 0.95;  // of the highest place of the swing foot

enum class Law {
  kLength,
  kGrid,
  kAcross,
  kWidth,
  kDuration,
  kHeight,
  kAside,
  kDelay,
  kSupport,
  kSole,
  kTime,
  kSpeed,
  kRate,
  kGap
};

// The decimal number of three digits that is nearest: HRP-2's numbers stay what they are.
double Rounded(double value, int digits = 3) { return Shortened(value, digits); }

// The part of T after take-off in which a foot rises to a fraction of the via height: its height
// follows the step 10x³ − 15x⁴ + 6x⁵ over the time from the ZMP's shift to the half-step's end.
double DelayToRise(double fraction) {
  constexpr double kShift = 0.05;  // of T
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 50; ++i) {
    const double x = 0.5 * (low + high);
    (x * x * x * (10 + x * (-15 + 6 * x)) < fraction ? low : high) = x;
  }
  return (0.5 - 0.5 * kShift) * high;
}

// The value for a robot of what is `hrp2` for HRP-2.
double Scaled(Law law, double hrp2, const RobotMeasures& robot) {
  const double length = robot.leg_length / kLegOfHrp2, width = robot.standing_width / kStance;
  switch (law) {
    case Law::kLength:
      return Rounded(hrp2 * length);
    case Law::kGrid:  // the bounds of the step set along x are multiples of its rounded spacing
      return Rounded(hrp2 * (Rounded(kSpacing * length) / kSpacing), 6);
    case Law::kAcross:
      return Rounded((hrp2 + kStance) * length - robot.standing_width);
    case Law::kWidth:
      return Rounded(hrp2 * width);
    case Law::kDuration:
      return Rounded(hrp2 * std::max(std::sqrt(length), kTurn / (kDuration * robot.slowest_joint)));
    case Law::kHeight:
      return Rounded(std::min(hrp2 * length, kOfLift * robot.lift));
    case Law::kAside:
      return Rounded(std::min(hrp2 * width, robot.aside));
    case Law::kDelay:
      return std::max(hrp2, Rounded(DelayToRise(kRise / Scaled(Law::kHeight, kViaHeight, robot))));
    case Law::kSupport:
      return robot.support_point;
    case Law::kSole:
      return Rounded(hrp2 * robot.sole_width / kSoleWidth);
    case Law::kTime:
    case Law::kSpeed:  // of bodies that fall alike (Froude)
      return Rounded(hrp2 * std::sqrt(length));
    case Law::kRate:
      return Rounded(hrp2 / std::sqrt(length));
    case Law::kGap:
      return Rounded(hrp2 * std::min(1.0, length));
  }
  return hrp2;
}

std::string FormulaOf(Law law, const std::string& hrp2) {
  switch (law) {
    case Law::kLength:
    case Law::kGrid:
      return "`" + hrp2 + "` · ℓ/0.705 m";
    case Law::kAcross:
      return "(`" + hrp2 + "` + 0.21 m) · ℓ/0.705 m − w";
    case Law::kWidth:
      return "`" + hrp2 + "` · w/0.21 m";
    case Law::kDuration:
      return "`" + hrp2 + "` · max(√(ℓ/0.705 m), 3.4 rad/s / q̇)";
    case Law::kHeight:
      return "min(`" + hrp2 + "` · ℓ/0.705 m, 0.95 lift)";
    case Law::kAside:
      return "min(`" + hrp2 + "` · w/0.21 m, aside)";
    case Law::kDelay:
      return "max(`" + hrp2 + "`, until the foot is 6 mm high)";
    case Law::kSupport:
      return "`support_point_m` of the robot";
    case Law::kSole:
      return "`" + hrp2 + "` · sole width/0.137 m";
    case Law::kTime:
    case Law::kSpeed:
      return "`" + hrp2 + "` · √(ℓ/0.705 m)";
    case Law::kRate:
      return "`" + hrp2 + "` / √(ℓ/0.705 m)";
    case Law::kGap:
      return "`" + hrp2 + "` · min(1, ℓ/0.705 m)";
  }
  return hrp2;
}

struct ScaledDefault {
  std::string key;
  Law law;
};

Law LawOf(ParameterScale scale) {
  return scale == ParameterScale::kStanceWidth ? Law::kWidth : Law::kLength;
}

std::vector<ScaledDefault> ScaledDefaults() {
  std::vector<ScaledDefault> rows = {
      {"half_step.duration_s", Law::kDuration},
      {"half_step.zmp_shift_s", Law::kDuration},
      {"half_step.via_height_m", Law::kHeight},
      {"half_step.foot_delay", Law::kDelay},
      {"half_step.via_lateral_m", Law::kAside},
      {"half_step.support_point_m", Law::kSupport},
      {"step_set.x_min_m", Law::kGrid},
      {"step_set.x_max_m", Law::kGrid},
      {"step_set.y_min_m", Law::kAcross},
      {"step_set.y_max_m", Law::kAcross},
      {"step_set.spacing_m", Law::kLength},
      {"swept_volumes.cell_m", Law::kLength},
      {"swept_volumes.displacement_m", Law::kLength},
      {"planner.rrt.cell_m", Law::kLength},
      {"planner.astar.cell_m", Law::kLength},
      {"planner.estimate.step_s", Law::kDuration},
      {"planner.estimate.per_metre_s", Law::kRate},
      {"planner.estimate.per_radian_s", Law::kTime},
      {"planner.bounding_box.length_m", Law::kLength},
      {"planner.bounding_box.width_m", Law::kLength},
      {"planner.bounding_box.height_m", Law::kLength},
      {"planner.bounding_box.feet_apart_m", Law::kWidth},
      {"planner.bounding_box.spacing_m", Law::kLength},
      {"planner.bounding_box.corridor_m", Law::kLength},
      {"smoothing.margins.zmp_m", Law::kSole},
      {"smoothing.margins.zmp_robot_m", Law::kSole},
      {"smoothing.margins.self_clearance_m", Law::kGap},
      {"smoothing.limits.foot_speed_m_s", Law::kSpeed},
      {"smoothing.limits.foot_yaw_rate_rad_s", Law::kRate},
      {"smoothing.margins.double_support_s", Law::kTime},
  };
  for (const ParameterFamily family : AllParameterFamilies()) {
    for (const ParameterBoundKey& bound : Traits(family).bounds()) {
      if (bound.scale == ParameterScale::kNone) continue;
      rows.push_back({"smoothing.optimizer." + std::string(bound.key), LawOf(bound.scale)});
    }
  }
  return rows;
}

// Calls `visit` with each of these defaults: its row, where it is kept, its range.
void VisitScaled(
    ExperimentConfig* config,
    const std::function<void(const ScaledDefault&, double*, const NumberSpec&)>& visit) {
  const std::vector<ScaledDefault> rows = ScaledDefaults();
  VisitNumbers([config](Fields& fields) { DeclareFields(fields, config); },
               [&](const std::string& path, double* value, const NumberSpec& spec) {
                 for (const ScaledDefault& row : rows) {
                   if (row.key == path) visit(row, value, spec);
                 }
               });
}

KeyDescription* Find(std::string_view path, std::vector<KeyDescription>* keys) {
  for (KeyDescription& key : *keys) {
    if (key.path == path) return &key;
    if (path.starts_with(key.path + ".")) return Find(path, &key.keys);
  }
  return nullptr;
}

}  // namespace

void ScaleDefaults(const RobotMeasures& robot, ExperimentConfig* config) {
  VisitScaled(config, [&](const ScaledDefault& row, double* value, const NumberSpec& spec) {
    *value = std::clamp(Scaled(row.law, *value, robot), spec.min, spec.max);
  });
}

void DescribeScaling(std::vector<KeyDescription>* keys) {
  for (const ScaledDefault& row : ScaledDefaults()) {
    KeyDescription* const key = Find(row.key, keys);
    key->otherwise = FormulaOf(row.law, key->default_text);
  }
}

void DescribeScaling(const RobotMeasures& robot, std::vector<KeyDescription>* keys) {
  DescribeScaling(keys);
  ExperimentConfig scaled;
  ScaleDefaults(robot, &scaled);
  VisitScaled(&scaled, [keys](const ScaledDefault& row, const double* value, const NumberSpec&) {
    Find(row.key, keys)->otherwise += " = " + ShortestText(*value);
  });
}

}  // namespace halfstep
