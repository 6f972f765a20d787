#pragma once

#include <stdexcept>
#include <string>

namespace halfstep::opt {

/// Throws std::logic_error with `message` unless `condition` holds. Stands in for HALFSTEP_CHECK,
/// as this folder includes no other.
inline void Require(bool condition, const std::string& message) {
  if (!condition) throw std::logic_error("opt: " + message);
}

}  // namespace halfstep::opt
