#include "experiments/server/client_hub.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "experiments/live/messages.h"
#include "experiments/live/spare_boxes.h"
#include "experiments/live/volume_messages.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

using std::chrono::steady_clock;

std::shared_ptr<const std::string> TextOf(const nlohmann::json& message) {
  return std::make_shared<const std::string>(MessageText(message));
}

}  // namespace

ClientHub::ClientHub(const LiveConfig& config, const Place& place, ClientInbox* inbox,
                     NewsBoard* board, ClientControl* control)
    : robot_(place.robot),
      scene_(place.scene),
      period_(config.live.period),
      reader_(place.scene, config.live,
              control != nullptr ? ClientPart::kControl : ClientPart::kWorld),
      inbox_(*inbox),
      board_(*board),
      control_(control),
      hello_(TextOf(HelloMessage(config, robot_, scene_, SpareNames(config.live)))) {}

void ClientHub::Join(ClientLine* line) {
  clients_.emplace(line, Client{});
  inbox_.Come();
  line->Send(hello_);
  const auto tell = [&](const char* kind) {
    if (const auto text = newest_.find(kind); text != newest_.end()) line->Send(text->second);
  };
  tell("waiting");
  tell("world");
  if (!walk_.is_null()) line->Send(TextOf(walk_));
  tell("grant");
}

void ClientHub::Leave(ClientLine* line) {
  clients_.erase(line);
  if (line != controls_) return;
  controls_ = nullptr;
  control_->Lose("the client that controls the robot has gone");
}

bool ClientHub::Floods(Client* client) const {
  const steady_clock::time_point now = steady_clock::now();
  if (now - client->second >= std::chrono::seconds(1)) {
    client->second = now;
    client->messages = 0;
  }
  return ++client->messages > kMostMessages;
}

void ClientHub::Receive(ClientLine* line, std::string_view text) {
  const auto client = clients_.find(line);
  if (client == clients_.end()) return;
  const bool answers = line == controls_ && control_->asks();  // as fast as it is asked
  if (!answers && Floods(&client->second)) return line->Drop();
  try {
    Do(line, &client->second, reader_.Read(text));
  } catch (const std::exception& error) {
    line->Send(TextOf(ErrorMessage(error.what())));
    if (line != controls_) return;
    control_->Lose(std::string("the client that controls the robot answered badly: ") +
                   error.what());
  }
}

void ClientHub::Do(ClientLine* line, Client* client, const ClientMessage& message) {
  constexpr const char* kFull = "message: too many wait to be taken (valid: fewer a second)";
  if (const auto* wants = std::get_if<Subscribe>(&message)) {
    client->wants = *wants;
    client->state_due = 0.0;
    if (latest_.executed && wants->motion > 0.0) line->Send(Motion(wants->motion));
  } else if (std::holds_alternative<Draw>(message)) {
    line->Send(Drawing());
  } else if (std::holds_alternative<TellVolumes>(message)) {
    if (!client->volumes) client->volumes.emplace();
    TellVolumesTo(line, client);
  } else if (const auto* frame = std::get_if<MeasuredFrame>(&message)) {
    const auto at = steady_clock::now() - std::chrono::duration_cast<steady_clock::duration>(
                                              std::chrono::duration<double>(frame->age));
    if (at <= measured_) {
      throw InputError({"measured.age_s: not newer than a measurement before it"});
    }
    measured_ = at;
    if (!inbox_.Add({at, *frame})) throw InputError({kFull});
  } else if (const auto* edit = std::get_if<Edit>(&message)) {
    if (!inbox_.Add(*edit)) throw InputError({kFull});
  } else if (const auto* hold = std::get_if<Hold>(&message)) {
    inbox_.Hold(hold->held);
  } else if (std::holds_alternative<halfstep::End>(message)) {
    inbox_.End();
  } else if (std::holds_alternative<Again>(message)) {
    inbox_.Again();
  } else if (std::holds_alternative<Controls>(message)) {
    BeginControl(line);
  } else if (const auto* command = std::get_if<Commanded>(&message)) {
    if (line != controls_) {
      throw InputError(
          {"command: another client controls the robot, or none does (valid: from the "
           "client that said control)"});
    }
    control_->Answer(*command);
  }
}

void ClientHub::BeginControl(ClientLine* line) {
  if (controls_ != nullptr) {
    throw InputError({"control: a client controls the robot already (valid: once)"});
  }
  controls_ = line;
  control_->Begin();
  TellControl();
}

void ClientHub::TellControl() {
  if (controls_ == nullptr) return;
  for (const Text& text : control_->TakeMessages()) controls_->Send(text);
}

void ClientHub::Broadcast(const Text& text) {
  for (const auto& [line, client] : clients_) line->Send(text);
}

void ClientHub::Keep(const std::string& kind, const nlohmann::json& message) {
  Broadcast(newest_[kind] = TextOf(message));
}

void ClientHub::Announce() {
  TellControl();
  EpisodeNews news = board_.Take();
  if (news.volumes) volumes_ = news.volumes;
  if (news.waiting) Keep("waiting", WaitingMessage(*news.waiting));
  for (size_t i = 0; i < news.worlds.size(); ++i) {
    Keep("world", WorldMessage(news.worlds[i], news.known[i]));
  }
  for (size_t i = 0; i < news.walks.size(); ++i) {
    newest_.erase("waiting");
    nlohmann::json message = WalkMessage(news.walks[i], news.first_walk + i);
    Broadcast(TextOf(message));
    MakeWhole(std::move(walk_), &message);
    walk_ = std::move(message);
  }
  for (size_t i = 0; i < news.grants.size(); ++i) {
    Keep("grant", GrantMessage(news.grants[i], news.first_grant + i));
  }
  for (const EpisodeEvent& event : news.events) Broadcast(TextOf(EventMessage(event)));
  for (const std::string& refusal : news.refusals) Broadcast(TextOf(ErrorMessage(refusal)));
  if (!news.executed) return;
  const bool another = news.executed != latest_.executed;
  const bool granted = !news.grants.empty();
  latest_ = std::move(news);
  if (another || granted) TellMotion();
  if (another) {
    for (auto& [line, client] : clients_) TellVolumesTo(line, &client);
  }
  TellStates();
}

void ClientHub::TellMotion() {
  std::map<double, Text> by_length;
  for (const auto& [line, client] : clients_) {
    if (!(client.wants.motion > 0.0)) continue;
    Text& text = by_length[client.wants.motion];
    if (!text) text = Motion(client.wants.motion);
    line->Send(text);
  }
}

void ClientHub::TellStates() {
  Text state;
  for (auto& [line, client] : clients_) {
    if (!(client.wants.state_period > 0.0) || latest_.now < client.state_due) continue;
    // A thousandth of the control period is rounding of ticks.
    client.state_due = latest_.now + client.wants.state_period - 1e-3 * period_;
    if (!state) {
      state = TextOf(StateMessage(robot_, *latest_.executed, latest_.now, latest_.stopped,
                                  latest_.held, latest_.first_half_step));
    }
    line->Send(state);
  }
}

void ClientHub::TellVolumesTo(ClientLine* line, Client* client) {
  if (!client->volumes || !volumes_ || !latest_.executed) return;
  const auto placed = VolumesOf(*latest_.executed, *volumes_);
  for (const std::optional<PlacedVolume>& one : placed) {
    if (!one || !client->volumes->insert(one->volume).second) continue;
    Text& text = volume_texts_[one->volume];
    if (!text) text = TextOf(VolumeMessage(one->volume, *volumes_));
    line->Send(text);
  }
  line->Send(TextOf(VolumesMessage(placed, latest_.num_walks - 1, latest_.first_half_step)));
}

ClientHub::Text ClientHub::Motion(double ahead) const {
  return TextOf(MotionMessage(robot_, *latest_.executed, latest_.num_walks - 1, latest_.now,
                              latest_.now + ahead, period_));
}

ClientHub::Text ClientHub::Drawing() {
  if (!drawing_) drawing_ = TextOf(DrawMessage(robot_, scene_));
  return drawing_;
}

void ClientHub::End(const std::string& message) {
  const auto text = std::make_shared<const std::string>(message);
  Broadcast(text);
  for (const auto& [line, client] : clients_) line->Finish();
}

}  // namespace halfstep
