#include "opt/solvers/band_order.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace halfstep::opt {
namespace {

// A variable that meets more than this times √n others is no part of a band.
constexpr double kDense = 10.0;

// The variables that each variable shares a clique with, itself included.
std::vector<std::vector<int>> Neighbours(const std::vector<std::vector<int>>& cliques, size_t n) {
  std::vector<std::vector<size_t>> cliques_of(n);
  for (size_t k = 0; k < cliques.size(); ++k) {
    for (const int v : cliques[k]) cliques_of[static_cast<size_t>(v)].push_back(k);
  }
  std::vector<std::vector<int>> neighbours(n);
  std::vector<int> met(n, -1);  // the last variable that it was met from
  for (size_t v = 0; v < n; ++v) {
    for (const size_t k : cliques_of[v]) {
      for (const int w : cliques[k]) {
        if (std::exchange(met[static_cast<size_t>(w)], static_cast<int>(v)) == static_cast<int>(v))
          continue;
        neighbours[v].push_back(w);
      }
    }
  }
  return neighbours;
}

// Appends the variables that can be reached from `start`, nearest first, and marks them.
void Walk(const std::vector<std::vector<int>>& neighbours, int start, std::vector<bool>* met,
          std::vector<int>* order) {
  const auto degree = [&](int v) { return neighbours[static_cast<size_t>(v)].size(); };
  size_t next = order->size();
  order->push_back(start);
  (*met)[static_cast<size_t>(start)] = true;
  while (next < order->size()) {
    const std::vector<int>& around = neighbours[static_cast<size_t>((*order)[next++])];
    const auto added = static_cast<std::ptrdiff_t>(order->size());
    for (const int v : around) {
      if ((*met)[static_cast<size_t>(v)]) continue;
      (*met)[static_cast<size_t>(v)] = true;
      order->push_back(v);
    }
    std::stable_sort(order->begin() + added, order->end(),
                     [&](int a, int b) { return degree(a) < degree(b); });
  }
}

}  // namespace

std::vector<int> BandPositions(const std::vector<std::vector<int>>& cliques, int variables) {
  const auto n = static_cast<size_t>(variables);
  const std::vector<std::vector<int>> neighbours = Neighbours(cliques, n);
  std::vector<bool> met(n, false);
  std::vector<int> dense;
  for (size_t v = 0; v < n; ++v) {
    if (static_cast<double>(neighbours[v].size()) <= kDense * std::sqrt(n)) continue;
    dense.push_back(static_cast<int>(v));
    met[v] = true;
  }
  std::vector<int> order;
  for (size_t v = 0; v < n; ++v) {
    if (met[v]) continue;
    // From one end of what is connected: the last that is met from anywhere.
    std::vector<int> way;
    std::vector<bool> seen = met;
    Walk(neighbours, static_cast<int>(v), &seen, &way);
    Walk(neighbours, way.back(), &met, &order);
  }
  std::reverse(order.begin(), order.end());
  order.insert(order.end(), dense.begin(), dense.end());
  std::vector<int> positions(n);
  for (size_t p = 0; p < n; ++p) positions[static_cast<size_t>(order[p])] = static_cast<int>(p);
  return positions;
}

}  // namespace halfstep::opt
