#pragma once

#include <boost/asio/local/stream_protocol.hpp>
#include <memory>
#include <string>

#include "experiments/server/client_hub.h"
#include "experiments/server/outgoing_queue.h"

namespace halfstep {

/// A client on a Unix-domain socket: a message a line, both ways.
class SocketClient final : public ClientLine, public std::enable_shared_from_this<SocketClient> {
 public:
  using Socket = boost::asio::local::stream_protocol::socket;  ///< what a client is connected by

  /// Borrows the hub. It lives until its line ends.
  SocketClient(Socket socket, ClientHub* hub) : socket_(std::move(socket)), hub_(*hub) {}
  void Start();  ///< begins to read

  void Send(std::shared_ptr<const std::string> message) override;
  void Drop() override;
  void Finish() override;

 private:
  void Read();
  void Write();

  Socket socket_;
  ClientHub& hub_;
  std::string input_;
  OutgoingQueue output_;
  bool finishes_ = false;
};

}  // namespace halfstep
