#include "experiments/run/plan_volumes.h"

#include <map>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "experiments/tables/volume_cells.h"
#include "wpg/check.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using nlohmann::json;

constexpr size_t kMostRuns = 400000;  // of all volumes: 1.3 MB of a page

json VolumesJson(const std::vector<const BoxTree*>& volumes, int merged, size_t* num_runs) {
  json all = json::array();
  *num_runs = 0;
  for (const BoxTree* volume : volumes) {
    json cells = VolumeCells(*volume, merged);
    *num_runs += cells["runs"].size();
    all.push_back(std::move(cells));
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
  const auto add = [&](const std::optional<BoxTree>& volume, Side support, const Pose2& X_WS) {
    if (!volume) return half_steps.push_back(nullptr);
    const auto [at, is_new] = known.try_emplace(&*volume, volumes.size());
    if (is_new) volumes.push_back(&*volume);
    half_steps.push_back({{"volume", at->second},
                          {"mirrored", support == Side::kRight},
                          {"X_WS", {X_WS.x, X_WS.y, X_WS.yaw}}});
  };
  Pose2 stands = Index(Opposite(plan.footsteps.front().side)) == 0 ? walk.config.start_left
                                                                   : walk.config.start_right;
  for (size_t k = 0; k < plan.footsteps.size(); ++k) {
    const Side support = Opposite(plan.footsteps[k].side);
    if (k == 0) {
      half_steps.push_back(nullptr);
    } else {
      add(Nth(all.up, plan.elements[k - 1]), support, stands);
    }
    add(Nth(all.down, plan.elements[k]), support, stands);
    stands = plan.footsteps[k].X_WF.LevelPose();
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
