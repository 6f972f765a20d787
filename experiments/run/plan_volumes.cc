#include "experiments/run/plan_volumes.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "wpg/check.h"

namespace halfstep {
namespace {

using Eigen::Vector3i;
using nlohmann::json;

constexpr size_t kMostRuns = 400000;  // of all volumes: 1.3 MB of a page

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

json VolumesJson(const std::vector<const BoxTree*>& volumes, int merged, size_t* num_runs) {
  json all = json::array();
  *num_runs = 0;
  for (const BoxTree* volume : volumes) {
    const Cells cells = CellsOf(*volume, merged);
    json runs = RunsOf(cells);
    *num_runs += runs.size();
    const Eigen::Vector3d lower =
        volume->origin + merged * volume->cell * cells.lower.cast<double>();
    all.push_back({{"lower", {lower.x(), lower.y(), lower.z()}},
                   {"size", {cells.size.x(), cells.size.y(), cells.size.z()}},
                   {"runs", std::move(runs)}});
  }
  return all;
}

}  // namespace

std::string PlanVolumesJson(const PlannedWalk& walk) {
  const PlanResult& plan = walk.plan;
  HALFSTEP_CHECK(walk.half_steps.cached.volumes && plan.elements.size() == plan.footsteps.size(),
                 "no volumes, or no plan");
  const SweptVolumes& all = *walk.half_steps.cached.volumes;
  std::vector<const BoxTree*> volumes;
  std::map<const BoxTree*, size_t> known;
  json half_steps = json::array();
  const auto add = [&](const std::optional<BoxTree>& volume, Side support, const Footprint& X_WS) {
    if (!volume) return half_steps.push_back(nullptr);
    const auto [at, is_new] = known.try_emplace(&*volume, volumes.size());
    if (is_new) volumes.push_back(&*volume);
    half_steps.push_back({{"volume", at->second},
                          {"mirrored", support == Side::kRight},
                          {"X_WS", {X_WS.x, X_WS.y, X_WS.yaw}}});
  };
  Footprint stands = Index(Opposite(plan.footsteps.front().side)) == 0 ? walk.config.start_left
                                                                       : walk.config.start_right;
  for (size_t k = 0; k < plan.footsteps.size(); ++k) {
    const Side support = Opposite(plan.footsteps[k].side);
    if (k == 0) {
      half_steps.push_back(nullptr);
    } else {
      add(all.up[static_cast<size_t>(plan.elements[k - 1])], support, stands);
    }
    add(all.down[static_cast<size_t>(plan.elements[k])], support, stands);
    stands = plan.footsteps[k].X_WF;
  }
  const double baked = volumes.empty() ? 0.0 : volumes.front()->cell;
  int merged = 1;
  size_t num_runs = 0;
  json drawn = VolumesJson(volumes, merged, &num_runs);
  while (num_runs > kMostRuns && merged < 16) {
    merged *= 2;
    drawn = VolumesJson(volumes, merged, &num_runs);
  }
  return json({{"baked_cell_m", baked},
               {"cell_m", merged * baked},
               {"volumes", std::move(drawn)},
               {"half_steps", std::move(half_steps)}})
             .dump() +
         "\n";
}

}  // namespace halfstep
