#include "experiments/server/web_client.h"

#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <memory>
#include <utility>

#include "experiments/live/messages.h"
#include "experiments/server/message_fields.h"
#include "experiments/server/outgoing_queue.h"

namespace halfstep {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using beast::error_code;

constexpr std::chrono::seconds kHandshake{5};
constexpr std::chrono::seconds kSilence{60};  // of a client that does not even answer a ping
constexpr std::uint32_t kMostHeaderBytes = 8192;

using Request = http::request<http::empty_body>;
using Response = http::response<http::string_body>;

// Whether two texts are equal, in a time that does not tell where they differ.
bool SameSecret(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  unsigned differs = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    differs |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
  }
  return differs == 0;
}

// Of a path "/TOKEN/REST": REST. None for another token.
std::optional<std::string> PathBehind(const std::string& token, std::string_view target) {
  if (target.size() < token.size() + 2 || target.front() != '/' ||
      target[token.size() + 1] != '/' || !SameSecret(target.substr(1, token.size()), token)) {
    return std::nullopt;
  }
  return std::string(target.substr(token.size() + 2));
}

std::string_view Text(boost::string_view text) { return {text.data(), text.size()}; }

class WebClient final : public ClientLine, public std::enable_shared_from_this<WebClient> {
 public:
  WebClient(asio::ip::tcp::socket socket, const WebRules& rules, ClientHub* hub,
            std::function<void()> ended)
      : stream_(std::move(socket)), rules_(rules), hub_(*hub), ended_(std::move(ended)) {}
  ~WebClient() override { ended_(); }
  WebClient(const WebClient&) = delete;
  WebClient& operator=(const WebClient&) = delete;

  void Start() {
    parser_.header_limit(kMostHeaderBytes);
    parser_.body_limit(0);
    stream_.next_layer().expires_after(kHandshake);
    http::async_read(stream_.next_layer(), input_, parser_,
                     [self = shared_from_this()](const error_code& error, size_t) {
                       if (!error) self->Answer(self->parser_.get());
                     });
  }

  void Send(std::shared_ptr<const std::string> message) override {
    if (!output_.Add(std::move(message))) return Drop();
    if (output_.size() == 1) Write();
  }
  void Drop() override { stream_.next_layer().close(); }
  void Finish() override {
    finishes_ = true;
    if (output_.size() == 0) Close();
  }

 private:
  void Answer(const Request& request) {
    const std::optional<std::string> path = PathBehind(rules_.token, Text(request.target()));
    const bool same_origin = request.find(http::field::origin) == request.end() ||
                             Text(request[http::field::origin]) == "http://" + rules_.host;
    if (request.count(http::field::host) != 1 || request.count(http::field::origin) > 1 ||
        Text(request[http::field::host]) != rules_.host || !same_origin) {
      return Reply(http::status::forbidden, "Another host or origin.\n", "text/plain");
    }
    if (!path) return Reply(http::status::not_found, "Nothing is here.\n", "text/plain");
    if (*path == "socket" && websocket::is_upgrade(request)) return Upgrade(request);
    if (request.method() != http::verb::get) {
      return Reply(http::status::method_not_allowed, "Only GET is answered.\n", "text/plain");
    }
    if (!path->empty()) return Reply(http::status::not_found, "Nothing is here.\n", "text/plain");
    Reply(http::status::ok, rules_.page, "text/html; charset=utf-8");
  }

  void Reply(http::status status, const std::string& body, const char* type) {
    response_ = Response{status, 11, body};
    response_.keep_alive(false);
    response_.set(http::field::content_type, type);
    response_.set(http::field::cache_control, "no-store");
    response_.set("Content-Security-Policy",
                  "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
                  "img-src data: blob:; connect-src ws://" +
                      rules_.host +
                      "; base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
    response_.set("X-Content-Type-Options", "nosniff");
    response_.set("Referrer-Policy", "no-referrer");
    response_.set("Cross-Origin-Opener-Policy", "same-origin");
    response_.set("Cross-Origin-Resource-Policy", "same-origin");
    response_.prepare_payload();
    stream_.next_layer().expires_after(kHandshake);
    http::async_write(stream_.next_layer(), response_,
                      [self = shared_from_this()](const error_code&, size_t) {
                        error_code ignored;
                        self->stream_.next_layer().socket().shutdown(
                            asio::ip::tcp::socket::shutdown_send, ignored);
                      });
  }

  void Upgrade(const Request& request) {
    if (input_.size() > 0) return;  // it speaks before it is answered
    if (!hub_.HasRoom()) {
      return Reply(http::status::service_unavailable, "There are too many clients.\n",
                   "text/plain");
    }
    stream_.next_layer().expires_never();
    stream_.set_option(websocket::stream_base::timeout{
        .handshake_timeout = kHandshake, .idle_timeout = kSilence, .keep_alive_pings = true});
    stream_.read_message_max(kMostMessageBytes);
    stream_.async_accept(request, [self = shared_from_this()](const error_code& error) {
      if (error) return;
      if (!self->hub_.HasRoom()) return self->Drop();
      self->stream_.text(true);
      self->hub_.Join(self.get());
      self->Read();
    });
  }

  void Read() {
    stream_.async_read(input_, [self = shared_from_this()](const error_code& error, size_t) {
      if (error) {
        self->hub_.Leave(self.get());
        return self->Drop();
      }
      const std::string text = beast::buffers_to_string(self->input_.data());
      self->input_.consume(self->input_.size());
      self->hub_.Receive(self.get(), text);
      self->Read();
    });
  }

  void Write() {
    stream_.async_write(asio::buffer(output_.first()),
                        [self = shared_from_this()](const error_code& error, size_t) {
                          if (error) return self->Drop();
                          self->output_.RemoveFirst();
                          if (self->output_.size() > 0) {
                            self->Write();
                          } else if (self->finishes_) {
                            self->Close();
                          }
                        });
  }

  void Close() {
    stream_.async_close(websocket::close_code::normal,
                        [self = shared_from_this()](const error_code&) { self->Drop(); });
  }

  websocket::stream<beast::tcp_stream> stream_;
  const WebRules& rules_;
  ClientHub& hub_;
  std::function<void()> ended_;
  beast::flat_buffer input_;
  http::request_parser<http::empty_body> parser_;
  Response response_;
  OutgoingQueue output_;
  bool finishes_ = false;
};

}  // namespace

void ServeConnection(asio::ip::tcp::socket socket, const WebRules& rules, ClientHub* hub,
                     std::function<void()> ended) {
  std::make_shared<WebClient>(std::move(socket), rules, hub, std::move(ended))->Start();
}

}  // namespace halfstep
