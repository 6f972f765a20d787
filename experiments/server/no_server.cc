// Stands in for server.cc where Boost is absent or unwanted.
#include <stdexcept>

#include "experiments/server/server.h"

namespace halfstep {

struct Server::State {
  std::string address;
};

std::string WhyNoServer() { return HALFSTEP_WHY_NO_SERVER; }

Server::Server(const ServerOptions&, ClientHub*) { throw std::logic_error(WhyNoServer()); }
Server::~Server() = default;
const std::string& Server::address() const { return state_->address; }
void Server::Announce() const {}
void Server::End(const std::string&) {}

}  // namespace halfstep
