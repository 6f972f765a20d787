#include "experiments/tables/volume_cells.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace halfstep {
namespace {

using Eigen::Vector3i;
using nlohmann::json;

int FloorDivided(int a, int b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }

Vector3i Coarse(const Vector3i& cells, int merged) {
  return cells.unaryExpr([merged](int c) { return FloorDivided(c, merged); });
}

// Cells of a lattice that goes through the frame's origin only where the volume's own does.
struct Cells {
  Vector3i lower, size;
  std::vector<uint8_t> full;  // z fastest
};

Cells CellsOf(const BoxTree& volume, int merged) {
  std::vector<BoxTree::CellBox> boxes = volume.SolidBoxes();
  Cells cells{.lower = Vector3i::Zero(), .size = Vector3i::Zero(), .full = {}};
  for (BoxTree::CellBox& box : boxes) {
    box.lower = Coarse(box.lower, merged);
    box.upper = Coarse(box.upper - Vector3i::Ones(), merged) + Vector3i::Ones();
  }
  if (boxes.empty()) return cells;
  Vector3i upper = boxes.front().upper;
  cells.lower = boxes.front().lower;
  for (const BoxTree::CellBox& box : boxes) {
    cells.lower = cells.lower.cwiseMin(box.lower);
    upper = upper.cwiseMax(box.upper);
  }
  cells.size = upper - cells.lower;
  cells.full.resize(static_cast<size_t>(cells.size.cast<int64_t>().prod()), 0);
  for (const BoxTree::CellBox& box : boxes) {
    for (int x = box.lower.x(); x < box.upper.x(); ++x) {
      for (int y = box.lower.y(); y < box.upper.y(); ++y) {
        const Vector3i from = Vector3i(x, y, box.lower.z()) - cells.lower;
        const auto first = cells.full.begin() +
                           (int64_t{from.x()} * cells.size.y() + from.y()) * cells.size.z() +
                           from.z();
        std::fill(first, first + (box.upper.z() - box.lower.z()), uint8_t{1});
      }
    }
  }
  return cells;
}

json RunsOf(const Cells& cells) {
  json runs = json::array();
  uint8_t last = 0;
  int64_t length = 0;
  for (const uint8_t full : cells.full) {
    if (full != last) {
      runs.push_back(length);
      length = 0;
      last = full;
    }
    ++length;
  }
  runs.push_back(length);
  return runs;
}

}  // namespace

json VolumeCells(const BoxTree& volume, int merged) {
  const Cells cells = CellsOf(volume, merged);
  const Eigen::Vector3d lower = volume.origin + merged * volume.cell * cells.lower.cast<double>();
  return {{"lower", {lower.x(), lower.y(), lower.z()}},
          {"size", {cells.size.x(), cells.size.y(), cells.size.z()}},
          {"runs", RunsOf(cells)}};
}

}  // namespace halfstep
