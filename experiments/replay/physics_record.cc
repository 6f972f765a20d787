#include "experiments/replay/physics_record.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "experiments/run/complete_manifest.h"
#include "experiments/tables/json_file.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"

namespace halfstep::replay {
namespace {

using nlohmann::ordered_json;

std::string TextOf(const ordered_json& json) {
  return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

// What the manifest says of it.
ordered_json RecordOf(const PhysicalOutcome& outcome) {
  const ReplayResult& result = outcome.replayed.result;
  const auto at_rest = std::ranges::count(result.touches, true, &TouchRecord::at_rest);
  ordered_json json = {{"engine", "mujoco " + EngineVersion()},
                       {"stayed_up", result.stayed_up},
                       {"ended_s", result.ended},
                       {"touches_walking", std::ssize(result.touches) - at_rest},
                       {"touches_at_rest", at_rest},
                       {"in_goal", outcome.in_goal},
                       {"goal_off_m", outcome.goal_off}};
  if (!outcome.lost.empty()) json["controller_lost"] = outcome.lost;
  if (std::isfinite(outcome.no_step)) json["no_step_m"] = outcome.no_step;
  for (const Push& push : outcome.pushes) {
    json["pushed"].push_back({{"at_s", push.at},
                              {"for_s", push.duration},
                              {"x_n_s", push.impulse_W.x()},
                              {"y_n_s", push.impulse_W.y()}});
  }
  const ordered_json told = ordered_json::parse(ReplayedJson(outcome.replayed));
  for (const char* key : {"controller", "tracking"}) {
    if (told.contains(key)) json[key] = told[key];
  }
  return json;
}

}  // namespace

std::string PhysicsText(const PhysicalOutcome& outcome) {
  const std::string lost = outcome.lost.empty() ? "" : "  no more commands: " + outcome.lost + "\n";
  if (outcome.replayed.result.rows.empty()) return lost;
  std::string text = ReplayText(outcome.replayed) + lost;
  text += std::string("  in the world: ") + (outcome.in_goal ? "stands" : "does not stand") +
          Formatted(" in the goal, which is %.1f mm from where it was measured last\n",
                    1e3 * outcome.goal_off);
  if (std::isfinite(outcome.no_step)) {
    text += Formatted("  soles that carry: no nearer than %.1f mm to a no-step area\n",
                      1e3 * outcome.no_step);
  }
  for (const Push& push : outcome.pushes) {
    text += Formatted("  pushed at %.2f s for %.2f s: x %.1f N s, y %.1f N s\n", push.at,
                      push.duration, push.impulse_W.x(), push.impulse_W.y());
  }
  for (const std::string& note : outcome.notes) text += "  " + note + "\n";
  return text + "\n" + kReplayDisclaimer + "\n";
}

std::string WithPhysics(const std::string& json, const PhysicalOutcome& outcome) {
  ordered_json object = ordered_json::parse(json);
  object["physics"] = RecordOf(outcome);
  object["physics"]["statement"] = kReplayDisclaimer;
  if (!outcome.notes.empty()) object["physics"]["notes"] = outcome.notes;
  object["physics"].update(ordered_json::parse(ReplayedJson(outcome.replayed)));
  return TextOf(object);
}

void WritePhysics(const PhysicalOutcome& outcome, const RobotModel& robot, const Scene& scene,
                  RunFolder* folder) {
  WriteCsv("physics", ReplayCsv(outcome.replayed.result.rows), folder);
  const std::filesystem::path path = folder->staging() / "manifest.json";
  ordered_json manifest = ordered_json::parse(ReadJsonText(path), nullptr,
                                              /*allow_exceptions=*/false);
  if (!manifest.is_object()) throw InputError({path.string() + ": is no JSON object"});
  manifest["physics"] = RecordOf(outcome);
  folder->Write("manifest.json", TextOf(manifest));
  CompleteManifest(robot, scene, folder);
}

}  // namespace halfstep::replay
