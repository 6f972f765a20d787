#include "experiments/survey/drawn_walk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "experiments/config/experiment.h"
#include "experiments/survey/stance_search.h"
#include "planner/search/plan_shortcut.h"
#include "smoothing/proof/certified_feasibility.h"
#include "wpg/elementary.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"
#include "wpg/robot/reference_leg.h"
#include "wpg/robot/robot_legs.h"

namespace halfstep {
namespace {

constexpr int kDraws = 1000;

// How a walk goes on from footstep to footstep, seen from the middle of the feet.
struct Gait {
  const char* kind;
  double ahead, aside, turn;  // [m], [m], [rad]
};

// Between two bounds, either way.
double EitherWay(double least, double most, std::mt19937_64& random) {
  const double size = Uniform(least, most, random);
  return Uniform(0.0, 1.0, random) < 0.5 ? size : -size;
}

Gait DrawGait(std::mt19937_64& random) {
  switch (static_cast<int>(Uniform(0.0, 6.0, random))) {
    case 0:
      return {"straight", Uniform(0.05, 0.13, random), 0.0, 0.0};
    case 1:
      return {"arc", Uniform(0.05, 0.11, random), 0.0, EitherWay(0.03, 0.1, random)};
    case 2:
      return {"sideways", 0.0, EitherWay(0.01, 0.03, random), 0.0};
    case 3:
      return {"backwards", -Uniform(0.04, 0.1, random), 0.0, 0.0};
    case 4:
      return {"turning", 0.0, 0.0, EitherWay(0.08, 0.2, random)};
    default:
      return {"wandering", Uniform(0.03, 0.11, random), 0.0, 0.0};
  }
}

// Draws one walk.
class WalkDrawing {
 public:
  WalkDrawing(std::string name, std::string robot_name, const RobotModel& robot,
              std::mt19937_64& random)
      : name_(std::move(name)),
        robot_name_(std::move(robot_name)),
        robot_(robot),
        random_(random),
        scale_(StretchedLength(robot.legs[0]) / kLegOfHrp2) {}

  // None when the footsteps that were drawn cannot be walked on an empty floor.
  std::optional<DrawnWalk> Draw() {
    DrawFootsteps();
    if (!Feasible()) return std::nullopt;
    const int count = static_cast<int>(Uniform(0.0, 7.0, random_));
    for (int i = 1; i <= count; ++i) AddObstacle(i);
    return DrawnWalk{gait_.kind, ConfigText(), SceneText()};
  }

 private:
  double Between(double least, double most) { return Uniform(least, most, random_); }

  void DrawFootsteps() {
    gait_ = DrawGait(random_);
    const int count = static_cast<int>(std::lround(4.0 * Pow(10.0, Between(0.0, 1.0))));
    duration_ = Between(1.2, 3.0) * std::sqrt(scale_);
    Side foot = Between(0.0, 1.0) < 0.5 ? Side::kLeft : Side::kRight;
    Pose2 middle;
    for (int k = 0; k < count; ++k, foot = Opposite(foot)) {
      if (gait_.kind == std::string("wandering")) gait_.turn = Between(-0.15, 0.15);
      middle = middle * Pose2{scale_ * gait_.ahead, scale_ * gait_.aside, gait_.turn};
      const double y = Sign(foot) * 0.5 * robot_.standing_width;
      const Pose2 off{scale_ * Between(-0.01, 0.01), y + scale_ * Between(-0.01, 0.01),
                      Between(-0.02, 0.02)};
      const Pose2 at = middle * off;
      footsteps_ +=
          Formatted("  - {foot: %s, x_m: %.4f, y_m: %.4f, yaw_deg: %.2f}\n",
                    std::string(Name(foot)).c_str(), at.x, at.y, at.yaw * 180.0 / std::numbers::pi);
      middles_.push_back(middle);
    }
  }

  // An obstacle beside or between the footsteps that leaves the planned motion feasible; fewer are
  // there when none of some does.
  void AddObstacle(int i) {
    for (int k = 0; k < 40; ++k) {
      const Pose2& middle =
          middles_[static_cast<size_t>(Between(0.0, static_cast<double>(middles_.size())))];
      const Pose2 at = middle * Pose2{scale_ * Between(-0.2, 0.3), scale_ * Between(-0.6, 0.6), 0};
      const double height = scale_ * 0.02 * Pow(50.0, Between(0.0, 1.0));
      std::string shape;
      if (i % 2 == 0) {
        shape = Formatted("cylinder: {radius_m: %.4f, length_m: %.4f}",
                          scale_ * Between(0.01, 0.15), height);
      } else {
        const double length = scale_ * Between(0.02, 0.3), width = scale_ * Between(0.02, 0.3);
        shape = Formatted("box: {size_m: [%.4f, %.4f, %.4f]}", length, width, height);
      }
      const std::string before = obstacles_;
      obstacles_ += Formatted(
          "  - name: obstacle %d\n    %s\n    pose: {xyz: [%.4f, %.4f, %.4f], rpy_deg: [0, 0, "
          "%.2f]}\n",
          i, shape.c_str(), at.x, at.y, 0.5 * height, Between(-90.0, 90.0));
      if (Feasible()) return;
      obstacles_ = before;
    }
  }

  // Of what is written, whether the planned motion is feasible.
  bool Feasible() const {
    const ExperimentConfig config = ParseConfig(name_ + ".yaml", ConfigText(), {{"scene", "none"}});
    const Experiment e = Prepare(config, {robot_, ParseScene(name_ + "_scene.yaml", SceneText())});
    const CertifiedFeasibility test(MarginEvaluator(e.robot, e.scene, e.config.smoothing.limits),
                                    e.config.smoothing.certification);
    const SuperposedWalk walk(e.sequence, PlannedMotion(e.sequence));
    MarginEvaluator::Scratch scratch = test.evaluator().MakeScratch();
    return test.Check(walk, {0.0, walk.duration()}, &scratch).verdict == Verdict::kFeasible;
  }

  std::string ConfigText() const {
    return Formatted(
               "# %s; drawn by `halfstep draw walks`\nname: %s\nrobot: %s\nscene: "
               "%s_scene.yaml\nhalf_step: {duration_s: %.3f}\nfootsteps:\n",
               gait_.kind, name_.c_str(), robot_name_.c_str(), name_.c_str(), duration_) +
           footsteps_;
  }
  std::string SceneText() const {
    return Formatted("name: %s_scene\nobstacles:%s\n", name_.c_str(),
                     obstacles_.empty() ? " []" : "") +
           obstacles_;
  }

  std::string name_, robot_name_;
  const RobotModel& robot_;
  std::mt19937_64& random_;
  double scale_;
  Gait gait_{};
  double duration_ = 0.0;       // [s]
  std::string footsteps_;       // of the config
  std::string obstacles_;       // of the scene
  std::vector<Pose2> middles_;  // of the feet, a footstep each
};

}  // namespace

DrawnWalk DrawWalk(const std::string& name, const std::string& robot_name, const RobotModel& robot,
                   std::mt19937_64& random) {
  for (int k = 0; k < kDraws; ++k) {
    if (auto walk = WalkDrawing(name, robot_name, robot, random).Draw()) return *std::move(walk);
  }
  throw InputError({"draw: walks: none of " + std::to_string(kDraws) +
                    " draws of footsteps can be walked by this robot as planned"});
}

}  // namespace halfstep
