#include "experiments/server/served_episode.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "experiments/live/messages.h"
#include "experiments/server/client_sensor.h"

namespace halfstep {
namespace {

constexpr int kSpareBoxes = 8;

}  // namespace

LiveConfig ServedEpisode::Served(LiveConfig config) {
  config.live.clock = "wall";
  if (config.live.sensing.source == "stand_in") {
    config.live.spare_boxes = std::max(config.live.spare_boxes, kSpareBoxes);
  }
  return config;
}

LiveConfig ServedEpisode::Controlled(LiveConfig config) {
  config.live.clock = "lockstep";
  return config;
}

ServedEpisode::ServedEpisode(const LiveConfig& config, const Place& place, const TrueWorld& truth,
                             const ServerOptions& options)
    : board_([this] { server_->Announce(); }), hub_(config, place, &inbox_, &board_, nullptr) {
  if (config.live.sensing.source == "client") {
    sensor_ = std::make_unique<ClientSensor>(place.scene, config, &inbox_);
  } else {
    const auto seed = static_cast<std::uint64_t>(config.experiment.seed) + 1;
    auto edited = std::make_unique<EditedSensor>(
        truth, config.live, seed, &inbox_,
        [this](const std::string& sentence) { board_.Refuse(sentence); });
    edited_ = edited.get();
    sensor_ = std::move(edited);
  }
  server_ = std::make_unique<Server>(options, &hub_);
  Wait("half-steps are prepared");
}

ServedEpisode::ServedEpisode(const LiveConfig& config, const Place& place,
                             const ServerOptions& options, const ClientControl::Options& control)
    : board_([this] { server_->Announce(); }),
      control_(
          std::in_place, control,
          ClientControl::Calls{.wake = [this] { server_->Announce(); },
                               .wait = [this](const std::string& reason) { board_.Wait(reason); }}),
      hub_(config, place, &inbox_, &board_, &*control_),
      server_(std::make_unique<Server>(options, &hub_)) {
  Wait("half-steps are prepared");
}

void ServedEpisode::WaitForClient(const std::stop_token& stop) {
  using namespace std::chrono_literals;
  board_.Wait("for its first client");
  while (!inbox_.has_come() && !stop.stop_requested()) std::this_thread::sleep_for(10ms);
}

std::vector<ScriptEvent> ServedEpisode::Script() const {
  return edited_ != nullptr ? edited_->truth().Script() : std::vector<ScriptEvent>{};
}

void ServedEpisode::End(const Episode& episode, const std::string& folder) {
  nlohmann::json message = EndMessage(episode, folder);
  message["again"] = again();
  server_->End(MessageText(message));
}

}  // namespace halfstep
