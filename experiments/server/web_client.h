#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <functional>
#include <string>

#include "experiments/server/client_hub.h"

namespace halfstep {

/// What a request must be for, and what it is given. Immutable.
struct WebRules {
  std::string host;   ///< "127.0.0.1:PORT"
  std::string token;  ///< first part of every path
  std::string page;   ///< HTML
};

/// Answers one connection: the page at /TOKEN/, a client's line by WebSocket at /TOKEN/socket, and
/// a refusal for everything else. It lives until the connection ends; then `ended` is called.
/// `rules` and `hub` are borrowed.
void ServeConnection(boost::asio::ip::tcp::socket socket, const WebRules& rules, ClientHub* hub,
                     std::function<void()> ended);

}  // namespace halfstep
