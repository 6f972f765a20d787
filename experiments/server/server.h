#pragma once

#include <functional>
#include <memory>
#include <string>

#include "experiments/server/client_hub.h"

namespace halfstep {

/// Where an episode may be reached.
struct ServerOptions {
  bool view = false;  ///< by HTTP and WebSocket on the loopback address
  int port = 0;       ///< of these; 0: any that is free
  /// The HTML that is served there, for the address of the messages ("ws://…").
  std::function<std::string(const std::string& socket)> page = {};
  std::string socket_path = {};  ///< by a Unix-domain socket; "": none
  /// The address() of a server that is no more, in place of `port` and of a new token; "": none.
  std::string address = {};
};

/// Why this build has no server; "" when it has one.
std::string WhyNoServer();

/// Lets clients reach a hub, in one thread of its own. Messages: README.md.
class Server {
 public:
  /// Borrows the hub, which from now on is of the server's thread. Throws InputError when the port
  /// is taken or the socket cannot be made. Precondition: WhyNoServer() is empty.
  Server(const ServerOptions& options, ClientHub* hub);
  /// Removes the socket.
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// "http://127.0.0.1:PORT/TOKEN/"; "" without `view`. A new token is drawn from the
  /// system.
  const std::string& address() const;

  /// Lets the hub announce the news soon. Any thread may call it.
  void Announce() const;
  /// Tells everybody this message, the last one, and returns when it has left, at the latest after
  /// a second.
  void End(const std::string& message);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace halfstep
