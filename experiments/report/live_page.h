#pragma once

#include <string>
#include <string_view>

namespace halfstep {

/// The page that shows an episode as it goes on, and lets a person take part. It talks to `socket`
/// ("ws://127.0.0.1:8080/TOKEN/socket") and to no other address.
std::string LivePage(std::string_view socket);

}  // namespace halfstep
