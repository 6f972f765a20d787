#pragma once

#include <memory>
#include <stop_token>
#include <string>

#include "experiments/commands/commands.h"
#include "experiments/live/live_config.h"
#include "experiments/live/true_world.h"
#include "experiments/server/served_episode.h"

namespace halfstep {

/// The config as the episode goes on, with clients or without. Throws InputError for what this
/// build or command cannot do.
LiveConfig Adapted(const LiveCommand& command, const LiveConfig& config);

/// Where clients reach the episode; null: the command asks for none. `config` is Adapted();
/// `address`: that of an episode before, which has ended, and after which this one begins anew; "":
/// there was none. Throws as Server.
std::unique_ptr<ServedEpisode> Serve(const LiveCommand& command, const LiveConfig& config,
                                     const Place& place, const TrueWorld& truth,
                                     const std::stop_token& stop, const std::string& address);

/// Tells people where clients find the episode.
void PrintPlaces(const LiveCommand& command, const ServedEpisode& served);

}  // namespace halfstep
