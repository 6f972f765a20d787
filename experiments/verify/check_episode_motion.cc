#include "experiments/verify/check_episode_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "experiments/verify/check_rows.h"
#include "experiments/verify/check_walk.h"
#include "wpg/nth.h"

namespace halfstep::verify {
namespace {

constexpr double kEndRounding = 1e-9;  // [s], [m], [rad]

// Whether a pose is in the goal, whose centre is at `center` in W.
bool InGoal(const Pose2& X_W, const GoalConfig& goal, const Eigen::Vector2d& center) {
  const Eigen::Vector2d off = X_W.position() - center;
  if (goal.box.size() == 2) {
    const double c = std::cos(goal.X_WG.yaw), s = std::sin(goal.X_WG.yaw);
    const double x = c * off.x() + s * off.y(), y = c * off.y() - s * off.x();
    if (!(2 * std::abs(x) <= goal.box[0] + kEndRounding) ||
        !(2 * std::abs(y) <= goal.box[1] + kEndRounding)) {
      return false;
    }
  } else if (!(off.norm() <= goal.radius + kEndRounding)) {
    return false;
  }
  if (!goal.yaw_tolerance) return true;
  const double turn = std::remainder(X_W.yaw - goal.X_WG.yaw, 2 * std::numbers::pi);
  return std::abs(turn) <= *goal.yaw_tolerance + kEndRounding;
}

// Whether the part of a stance that counts is in the goal, at its height.
bool StandsInGoal(const std::array<Foothold, 2>& stance, const EpisodeGoal& of_episode,
                  const Eigen::Vector2d& center) {
  const auto& [goal, height] = of_episode;
  const std::array<Pose2, 2> feet = {stance[0].Planar(), stance[1].Planar()};
  const std::array<bool, 2> level = {!height || stance[0].height == *height,
                                     !height || stance[1].height == *height};
  if (goal.part == "mid_feet") {
    const Pose2 middle{(feet[0].x + feet[1].x) / 2, (feet[0].y + feet[1].y) / 2,
                       (feet[0].yaw + feet[1].yaw) / 2};
    return level[0] && level[1] && InGoal(middle, goal, center);
  }
  return (goal.part != "right_foot" && level[0] && InGoal(feet[0], goal, center)) ||
         (goal.part != "left_foot" && level[1] && InGoal(feet[1], goal, center));
}

}  // namespace

DescribedWalk ExecutedWalk(const EpisodeText& episode, const EpisodeWalks& all, bool stopped) {
  const DescribedWalk& last = *all.last;
  return stopped ? last.StopBranch(static_cast<int>(episode.begun.size()) - 1) : last;
}

void CheckWhatBegan(const EpisodeText& episode, const EpisodeManifest& manifest,
                    const DescribedWalk& executed, Findings* findings) {
  const int begun = static_cast<int>(episode.begun.size());
  if (begun < executed.num_half_steps() &&
      !(executed.WindowOf(begun).first >= manifest.end - kEndRounding)) {
    findings->Disagree(
        Formatted("begun.csv: half-step %d is not in it, but the walk begins it at "
                  "%.9g s, before the episode ends",
                  begun + 1, executed.WindowOf(begun).first));
  }
  int next = 1;
  for (size_t i = 0; i < episode.events.size(); ++i) {
    const EventRow& event = episode.events[i];
    if (event.what != "begins") continue;
    const std::string line = Formatted("events.csv:%zu: ", i + 2);
    if (event.half_step != next || next > begun) {
      findings->Disagree(
          line + Formatted("half-step %d begins, begun.csv says otherwise", event.half_step));
      return;
    }
    const double begin = executed.WindowOf(next - 1).first;
    if (!(std::abs(event.t - begin) <= kEndRounding)) {
      findings->Disagree(line + Formatted("half-step %d begins at %.9g s, but at %.9g s in the "
                                          "walk that was executed",
                                          next, event.t, begin));
    }
    ++next;
  }
  if (next <= begun) {
    findings->Disagree(Formatted("events.csv: half-step %d of begun.csv does not begin", next));
  }
}

void CheckEpisodeTrajectory(const std::vector<PlayedRow>& rows, const EpisodeManifest& manifest,
                            const DescribedWalk& executed, double period, Findings* findings) {
  Findings of_rows;
  if (CheckIsMotion(rows, &of_rows)) {
    const double end = std::min(executed.end(), manifest.end);
    CheckRowsOnWalk(rows, executed, period, end, &of_rows);
    findings->Say("trajectory.csv: " + of_rows.lines().back());
    CheckConsistency(PlayedMotion(executed.robot(), rows), executed, &of_rows);
  }
  findings->TakeReasons(of_rows, "");
}

void CheckEpisodeEnding(const EpisodeText& episode, const EpisodeManifest& manifest,
                        const EpisodeWalks& all, const DescribedWalk& executed,
                        const EpisodeGoal& goal, Findings* findings) {
  if (manifest.stopped && static_cast<int>(episode.begun.size()) >= all.last->num_half_steps()) {
    findings->Disagree("manifest.json: stopped: nothing of the last walk was left to be cut");
  }
  constexpr std::array<const char*, 8> kOthers = {"stuck", "too_long",     "ended",  "interrupted",
                                                  "fell",  "uncontrolled", "killed", "no_plan"};
  findings->Say("ending: " + (manifest.ending.size() < 20 ? manifest.ending : "unknown") +
                Formatted(" at %.6g s", manifest.end));
  if (std::ranges::find(kOthers, manifest.ending) != kOthers.end()) return;
  if (manifest.ending != "arrived") {
    findings->Disagree("manifest.json: ending: " + Quote(manifest.ending) + " is not known here");
    return;
  }
  const auto wrong = [&](const std::string& what) {
    findings->Disagree("manifest.json: ending: the robot has not arrived: " + what);
  };
  const size_t begun = episode.begun.size();
  if (begun % 2 == 1) return wrong("it stands on one foot");
  if (static_cast<int>(begun) < executed.num_half_steps()) return wrong("it has not come to rest");
  if (!(executed.end() <= manifest.end + kEndRounding)) {
    return wrong(Formatted("it walks until %.9g s", executed.end()));
  }
  const auto& [down, X_WS, rest] = all.planned.half_steps[begun - 1];
  std::array<Foothold, 2> feet;
  Nth(feet, Index(down.support)) = X_WS;
  Nth(feet, Index(down.swing())) = X_WS * down.X_SF;
  if (!StandsInGoal(feet, goal, episode.worlds.back().goal)) {
    wrong(Formatted("its last stance is not in the goal of world %d", episode.worlds.back().world));
  }
}

}  // namespace halfstep::verify
