#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace halfstep {

/// What an action throws as std::runtime_error; "" when it throws nothing.
inline std::string RefusalOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

}  // namespace halfstep
