#include "opt/solvers/own_options.h"

#include <algorithm>

#include "opt/solvers/option_text.h"

namespace halfstep::opt {

std::optional<SolverEnd> ReadOwnOptions(const std::string& solver, SolveMonitor* monitor,
                                        std::vector<OwnOption>* known) {
  constexpr double kMost = 1000;
  for (const auto& [option, value] : monitor->options().solver_options) {
    const auto found = std::find_if(known->begin(), known->end(),
                                    [&](const OwnOption& own) { return own.name == option; });
    if (found == known->end()) {
      std::vector<std::string> names;
      for (const OwnOption& own : *known) names.push_back(own.name);
      return SolverEnd{Ending::kInvalidInput, UnknownOption(solver, option, names), {}};
    }
    const auto number =
        found->integer ? std::optional<double>(ParseInteger(value)) : ParseNumber(value);
    const bool right =
        number && (found->integer ? *number >= 0.0 && *number <= kMost : *number > 0.0);
    if (!right) {
      const char* why = found->integer ? "an integer from 0 to 1000" : "a number above 0";
      return SolverEnd{Ending::kInvalidInput, RefusedOption(solver, option, value, why), {}};
    }
    found->value = *number;
    monitor->Use(option, value);
  }
  return std::nullopt;
}

}  // namespace halfstep::opt
