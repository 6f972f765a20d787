#pragma once

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <utility>

namespace halfstep {

/// A connection of a test, well or ill behaved. Waits at most half a minute for each answer.
class Connection {
 public:
  static Connection ToSocket(const std::filesystem::path& path) {
    sockaddr_un place{};
    place.sun_family = AF_UNIX;
    path.string().copy(place.sun_path, sizeof place.sun_path - 1);
    return Connection(AF_UNIX, reinterpret_cast<const sockaddr*>(&place), sizeof place);
  }
  static Connection ToPort(int port) {
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(static_cast<std::uint16_t>(port));
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return Connection(AF_INET, reinterpret_cast<const sockaddr*>(&place), sizeof place);
  }
  ~Connection() {
    if (file_ >= 0) close(file_);
  }
  Connection(Connection&& other) noexcept
      : file_(std::exchange(other.file_, -1)), input_(std::move(other.input_)) {}
  Connection(const Connection&) = delete;
  Connection& operator=(Connection&&) = delete;

  /// Whether everything was taken: false when the other side has gone.
  bool Send(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t sent = send(file_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (sent <= 0) return false;
      bytes.remove_prefix(static_cast<size_t>(sent));
    }
    return true;
  }
  bool SendLine(const nlohmann::json& message) { return Send(message.dump() + "\n"); }

  /// The next bytes up to and with `mark`; what there is when the other side has gone.
  std::string ReadPast(std::string_view mark) {
    size_t found;
    while ((found = input_.find(mark)) == std::string::npos) {
      if (!ReadMore()) return std::exchange(input_, "");
    }
    return Take(found + mark.size());
  }
  std::string Read(size_t bytes) {
    while (input_.size() < bytes) {
      if (!ReadMore()) return std::exchange(input_, "");
    }
    return Take(bytes);
  }
  std::string ReadAll() {
    while (ReadMore()) {
    }
    return std::exchange(input_, "");
  }

  /// Whether the other side goes, though nothing is read.
  bool IsDropped() {
    pollfd ended{.fd = file_, .events = POLLRDHUP, .revents = 0};
    return poll(&ended, 1, 30'000) > 0;
  }

  /// The next line as JSON; null when the other side has gone.
  nlohmann::json ReadLine() {
    const std::string line = ReadPast("\n");
    if (line.empty()) return {};
    nlohmann::json message = nlohmann::json::parse(line);
    if (message["type"] == "walk") walk_duration_ = message["duration_s"];
    return message;
  }
  /// Of the newest walk that a line was about [s].
  double walk_duration() const { return walk_duration_; }
  /// The next line of that type for which `wanted` holds; fails the test when there is none.
  template <typename Wanted>
  nlohmann::json ReadUntil(const std::string& type, const Wanted& wanted) {
    for (nlohmann::json message = ReadLine(); !message.is_null(); message = ReadLine()) {
      if (message["type"] == type && wanted(message)) return message;
    }
    ADD_FAILURE() << "no such " << type;
    throw std::runtime_error("the line has ended");
  }
  nlohmann::json ReadUntil(const std::string& type) {
    return ReadUntil(type, [](const nlohmann::json&) { return true; });
  }

 private:
  Connection(int family, const sockaddr* place, socklen_t size)
      : file_(socket(family, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    if (connect(file_, place, size) != 0) {
      close(file_);
      throw std::runtime_error(std::string("cannot connect: ") + std::strerror(errno));
    }
  }
  bool ReadMore() {
    pollfd ready{.fd = file_, .events = POLLIN, .revents = 0};
    if (poll(&ready, 1, 30'000) <= 0) return false;
    char bytes[65536];
    const ssize_t got = recv(file_, bytes, sizeof bytes, 0);
    if (got <= 0) return false;
    input_.append(bytes, static_cast<size_t>(got));
    return true;
  }
  std::string Take(size_t bytes) {
    std::string taken = input_.substr(0, bytes);
    input_.erase(0, bytes);
    return taken;
  }

  int file_;
  std::string input_;
  double walk_duration_ = 1e9;
};

/// The beginning of a request for `path`; without the empty line that ends it.
inline std::string Get(const std::string& path, const std::string& host) {
  return "GET " + path + " HTTP/1.1\r\nHost: " + host + "\r\n";
}
/// What a WebSocket adds to it.
inline constexpr char kUpgrade[] =
    "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
    "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";

/// A frame of a WebSocket's client with the mask 0; `first`: 0x81 is a whole text message.
inline std::string MaskedFrame(std::string_view payload, unsigned char first = 0x81) {
  std::string frame(1, static_cast<char>(first));
  if (payload.size() < 126) {
    frame += static_cast<char>(0x80 | payload.size());
  } else {
    frame += static_cast<char>(0xff);
    for (int shift = 56; shift >= 0; shift -= 8) {
      frame += static_cast<char>((payload.size() >> shift) & 0xff);
    }
  }
  return frame + std::string(4, '\0') + std::string(payload);
}

/// The payload of the next frame of a server.
inline std::string ReadFrame(Connection* connection) {
  const std::string head = connection->Read(2);
  if (head.size() < 2) return "";
  size_t length = static_cast<unsigned char>(head[1]) & 0x7f;
  if (length >= 126) {
    const std::string more = connection->Read(length == 126 ? 2 : 8);
    length = 0;
    for (const char byte : more) length = length << 8 | static_cast<unsigned char>(byte);
  }
  return connection->Read(length);
}

}  // namespace halfstep
