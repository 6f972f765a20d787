#include "experiments/references/drawn_reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "experiments/survey/stance_search.h"
#include "planner/search/plan_shortcut.h"
#include "wpg/elementary.h"
#include "wpg/files/text.h"
#include "wpg/geometry/pose2.h"
#include "wpg/robot/reference_leg.h"
#include "wpg/robot/robot_legs.h"

namespace halfstep {
namespace {

constexpr double kLeastDuration = 0.6;  // of a half-step that configs take [s]

/// What a kind's footsteps do from one to the next, seen from the middle of the feet: from `least`
/// to `most`, to either side where that is told.
struct GaitRange {
  double least = 0.0, most = 0.0;
  bool either_way = false;
};
struct DrawnKind {
  const char* name;
  GaitRange ahead = {}, aside = {}, turn = {};  // [m], [m], [rad]
};
constexpr std::array<DrawnKind, 8> kKinds = {{
    {"standing"},
    {"stepping"},
    {"forward", {0.02, 0.2}},
    {"backward", {-0.12, -0.02}},
    {"sideways", {}, {0.005, 0.04, true}},
    {"turning", {}, {}, {0.05, 0.25, true}},
    {"arc", {0.02, 0.16}, {}, {0.03, 0.15, true}},
    {"diagonal", {-0.1, 0.15}, {0.005, 0.03, true}, {0.0, 0.08, true}},
}};

double Degrees(double radians) { return radians * 180.0 / std::numbers::pi; }

class ReferenceDrawing {
 public:
  ReferenceDrawing(const ReferenceNames& names, const DrawnKind& kind, const RobotModel& robot,
                   std::mt19937_64& random)
      : names_(names),
        robot_(robot),
        random_(random),
        scale_(StretchedLength(robot.legs[0]) / kLegOfHrp2),
        kind_(kind) {}

  DrawnReference Draw() {
    const double duration = std::max(kLeastDuration, Between(0.9, 2.4) * std::sqrt(scale_));
    const double height = std::max(0.01, Between(0.75, 1.0) * DefaultHalfStep(robot_).via_height);
    std::string text = Formatted(
        "# %s; drawn by `halfstep draw references`\nname: %s\nrobot: %s\nscene: none\n"
        "smoothing: {methods: [%s]}\nhalf_step: {duration_s: %.3f, via_height_m: %.4f}\n",
        kind_.name, names_.name.c_str(), names_.robot.c_str(), names_.method.c_str(), duration,
        height);
    std::optional<double> stands;
    if (kind_.name == std::string("standing")) {
      stands = std::round(10.0 * Between(2.0, 10.0)) / 10.0;
      text += StandingText();
    } else {
      text += FootstepsText();
    }
    return {kind_.name, std::move(text), stands};
  }

 private:
  double Between(double least, double most) { return Uniform(least, most, random_); }
  double In(const GaitRange& range) {
    const double size = Between(range.least, range.most);
    const bool other_way = Between(0.0, 1.0) < 0.5;
    return range.either_way && other_way ? -size : size;
  }
  Side AnyFoot() { return Between(0.0, 1.0) < 0.5 ? Side::kLeft : Side::kRight; }
  static std::string PlaceText(const Pose2& X) {
    return Formatted("x_m: %.4f, y_m: %.4f, yaw_deg: %.2f", X.x, X.y, Degrees(X.yaw));
  }

  std::string FootstepsText() {
    const Pose2 pace{scale_ * In(kind_.ahead), scale_ * In(kind_.aside), In(kind_.turn)};
    const int count = static_cast<int>(std::lround(4.0 * Pow(5.0, Between(0.0, 1.0))));
    Side foot = AnyFoot();
    std::string text = "footsteps:\n";
    Pose2 middle;
    for (int k = 0; k < count; ++k, foot = Opposite(foot)) {
      middle = middle * pace;
      const Pose2 at = middle * Pose2{0.0, Sign(foot) * 0.5 * robot_.standing_width, 0.0};
      text += "  - {foot: " + std::string(Name(foot)) + ", " + PlaceText(at) + "}\n";
    }
    return text;
  }

  // One foot a little ahead, aside and turned of where it stands beside the other, which steps onto
  // its own place.
  std::string StandingText() {
    const Side foot = AnyFoot();
    const double width = robot_.standing_width;
    std::array<Pose2, 2> at = {Pose2{0.0, 0.5 * width, 0.0}, Pose2{0.0, -0.5 * width, 0.0}};
    Pose2& moved = at[static_cast<size_t>(Index(foot))];
    moved.x += scale_ * Between(-0.08, 0.08);
    moved.y += Sign(foot) * scale_ * Between(0.0, 0.04);
    moved.yaw += Sign(foot) * Between(0.0, 0.25);
    const Side steps = Opposite(foot);
    return "start:\n  left: {" + PlaceText(at[0]) + "}\n  right: {" + PlaceText(at[1]) +
           "}\nfootsteps:\n  - {foot: " + std::string(Name(steps)) + ", " +
           PlaceText(at[static_cast<size_t>(Index(steps))]) + "}\n";
  }

  const ReferenceNames& names_;
  const RobotModel& robot_;
  std::mt19937_64& random_;
  const double scale_;
  const DrawnKind& kind_;
};

}  // namespace

DrawnReference DrawReference(const ReferenceNames& names, int number, const RobotModel& robot,
                             std::mt19937_64& random) {
  const DrawnKind& kind = kKinds[static_cast<size_t>(number - 1) % kKinds.size()];
  return ReferenceDrawing(names, kind, robot, random).Draw();
}

}  // namespace halfstep
