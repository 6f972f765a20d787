#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/live/episode.h"
#include "experiments/live/live_config.h"
#include "planner/scene/scene.h"
#include "wpg/robot/robot_model.h"

namespace halfstep {

/// The version of the messages between an episode and its clients; every change of a key raises it.
constexpr int kProtocol = 3;

/// What an episode tells its clients, one JSON object each, with the key `type`; the other keys:
/// experiments/server/README.md. Lengths [m], angles [rad], times of the walk [s], frame W.
/// Half-steps count from 1, 0 is none; walks, worlds and grants count from 0. A number that is not
/// finite is null.

/// `spare` names the boxes of the scene that a person may place.
nlohmann::json HelloMessage(const LiveConfig& config, const RobotModel& robot, const Scene& scene,
                            const std::vector<std::string>& spare);
/// The robot waits, and why.
nlohmann::json WaitingMessage(std::string_view reason);
/// `known`: when the world became known [s].
nlohmann::json WorldMessage(const World& world, double known);
/// A walk that was handed over, from the step on that changed; `index` counts them from 0.
nlohmann::json WalkMessage(const ExecutedWalk& walk, size_t index);
/// Makes the walk whole in the message, given that of the walk before it as it was made whole.
void MakeWhole(nlohmann::json before, nlohmann::json* message);
/// A grant; `index` counts them from 0.
nlohmann::json GrantMessage(const EpisodeGrant& grant, size_t index);
/// Something that happened.
nlohmann::json EventMessage(const EpisodeEvent& event);
/// The instant t [s] of the motion in execution. `held`: nothing more is to begin.
/// `first`: half-step of the whole walk that the motion's 0 is.
nlohmann::json StateMessage(const RobotModel& robot, const SuperposedWalk& executed, double t,
                            bool stopped, bool held, int first = 0);
/// The motion in execution from `from` to `until` [s], or to its end when that is earlier, in rows
/// `period` [s] apart; the first one at `from`.
nlohmann::json MotionMessage(const RobotModel& robot, const SuperposedWalk& executed, size_t walk,
                             double from, double until, double period);
/// What a page needs to draw robot and world: RobotJson and ShapesJson (report_place.h).
nlohmann::json DrawMessage(const RobotModel& robot, const Scene& scene);
/// `folder`: where the record was written.
nlohmann::json EndMessage(const Episode& episode, const std::string& folder);
/// What was wrong with a message of a client.
nlohmann::json ErrorMessage(const std::string& text);

/// The object as one line of text, without a line break. Bytes that are not UTF-8 are replaced.
std::string MessageText(const nlohmann::json& message);

}  // namespace halfstep
