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

std::string PlanVolumesJson(const PlannedWalk& walk, const HalfStepSequence& sequence) {
  const PlanResult& plan = walk.plan;
  HALFSTEP_CHECK(walk.half_steps.cached.volumes && plan.elements.size() == plan.footsteps.size() &&
                     sequence.half_steps.size() == 2 * plan.footsteps.size(),
                 "no volumes, or no plan");
  const SweptVolumes& all = *walk.half_steps.cached.volumes;
  std::vector<const BoxTree*> volumes;
  std::map<const BoxTree*, size_t> known;
  json half_steps = json::array();
  const auto number_of = [&](const std::optional<BoxTree>& volume) {
    const auto [at, is_new] = known.try_emplace(&*volume, volumes.size());
    if (is_new) volumes.push_back(&*volume);
    return at->second;
  };
  const auto add = [&](const std::vector<const SweptVolumes::Volumes*>& parts, int element,
                       const PlacedHalfStep& placed) {
    const Foothold& X_WS = placed.X_WS;
    json numbers = json::array();
    for (const SweptVolumes::Volumes* part : parts) {
      if (!Nth(*part, element)) return half_steps.push_back(nullptr);
      numbers.push_back(number_of(Nth(*part, element)));
    }
    json half_step = {{"volume", numbers.front()},
                      {"mirrored", placed.half_step.support == Side::kRight},
                      {"X_WS", {X_WS.x, X_WS.y, X_WS.yaw}}};
    if (all.set.on_levels) {
      half_step["z_m"] = X_WS.height;
      half_step["feet"] = {numbers[1], numbers[2]};
    }
    half_steps.push_back(std::move(half_step));
  };
  using Parts = std::vector<const SweptVolumes::Volumes*>;
  const bool levels = all.set.on_levels;
  const Parts up = levels ? Parts{&all.up, &all.up_swing, &all.up_stand} : Parts{&all.up};
  const Parts down = levels ? Parts{&all.down, &all.down_swing, &all.down_stand} : Parts{&all.down};
  for (size_t k = 0; k < plan.footsteps.size(); ++k) {
    if (k == 0) {
      half_steps.push_back(nullptr);  // from the start, proved by itself
    } else {
      add(up, plan.elements[k - 1], sequence.half_steps[2 * k]);
    }
    add(down, plan.elements[k], sequence.half_steps[2 * k + 1]);
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
