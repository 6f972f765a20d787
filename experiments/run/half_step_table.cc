#include "experiments/run/half_step_table.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "wpg/files/number_text.h"
#include "wpg/robot/reference_leg.h"
#include "wpg/robot/robot_measures.h"

namespace halfstep {
namespace {

// As one writes it: in steps of 1/steps.
double Rounded(double value, double steps) { return std::round(steps * value) / steps; }

}  // namespace

double SizeOf(const RobotModel& robot) { return LegLengthOf(robot) / kLegOfHrp2; }

std::vector<HalfStepConfig> HalfStepTable(const HalfStepConfig& own, double highest, double size) {
  std::vector<HalfStepConfig> table = {own};
  const auto add = [&](double longer, double above, double crouch, double delay, double lift,
                       double begin, double end) {
    HalfStepConfig form = own;
    form.duration = std::min(6.0, own.duration * longer);
    form.zmp_shift = own.zmp_shift * form.duration / own.duration;
    // In millimetres and steps of 0.1 s, as one writes them.
    form.duration = std::round(10.0 * form.duration) / 10.0;
    form.via_height = std::ceil(1e3 * (highest + above * size) - 1e-6) / 1e3;
    form.crouch = std::max(own.crouch, std::round(1e3 * crouch * size) / 1e3);
    form.foot_delay = delay;
    form.lift_share = lift;
    form.rise_begin = begin;
    form.rise_end = end;
    table.push_back(form);
  };
  for (const double longer : {1.0, 1.3}) {
    for (const double crouch : {0.01, 0.02}) {
      for (const double above : {0.02, 0.05}) add(longer, above, crouch, 0.15, 0.6, 0.525, 0.85);
      add(longer * (longer > 1.0 ? 1.0 : 1.2), 0.02, crouch, 0.19, 1.0, 0.525, 1.0);
    }
  }
  for (const double crouch : {0.0, 0.01}) {
    for (const double begin : {0.46, 0.5}) add(1.3, 0.02, crouch, 0.15, 0.6, begin, 0.85);
  }
  return table;
}

std::vector<HalfStepConfig> TableOverObstacle(const HalfStepConfig& own, double top, double size) {
  std::vector<HalfStepConfig> table;
  for (const double longer : {1.0, 1.3}) {
    for (const double crouch : {0.0, 0.02, 0.04, 0.08}) {
      for (const double above : {0.02, 0.05}) {
        for (const auto& [delay, lift] : {std::pair(0.15, 0.6), std::pair(0.19, 1.0)}) {
          HalfStepConfig form = own;
          form.duration = Rounded(std::min(6.0, own.duration * longer), 10.0);
          const double ratio = form.duration / own.duration;
          form.zmp_shift = ratio == 1.0 ? own.zmp_shift : Rounded(own.zmp_shift * ratio, 1e4);
          form.via_height = std::ceil(1e3 * (top + above * size) - 1e-6) / 1e3;
          form.crouch = std::max(own.crouch, Rounded(crouch * size, 1e3));
          form.foot_delay = delay;
          form.lift_share = lift;
          table.push_back(form);
        }
      }
    }
  }
  return table;
}

std::string Differences(const HalfStepConfig& form, const HalfStepConfig& from) {
  std::string text;
  const auto add = [&](const char* key, double HalfStepConfig::*number) {
    if (form.*number == from.*number) return;
    text += (text.empty() ? "" : ", ") + std::string(key) + ": " + ShortestText(form.*number);
  };
  add("duration_s", &HalfStepConfig::duration);
  add("zmp_shift_s", &HalfStepConfig::zmp_shift);
  add("via_height_m", &HalfStepConfig::via_height);
  add("foot_delay", &HalfStepConfig::foot_delay);
  add("lift_share", &HalfStepConfig::lift_share);
  add("rise_begin", &HalfStepConfig::rise_begin);
  add("rise_end", &HalfStepConfig::rise_end);
  add("crouch_m", &HalfStepConfig::crouch);
  return text;
}

}  // namespace halfstep
