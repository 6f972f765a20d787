#pragma once

#include <string>

#include "opt/problem/problem.h"

namespace halfstep::testing {

/// A published or constructed problem and what is known of it. The start is problem.initial().
struct ProblemCard {
  std::string name;
  std::string source;
  opt::Problem problem;
  double optimum;  ///< least cost
};

}  // namespace halfstep::testing
