#include "experiments/commands/live_clients.h"

#include <iostream>

#include "experiments/replay/physics_record.h"
#include "experiments/report/live_page.h"
#include "experiments/report/report_page.h"
#include "wpg/files/input_error.h"

namespace halfstep {
namespace {

bool IsServed(const LiveCommand& command) { return command.view || command.socket; }
// Whether a client controls the robot.
bool IsClientControlled(const LiveCommand& command) {
  return command.simulated.controller == kClientController;
}

// Throws InputError for a client that controls without a socket, or a socket in physics without
// one.
void CheckClientControl(const LiveCommand& command) {
  if (IsClientControlled(command) && !(command.in_physics && command.socket)) {
    throw InputError(
        {"--controller client: no client can come (valid: with --in-physics and --serve)"});
  }
  if (IsClientControlled(command)) return;
  if (command.in_physics && command.socket) {
    throw InputError(
        {"--serve: in physics a client controls the robot (valid: with --controller "
         "client)"});
  }
  if (command.answer_within) {
    throw InputError({"--answer-within: no client is asked (valid: with --controller client)"});
  }
}

}  // namespace

LiveConfig Adapted(const LiveCommand& command, const LiveConfig& config) {
  if (const std::string why = replay::WhyNoSimulation(); command.in_physics && !why.empty()) {
    throw InputError({"--in-physics: " + why});
  }
  CheckClientControl(command);
  if (command.wait && !IsServed(command)) {
    throw InputError({"--wait: no client can come (valid: with --view or --serve)"});
  }
  if (IsServed(command)) {
    if (!WhyNoServer().empty()) throw InputError({"--view, --serve: " + WhyNoServer()});
    if (command.view && !HasReport()) {
      throw InputError({"--view: this build has no page, as it has no report (valid: --serve)"});
    }
    if (!command.in_physics) return ServedEpisode::Served(config);
  }
  if (config.live.sensing.source == "client") {
    throw InputError({command.run.config + ": live.sensing.source: client, but " +
                      (IsServed(command) ? "the world of a simulated robot is measured from it "
                                           "(valid: stand_in)"
                                         : "no client can come (valid: with --serve or --view, or "
                                           "stand_in)")});
  }
  return IsServed(command) ? ServedEpisode::Controlled(config) : config;
}

std::unique_ptr<ServedEpisode> Serve(const LiveCommand& command, const LiveConfig& config,
                                     const Place& place, const TrueWorld& truth,
                                     const std::stop_token& stop, const std::string& address) {
  if (!IsServed(command)) return nullptr;
  const ServerOptions options{.view = command.view,
                              .port = command.port,
                              .page = [](const std::string& socket) { return LivePage(socket); },
                              .socket_path = command.socket.value_or(""),
                              .address = address};
  return command.in_physics
             ? std::make_unique<ServedEpisode>(
                   config, place, options,
                   ClientControl::Options{.patience = command.answer_within, .stop = stop})
             : std::make_unique<ServedEpisode>(config, place, truth, options);
}

void PrintPlaces(const LiveCommand& command, const ServedEpisode& served) {
  std::ostream& screen = command.run.json || command.run.quiet ? std::cerr : std::cout;
  if (command.view) screen << "view         " << served.address() << '\n';
  if (command.socket) screen << "socket       " << *command.socket << '\n';
  screen << (command.in_physics ? "clock        lockstep; the robot waits for the client that "
                                  "controls it\n"
                                : "clock        wall, as clients need it\n")
         << (command.wait ? "waits        for its first client\n" : "")
         << (command.view ? "ends         by End on the page, Ctrl-C, or after live.longest_s\n"
                          : "")
         << std::flush;
}

}  // namespace halfstep
