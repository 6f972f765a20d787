#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace halfstep {

/// The page that shows an episode as it goes on, and lets a person take part. It talks to `socket`
/// ("ws://127.0.0.1:8080/TOKEN/socket") and to no other address: its policy says so. It expects to
/// be served at the address whose "socket", relative to it, this is.
/// Precondition: HasReport() (report_page.h).
std::string LivePage(std::string_view socket);

/// The same page as a recording: one HTML file that needs no other and no network. `recording`:
/// `messages` of the protocol (hello, draw, world, walk, grant, event, end), `motion`
/// (MotionJson()), `clock` of the episode, `outcome` in words. Precondition: HasReport().
std::string RecordingPage(const nlohmann::json& recording);

}  // namespace halfstep
