#pragma once

#include <stdexcept>
#include <string>

namespace halfstep::opt {

/// Precondition of this folder, which includes no sibling: std::logic_error with `message`.
inline void Require(bool condition, const std::string& message) {
  if (!condition) throw std::logic_error("opt: " + message);
}

}  // namespace halfstep::opt
