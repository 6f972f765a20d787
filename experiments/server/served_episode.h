#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>

#include "experiments/config/experiment.h"
#include "experiments/live/episode.h"
#include "experiments/live/live_config.h"
#include "experiments/live/true_world.h"
#include "experiments/server/client_control.h"
#include "experiments/server/client_hub.h"
#include "experiments/server/client_inbox.h"
#include "experiments/server/edited_sensor.h"
#include "experiments/server/news_board.h"
#include "experiments/server/server.h"

namespace halfstep {

/// An episode that clients reach: they are told what happens, and what they say is done.
class ServedEpisode {
 public:
  /// The config as an episode goes on that is served: by the wall clock, and where a stand-in
  /// senses, with boxes that a person may place.
  static LiveConfig Served(LiveConfig config);
  /// As one goes on in which a client controls a simulated robot: in lockstep, and in the world of
  /// the script.
  static LiveConfig Controlled(LiveConfig config);

  /// `config` is Served(), `place` has the spare boxes, `truth` is of both. Clients may come from
  /// now on, and are told to wait. Throws as Server.
  ServedEpisode(const LiveConfig& config, const Place& place, const TrueWorld& truth,
                const ServerOptions& options);
  /// `config` is Controlled(). A client controls the robot, and others look on.
  ServedEpisode(const LiveConfig& config, const Place& place, const ServerOptions& options,
                const ClientControl::Options& control);

  /// Precondition: a client controls the robot.
  ClientControl& control() { return *control_; }
  const std::string& address() const { return server_->address(); }  ///< where clients find it
  /// Of the episode: what clients measure, or the stand-in; null where a client controls.
  Sensor* sensor() { return sensor_.get(); }

  /// Half-steps are prepared: clients that want them are told these volumes.
  void Prepare(std::shared_ptr<const SweptVolumes> volumes) { board_.Prepare(std::move(volumes)); }
  /// Returns when a client has come, or when `stop` is requested.
  void WaitForClient(const std::stop_token& stop);
  void Wait(const std::string& reason) { board_.Wait(reason); }  ///< there is no walk yet, and why
  /// After each tick of the episode.
  void Tick(const EpisodeTick& tick) { board_.Tick(tick, held() || inbox_.ended()); }
  bool held() const { return inbox_.held(); }    ///< whether a client holds the robot
  bool again() const { return inbox_.again(); }  ///< whether a client asked for it anew
  /// Asks for the end of the episode, as clients do.
  void Stop() { inbox_.End(); }
  /// Stop is requested when a client asks for the end.
  std::stop_token stop_token() const { return inbox_.end_token(); }

  /// The script that holds what people did, in times of the script. Precondition: there is a
  /// sensor.
  std::vector<ScriptEvent> Script() const;
  /// Tells clients that the episode has ended, and lets them go. `folder`: where its record is.
  void End(const Episode& episode, const std::string& folder);

 private:
  ClientInbox inbox_;
  NewsBoard board_;
  std::optional<ClientControl> control_;
  ClientHub hub_;
  EditedSensor* edited_ = nullptr;  // the sensor, when it is one
  std::unique_ptr<Sensor> sensor_;
  std::unique_ptr<Server> server_;  // last: its thread uses what is above
};

}  // namespace halfstep
