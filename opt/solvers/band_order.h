#pragma once

#include <vector>

namespace halfstep::opt {

/// An order of variables 0 … n − 1 that brings those of a clique near to each other, so that the
/// envelope of a matrix with entries within cliques is narrow where they form a chain: reverse
/// Cuthill–McKee, with variables that meet most others last. Returns the position of each variable.
/// Source: [George1981], chapter 4.
std::vector<int> BandPositions(const std::vector<std::vector<int>>& cliques, int variables);

}  // namespace halfstep::opt
