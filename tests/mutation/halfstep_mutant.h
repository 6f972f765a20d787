#pragma once

#include <cstdlib>
#include <string>

/// Which wrong line of `file` is in place, 0: none. HALFSTEP_MUTANT says so, as `file:number`.
/// Included by the rewritten copies of sources that mutate.py compiles, and by nothing else.
inline int HalfstepMutantOf(const std::string& file) {
  const char* const text = std::getenv("HALFSTEP_MUTANT");
  const std::string chosen = text == nullptr ? "" : text;
  if (!chosen.starts_with(file + ":")) return 0;
  return std::atoi(chosen.c_str() + file.size() + 1);
}
