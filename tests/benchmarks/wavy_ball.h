#pragma once

#include <cmath>
#include <numbers>

#include "planner/scene/shape.h"

namespace halfstep {

/// A wavy surface of 2·n·(n − 1) triangles, without caps, about `radius` [m] from the origin.
inline TriangleMesh WavyBall(int n, double radius) {
  TriangleMesh mesh;
  mesh.vertices.resize(3, n * n);
  mesh.triangles.resize(3, 2 * n * (n - 1));
  int t = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double polar = std::numbers::pi * (i + 0.5) / n, around = 2 * std::numbers::pi * j / n;
      const double r = radius + 0.02 * std::sin(5 * around) * std::sin(7 * polar);
      mesh.vertices.col(i * n + j) << r * std::sin(polar) * std::cos(around),
          r * std::sin(polar) * std::sin(around), r * std::cos(polar);
      const int next = (j + 1) % n;
      if (i + 1 == n) continue;
      mesh.triangles.col(t++) << i * n + j, (i + 1) * n + j, (i + 1) * n + next;
      mesh.triangles.col(t++) << i * n + j, (i + 1) * n + next, i * n + next;
    }
  }
  return mesh;
}

}  // namespace halfstep
