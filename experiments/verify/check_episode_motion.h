#pragma once

#include <optional>
#include <vector>

#include "experiments/config/planning_config.h"
#include "experiments/verify/check_episode_walks.h"
#include "experiments/verify/episode_text.h"
#include "experiments/verify/findings.h"
#include "experiments/verify/played_motion.h"

namespace halfstep::verify {

/// The walk that was executed: the last one, cut after the last half-step of begun.csv when
/// `stopped`. Precondition: CheckGrantNumbers() returned true.
DescribedWalk ExecutedWalk(const EpisodeText& episode, const EpisodeWalks& all, bool stopped);

/// Whether what began fits how the episode ended: every half-step of the executed walk that begins
/// before manifest.json's `end_s` is in begun.csv, and events.csv has each as it begins, in order.
void CheckWhatBegan(const EpisodeText& episode, const EpisodeManifest& manifest,
                    const DescribedWalk& executed, Findings* findings);

/// Whether the rows of trajectory.csv are a motion, consistent with each other, and are those of
/// the executed walk every `period` [s] and at its end, or at manifest.json's `end_s` if that is
/// earlier. The margin columns are not looked at.
void CheckEpisodeTrajectory(const std::vector<PlayedRow>& rows, const EpisodeManifest& manifest,
                            const DescribedWalk& executed, double period, Findings* findings);

/// Where an episode ends.
struct EpisodeGoal {
  const GoalConfig& config;           ///< as the config has it, but for its place
  std::optional<double> height = {};  ///< of the level that it names [m]
};
/// Whether the ending of manifest.json is one of those that there are; "arrived" only if the robot
/// rests on both feet by `end_s`, in the goal where the newest world has it.
void CheckEpisodeEnding(const EpisodeText& episode, const EpisodeManifest& manifest,
                        const EpisodeWalks& all, const DescribedWalk& executed,
                        const EpisodeGoal& goal, Findings* findings);

}  // namespace halfstep::verify
