#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "experiments/config/experiment.h"
#include "experiments/live/live_config.h"
#include "experiments/server/client_control.h"
#include "experiments/server/client_inbox.h"
#include "experiments/server/client_line.h"
#include "experiments/server/client_message.h"
#include "experiments/server/news_board.h"

namespace halfstep {

/// What clients are told and may want, whatever line they are on. Of one thread, but for the inbox
/// and the board that it is given.
class ClientHub {
 public:
  static constexpr size_t kMostClients = 8;   ///< at one time
  static constexpr int kMostMessages = 1000;  ///< of a client in a second; one that sends more is
                                              ///< dropped

  /// Borrows inbox, board and control. `place`: with the spare boxes. `control`: clients may
  /// control a simulated robot by it, and change nothing in the world; null: there is none.
  ClientHub(const LiveConfig& config, const Place& place, ClientInbox* inbox, NewsBoard* board,
            ClientControl* control);

  /// Whether one more client may come.
  bool HasRoom() const { return clients_.size() < kMostClients; }
  /// A client has come: it is told what is known by now. Precondition: HasRoom(). `line` is
  /// borrowed until Leave().
  void Join(ClientLine* line);
  /// Its line has ended. There will be no more commands when it was the one that controls.
  void Leave(ClientLine* line);
  /// Does what a client says; what is wrong with it is answered, and nothing is thrown. What is
  /// wrong from the client that controls ends its control.
  void Receive(ClientLine* line, std::string_view text);

  /// Tells everybody the news.
  void Announce();
  /// Tells everybody this last message, and finishes every line.
  void End(const std::string& message);

  /// Of the clients.
  size_t size() const { return clients_.size(); }

 private:
  struct Client {
    Subscribe wants;
    std::optional<std::set<int>> volumes;  // it was told of; none: it wants none
    double state_due = 0.0;                // when it is to be told the next state [s]
    std::chrono::steady_clock::time_point second = {};
    int messages = 0;  // since then
  };
  using Text = std::shared_ptr<const std::string>;

  bool Floods(Client* client) const;
  void Do(ClientLine* line, Client* client, const ClientMessage& message);
  // Of a client that wants to control.
  void BeginControl(ClientLine* line);
  void TellControl();
  void Broadcast(const Text& text);
  // Keeps the newest of each kind for those who come later, and tells it.
  void Keep(const std::string& kind, const nlohmann::json& message);
  void TellMotion();
  void TellStates();
  // Tells a client that wants them the volumes of the motion in execution.
  void TellVolumesTo(ClientLine* line, Client* client);
  Text Motion(double ahead) const;
  Text Drawing();

  RobotModel robot_;
  Scene scene_;
  double period_;  // of control [s]
  ClientMessageReader reader_;
  ClientInbox& inbox_;
  NewsBoard& board_;
  ClientControl* control_;
  ClientLine* controls_ = nullptr;  // the client that does; null: none, or it has gone
  std::map<ClientLine*, Client> clients_;
  Text hello_, drawing_;
  std::map<std::string, Text> newest_;  // by kind, but for walks
  nlohmann::json walk_;                 // the newest, whole; null: there is none
  std::shared_ptr<const SweptVolumes> volumes_;
  std::map<int, Text> volume_texts_;                  // that somebody wanted
  EpisodeNews latest_;                                // its motion and its time
  std::chrono::steady_clock::time_point measured_{};  // the newest measurement of a client
};

}  // namespace halfstep
