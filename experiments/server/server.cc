#include "experiments/server/server.h"

#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <charconv>
#include <chrono>
#include <cstring>
#include <exception>
#include <filesystem>
#include <optional>
#include <regex>
#include <system_error>
#include <thread>
#include <utility>

#include "experiments/server/socket_client.h"
#include "experiments/server/web_client.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using Local = asio::local::stream_protocol;
using boost::system::error_code;

constexpr int kMostConnections = 16;                 // of the port, those without a client included
constexpr std::chrono::milliseconds kPatience{100};  // after a connection that could not be taken
constexpr std::chrono::seconds kFarewell{1};

// 128 bits as 32 hexadecimal digits.
std::string DrawToken() {
  std::array<unsigned char, 16> bytes;
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw std::system_error(errno, std::generic_category(), "the system gives no random bytes");
  }
  std::string token;
  for (const unsigned char byte : bytes) token += Formatted("%02x", byte);
  return token;
}

}  // namespace

std::string WhyNoServer() { return ""; }

struct Server::State {
  explicit State(ClientHub* h) : hub(*h), work(io.get_executor()) {}
  ~State() {
    io.stop();
    if (thread.joinable()) thread.join();
    if (!socket_path.empty()) unlink(socket_path.c_str());
  }

  // At the address of a server before, unless that is "".
  void OpenPort(int port, const std::string& before,
                const std::function<std::string(const std::string&)>& page) {
    web.emplace(io);
    std::string token;
    const std::regex place_of("http://127\\.0\\.0\\.1:([0-9]+)/([0-9a-f]+)/");
    if (std::smatch match; std::regex_match(before, match, place_of)) {
      const std::string digits = match[1];
      std::from_chars(digits.data(), digits.data() + digits.size(), port);
      token = match[2];
    }
    error_code error;
    const tcp::endpoint place(asio::ip::address_v4::loopback(), static_cast<unsigned short>(port));
    web->open(place.protocol());
    web->set_option(asio::socket_base::reuse_address(true));
    if (!web->bind(place, error)) web->listen(asio::socket_base::max_listen_connections, error);
    if (error) {
      throw InputError(
          {Formatted("--port: %d: ", port) + error.message() + " (valid: a free port; 0: any)"});
    }
    rules.host = Formatted("127.0.0.1:%d", web->local_endpoint().port());
    rules.token = token.empty() ? DrawToken() : token;
    address = "http://" + rules.host + "/" + rules.token + "/";
    rules.page = page("ws://" + rules.host + "/" + rules.token + "/socket");
    AcceptWeb();
  }

  void AcceptWeb() {
    web->async_accept([this](const error_code& error, tcp::socket socket) {
      if (error) return Later([this] { AcceptWeb(); });
      if (connections < kMostConnections) {
        ++connections;
        ServeConnection(std::move(socket), rules, &hub, [this] { --connections; });
      }
      AcceptWeb();
    });
  }

  void OpenSocket(const std::string& path) {
    const auto fail = [&path](const std::string& why) {
      throw InputError({"--serve: " + Quote(path) + ": " + why});
    };
    if (path.size() >= sizeof(sockaddr_un::sun_path)) fail("too long (valid: up to 107 bytes)");
    local.emplace(io);
    error_code error;
    const Local::endpoint place(path);
    std::error_code ignored;
    if (std::filesystem::is_socket(std::filesystem::symlink_status(path, ignored))) {
      // Left behind by a process that was killed, unless somebody answers.
      Local::socket other(io);
      if (!other.connect(place, error)) fail("another process serves there (valid: a new path)");
      if (error == asio::error::connection_refused) unlink(path.c_str());
      error = {};
    }
    local->open(place.protocol());
    if (local->bind(place, error)) fail(error.message() + " (valid: a new path)");
    socket_path = path;
    // Nobody can connect before it listens.
    if (chmod(path.c_str(), S_IRUSR | S_IWUSR) != 0) fail(std::strerror(errno));
    if (local->listen(asio::socket_base::max_listen_connections, error)) fail(error.message());
    AcceptLocal();
  }

  void AcceptLocal() {
    local->async_accept([this](const error_code& error, Local::socket socket) {
      if (error) return Later([this] { AcceptLocal(); });
      std::make_shared<SocketClient>(std::move(socket), &hub)->Start();
      AcceptLocal();
    });
  }

  // No more descriptors, say: tries again in a while.
  template <typename Function>
  void Later(Function function) {
    const auto timer = std::make_shared<asio::steady_timer>(io, kPatience);
    timer->async_wait([timer, function](const error_code& error) {
      if (!error) function();
    });
  }

  void Run() {
    while (!io.stopped()) {
      try {
        io.run();
      } catch (const std::exception&) {
        // Of one handler, whose connection ends with it.
      }
    }
  }

  // Looks whether every client has gone.
  void WaitUntilEmpty() {
    if (hub.size() == 0) return io.stop();
    const auto timer = std::make_shared<asio::steady_timer>(io, std::chrono::milliseconds(5));
    timer->async_wait([this, timer](const error_code&) { WaitUntilEmpty(); });
  }

  ClientHub& hub;
  WebRules rules;
  std::string address, socket_path;
  int connections = 0;
  asio::io_context io{1};  // behind what its handlers use
  asio::executor_work_guard<asio::io_context::executor_type> work;
  std::optional<tcp::acceptor> web;
  std::optional<Local::acceptor> local;
  std::thread thread;
};

Server::Server(const ServerOptions& options, ClientHub* hub)
    : state_(std::make_unique<State>(hub)) {
  if (options.view) state_->OpenPort(options.port, options.address, options.page);
  if (!options.socket_path.empty()) state_->OpenSocket(options.socket_path);
  state_->thread = std::thread([state = state_.get()] { state->Run(); });
}

Server::~Server() = default;

const std::string& Server::address() const { return state_->address; }

void Server::Announce() const {
  asio::post(state_->io, [state = state_.get()] { state->hub.Announce(); });
}

void Server::End(const std::string& message) {
  asio::post(state_->io, [state = state_.get(), message] {
    error_code ignored;
    if (state->web) state->web->close(ignored);
    if (state->local) state->local->close(ignored);
    state->hub.End(message);
    state->WaitUntilEmpty();
    const auto timer = std::make_shared<asio::steady_timer>(state->io, kFarewell);
    timer->async_wait([state, timer](const error_code&) { state->io.stop(); });
  });
  state_->thread.join();
}

}  // namespace halfstep
