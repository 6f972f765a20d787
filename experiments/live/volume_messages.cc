#include "experiments/live/volume_messages.h"

#include <utility>

#include "experiments/live/isolated_half_steps.h"
#include "experiments/tables/volume_cells.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

using nlohmann::json;

constexpr size_t kMostVolumeRuns = 8000;  // of one volume: 30 kB of a message
constexpr int kMostMerged = 16;

const std::optional<BoxTree>& VolumeAt(int volume, const SweptVolumes& volumes) {
  const int down = volumes.set.size();
  return volume < down ? Nth(volumes.down, volume) : Nth(volumes.up, volume - down);
}

}  // namespace

std::vector<std::optional<PlacedVolume>> VolumesOf(const SuperposedWalk& walk,
                                                   const SweptVolumes& volumes) {
  std::vector<std::optional<PlacedVolume>> placed(static_cast<size_t>(walk.num_half_steps()));
  for (int i = 0; i < walk.num_half_steps(); ++i) {
    const HalfStep& half_step = walk.half_step(i);
    const std::optional<SetElement> element = ElementOf(half_step, volumes.set);
    if (!element || walk.X_WS(i).height != 0.0) continue;
    const bool down = half_step.kind == HalfStepKind::kDown;
    const int volume = element->index + (down ? 0 : volumes.set.size());
    if (!VolumeAt(volume, volumes)) continue;
    Nth(placed, i) = {
        .volume = volume, .mirrored = half_step.support == Side::kRight, .X_WS = walk.X_WS(i)};
  }
  return placed;
}

json VolumesMessage(const std::vector<std::optional<PlacedVolume>>& half_steps, size_t walk,
                    int first) {
  json all = json::array();
  for (const std::optional<PlacedVolume>& one : half_steps) {
    if (!one) {
      all.push_back(nullptr);
      continue;
    }
    all.push_back({{"volume", one->volume},
                   {"mirrored", one->mirrored},
                   {"X_WS", {one->X_WS.x, one->X_WS.y, one->X_WS.yaw}}});
  }
  return {{"type", "volumes"},
          {"walk", walk},
          {"first_half_step", first + 1},
          {"half_steps", std::move(all)}};
}

json VolumeMessage(int volume, const SweptVolumes& volumes) {
  const BoxTree& tree = *VolumeAt(volume, volumes);
  int merged = 1;
  json message = VolumeCells(tree, merged);
  while (message["runs"].size() > kMostVolumeRuns && merged < kMostMerged) {
    merged *= 2;
    message = VolumeCells(tree, merged);
  }
  message["type"] = "volume";
  message["volume"] = volume;
  message["baked_cell_m"] = tree.cell;
  message["cell_m"] = merged * tree.cell;
  return message;
}

}  // namespace halfstep
