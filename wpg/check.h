#pragma once

#include <sstream>
#include <stdexcept>

/// Always-on precondition (also in Release): throws std::logic_error that names the condition, the
/// place and the values, e.g. HALFSTEP_CHECK(tau >= 0, "tau = " << tau).
#define HALFSTEP_CHECK(condition, values)                                                       \
  do {                                                                                          \
    if (!(condition)) {                                                                         \
      std::ostringstream halfstep_check_message;                                                \
      halfstep_check_message << __FILE__ << ":" << __LINE__ << ": precondition `" << #condition \
                             << "` does not hold: " << values;                                  \
      throw std::logic_error(halfstep_check_message.str());                                     \
    }                                                                                           \
  } while (false)
