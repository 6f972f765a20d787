#include "experiments/live/episode_report.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "experiments/live/messages.h"
#include "experiments/live/promise_words.h"
#include "experiments/report/live_page.h"
#include "experiments/report/report_page.h"
#include "experiments/report/report_walk.h"
#include "experiments/tables/result_tables.h"
#include "wpg/files/number_text.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr size_t kMostBytes = 5'000'000;
constexpr double kSpacing = 0.02;  // of the motion's rows [s]
constexpr int kDigits = 7;

// Numbers as short as a picture needs them.
json Rounded(json value) {
  if (value.is_number_float()) return Shortened(value.get<double>(), kDigits);
  if (value.is_structured()) {
    for (json& part : value) part = Rounded(std::move(part));
  }
  return value;
}

// About how far apart rows of the motion are that are shown [s].
double SpacingOf(size_t k, const LiveConfig& config) {
  const double period = config.experiment.output_period.value_or(kRowPeriod);
  return std::max(kSpacing * static_cast<double>(k), period);
}

// At what k the page may be short enough at the earliest: each number of the motion takes two
// bytes.
size_t LeastThinning(const Episode& episode, const LiveConfig& config, size_t columns) {
  if (episode.walks.empty()) return 1;
  const double period = config.experiment.output_period.value_or(kRowPeriod);
  const double end = std::min(episode.end, episode.Executed().duration());
  size_t k = 1;
  const auto least_bytes = [&] {
    return 2.0 * static_cast<double>(columns) * end / (SpacingOf(k, config) + period);
  };
  while (least_bytes() > static_cast<double>(kMostBytes)) k *= 2;
  return k;
}

// Whether element i of a list of `count` is among every k-th, the last one included.
bool IsShown(size_t i, size_t count, size_t k) { return i % k == 0 || i + 1 == count; }

// Of walks `same` footsteps are left out that are as in the one shown before, and times of
// half-steps, which the page does not need.
void AddWalks(const Episode& episode, bool lockstep, size_t k, json* messages) {
  json all = json::array();  // footsteps of the walk
  size_t same = 0;
  for (size_t i = 0; i < episode.walks.size(); ++i) {
    json message = WalkMessage(episode.walks[i], i);
    message.erase("half_steps");
    const auto kept = message["same"].get<size_t>();
    same = std::min(same, kept);
    all.erase(all.begin() + static_cast<json::difference_type>(kept), all.end());
    for (json& footstep : message["footsteps"]) all.push_back(std::move(footstep));
    if (!IsShown(i, episode.walks.size(), k)) continue;
    // What computing took is another time whenever the episode is run.
    if (lockstep) {
      for (const char* key : {"check_s", "plan_s", "smooth_s"}) message.erase(key);
    }
    message["same"] = same;
    message["footsteps"] =
        json(std::vector<json>(all.begin() + static_cast<json::difference_type>(same), all.end()));
    messages->push_back(Rounded(std::move(message)));
    same = all.size();
  }
}

// Of hand-overs of walks that are not shown only the first after another event is told, so that the
// page finds what was last before the robot stopped.
void AddEvents(const Episode& episode, size_t k, json* messages) {
  bool in_a_row = false;
  for (const EpisodeEvent& event : episode.events) {
    if (event.what == "measured" || event.what == "begins") continue;  // worlds and rows say it
    const bool hands_over = event.what == "handed_over";
    if (hands_over && in_a_row &&
        !IsShown(static_cast<size_t>(event.walk), episode.walks.size(), k)) {
      continue;
    }
    in_a_row = hands_over;
    messages->push_back(Rounded(EventMessage(event)));
  }
}

json Messages(const Episode& episode, const LiveConfig& config, const Place& place, size_t k) {
  json messages = json::array(
      {HelloMessage(config, place.robot, place.scene, {}), DrawMessage(place.robot, place.scene)});
  for (size_t i = 0; i < episode.worlds.size(); ++i) {
    if (!IsShown(i, episode.worlds.size(), k)) continue;
    messages.push_back(Rounded(WorldMessage(episode.worlds[i], episode.known[i])));
  }
  AddWalks(episode, config.live.clock == "lockstep", k, &messages);
  for (size_t i = 0; i < episode.grants.size(); ++i) {
    if (!IsShown(i, episode.grants.size(), k)) continue;
    messages.push_back(Rounded(GrantMessage(episode.grants[i], i)));
  }
  AddEvents(episode, k, &messages);
  messages.push_back(EndMessage(episode, ""));
  return messages;
}

std::string OutcomeOf(const Episode& episode, const LiveConfig& config, size_t k) {
  std::string outcome = std::string(Name(episode.ending)) +
                        Formatted(" after %.2f s, ", episode.end) + config.live.clock +
                        ", policy " + config.live.policy + "; " + PromiseSentence(episode.promise);
  if (k > 1) {
    outcome +=
        Formatted("; of worlds, walks and grants one in %zu is shown, the motion every %.3g s", k,
                  SpacingOf(k, config));
  }
  return outcome;
}

}  // namespace

std::string EpisodeReport(const Episode& episode, const LiveConfig& config, const Place& place,
                          const fs::path& folder) {
  std::vector<std::string> columns;
  for (const CsvColumn& column : MotionColumns(place.robot)) {
    const bool derivative = column.name.starts_with("com_v") || column.name.starts_with("com_a");
    if (!derivative && column.name != "support") columns.push_back(column.name);
  }
  for (size_t k = LeastThinning(episode, config, columns.size());; k *= 2) {
    const json motion = episode.walks.empty() ? json(nullptr)
                                              : MotionJson(folder / "trajectory.csv", columns,
                                                           kSpacing * static_cast<double>(k));
    std::string page = RecordingPage({{"messages", Messages(episode, config, place, k)},
                                      {"motion", motion},
                                      {"clock", config.live.clock},
                                      {"outcome", OutcomeOf(episode, config, k)}});
    if (page.size() < kMostBytes || k > episode.worlds.size() + episode.walks.size()) return page;
  }
}

void WriteEpisodeReport(const Episode& episode, const LiveConfig& config, const Place& place,
                        RunFolder* folder) {
  if (!HasReport()) return;
  folder->Write("report.html", EpisodeReport(episode, config, place, folder->staging()));
}

}  // namespace halfstep
