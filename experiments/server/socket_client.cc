#include "experiments/server/socket_client.h"

#include <boost/asio/buffer.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/write.hpp>
#include <utility>

#include "experiments/live/messages.h"
#include "experiments/server/message_fields.h"

namespace halfstep {

namespace asio = boost::asio;
using boost::system::error_code;

void SocketClient::Start() {
  if (hub_.HasRoom()) {
    hub_.Join(this);
    Read();
    return;
  }
  Send(std::make_shared<const std::string>(
      MessageText(ErrorMessage("there are too many clients (valid: at most 8)"))));
  Finish();
}

void SocketClient::Read() {
  const auto self = shared_from_this();
  asio::async_read_until(
      socket_, asio::dynamic_buffer(input_, kMostMessageBytes + 1), '\n',
      [self](const error_code& error, size_t bytes) {
        if (error == asio::error::not_found) {  // a line that is too long
          self->Send(std::make_shared<const std::string>(
              MessageText(ErrorMessage("message: too long (valid: at most 1048576 bytes)"))));
        }
        if (error || !self->socket_.is_open()) {  // dropped, though lines are left
          self->hub_.Leave(self.get());
          return self->Finish();
        }
        const std::string line = self->input_.substr(0, bytes - 1);
        self->input_.erase(0, bytes);
        self->hub_.Receive(self.get(), line);
        self->Read();
      });
}

void SocketClient::Send(std::shared_ptr<const std::string> message) {
  if (!socket_.is_open()) return;
  if (!output_.Add(std::move(message))) return Drop();
  if (output_.size() == 1) Write();
}

void SocketClient::Write() {
  const auto self = shared_from_this();
  const std::array<asio::const_buffer, 2> line = {asio::buffer(output_.first()),
                                                  asio::buffer("\n", 1)};
  asio::async_write(socket_, line, [self](const error_code& error, size_t) {
    if (error) return self->Drop();
    self->output_.RemoveFirst();
    if (self->output_.size() > 0) {
      self->Write();
    } else if (self->finishes_) {
      self->Drop();
    }
  });
}

void SocketClient::Drop() {
  error_code ignored;
  socket_.close(ignored);  // ends the reading, which leaves the hub
}

void SocketClient::Finish() {
  finishes_ = true;
  if (output_.size() == 0) Drop();
}

}  // namespace halfstep
