#pragma once

#include <map>
#include <string>

#include "tests/oracle/judge.h"

namespace halfstep::checker {

/// What `halfstep check` said of certificates that were made wrong, by 10⁻¹² to 10⁻³ of a unit.
struct ForgeryTally {
  /// Of one kind of forgery and family.
  struct Count {
    long wrong = 0;   ///< claims that are false by the oracle
    long proved = 0;  ///< of these; none may be
    long close = 0;   ///< claims that are too nearly true for the oracle
  };
  long walks = 0;            ///< certified ones that were forged
  long proved = 0;           ///< of these, as they were
  long refused = 0;          ///< of which the checker says in words that it knows nothing
  long controls = 0;         ///< claims around the same instants that the oracle says are true
  long proved_controls = 0;  ///< of these
  std::map<std::string, Count> raised;  ///< what is demanded of a family is more than what is kept
  std::map<std::string, Count> nudged;  ///< the walk is moved where it keeps just what is demanded
  void Add(const ForgeryTally& other);
};

}  // namespace halfstep::checker
