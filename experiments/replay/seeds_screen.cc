#include "experiments/replay/seeds_screen.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>

#include "experiments/replay/replay_screen.h"
#include "experiments/tables/csv_writer.h"
#include "wpg/elementary.h"
#include "wpg/files/text.h"

namespace halfstep::replay {
namespace {

using nlohmann::ordered_json;

constexpr double kOneDegree = std::numbers::pi / 180;

// A number of each result: its key, and how the screen tells it.
struct Told {
  const char* key;
  double ReplayResult::*number;
  const char* name;
  const char* unit;
  double in_unit;  // one of that unit
  int digits;
};
constexpr Told kTold[] = {
    {"largest_tilt_rad", &ReplayResult::largest_tilt, "tilt", "deg", kOneDegree, 1},
    {"edge_share", &ReplayResult::edge_share, "at the edge of the soles", "%", 0.01, 0},
    {"peak_weights", &ReplayResult::peak, "peak force", "weights", 1.0, 2},
    {"flight_s", &ReplayResult::flight, "flight", "s", 1.0, 3},
    {"slip_m", &ReplayResult::slip, "slip", "mm", 1e-3, 1},
    {"sole_turn_rad", &ReplayResult::turn, "turn of soles", "deg", kOneDegree, 2},
};

double DirectionOf(const Push& push) { return Atan2(push.impulse_W.y(), push.impulse_W.x()); }

ordered_json JsonOf(const SeedReplay& one) {
  const auto& [seed, unstable, drawn, result] = one;
  ordered_json json = {{"seed", seed},
                       {"friction", drawn.friction},
                       {"contact_s", drawn.contact_time},
                       {"stiffness_share", drawn.stiffness_share},
                       {"com_x_m", drawn.com_shift.x()},
                       {"com_y_m", drawn.com_shift.y()},
                       {"push_s", drawn.push.at},
                       {"push_n_s", drawn.push.impulse_W.norm()},
                       {"push_yaw_rad", DirectionOf(drawn.push)},
                       {"stayed_up", result.stayed_up},
                       {"ended_s", result.ended}};
  for (const Told& told : kTold) json[told.key] = result.*told.number;
  json["touches"] = result.touches.size();
  if (!unstable.empty()) json["unstable"] = unstable;
  return json;
}

ordered_json JsonOf(const SeedsPlayed& played) {
  ordered_json json = {{"method", played.method},
                       {"duration_s", played.duration},
                       {"stands", Standing(played.seeds)},
                       {"of", played.seeds.size()}};
  for (const Told& told : kTold) {
    json["median"][told.key] = MedianOf(played.seeds, told.number);
    json["largest"][told.key] = LargestOf(played.seeds, told.number);
  }
  if (played.tube) json["suggested_tube"] = SuggestedTubeJson(*played.tube);
  for (const SeedReplay& one : played.seeds) json["seeds"].push_back(JsonOf(one));
  return json;
}

}  // namespace

std::string SeedsText(const SeedsPlayed& played) {
  std::string text =
      played.method + Formatted(": stands in %d of %zu, walk of %.3f s; medians (largest): ",
                                Standing(played.seeds), played.seeds.size(), played.duration);
  for (const Told& told : kTold) {
    const double median = MedianOf(played.seeds, told.number) / told.in_unit;
    const double largest = LargestOf(played.seeds, told.number) / told.in_unit;
    text += (&told == kTold ? "" : ", ") + Formatted("%s %.*f (%.*f) %s", told.name, told.digits,
                                                     median, told.digits, largest, told.unit);
  }
  text += '\n';
  const auto touched = std::ranges::count_if(
      played.seeds, [](const SeedReplay& one) { return !one.result.touches.empty(); });
  if (played.obstacles) {
    text += Formatted("  touches an obstacle in %td of %zu\n", touched, played.seeds.size());
  }
  for (const SeedReplay& one : played.seeds) {
    if (one.result.stayed_up) continue;
    text += Formatted("  seed %d: ", one.seed) +
            (one.unstable.empty() ? Formatted("FALLS at %.2f s\n", one.result.ended)
                                  : one.unstable + ", which counts as a fall\n");
  }
  if (played.tube) text += SuggestedTubeText(played.method, *played.tube);
  return text;
}

std::vector<const ReplayResult*> ResultsOf(const std::vector<SeedReplay>& seeds) {
  std::vector<const ReplayResult*> results;
  for (const SeedReplay& one : seeds) results.push_back(&one.result);
  return results;
}

std::string SeedsPlayedJson(const SeedsPlayed& played) { return JsonOf(played).dump(2); }

std::string SeedsJson(const std::string& run, const std::vector<std::string>& notes,
                      const std::vector<SeedsPlayed>& all) {
  ordered_json json = {
      {"run", run}, {"engine", "mujoco " + EngineVersion()}, {"statement", kReplayDisclaimer}};
  if (!notes.empty()) json["notes"] = notes;
  for (const SeedsPlayed& played : all) json["methods"].push_back(JsonOf(played));
  return json.dump(2) + "\n";
}

CsvFile SeedsCsv(const std::vector<SeedReplay>& seeds) {
  using enum CsvType;
  CsvWriter csv({
      {"seed", kInteger, "", "from 1; what it draws is the same for every number of seeds"},
      {"friction", kNumber, "1", "drawn: of the soles on the floor"},
      {"contact_s", kNumber, "s", "drawn: time constant of the contacts"},
      {"stiffness_share", kNumber, "1", "drawn: of the servos' stiffness"},
      {"com_x_m", kNumber, "m", "drawn: shift of the CoM of all above the legs, x", "B"},
      {"com_y_m", kNumber, "m", "drawn: the same, y", "B"},
      {"push_s", kNumber, "s", "drawn: when the waist is pushed"},
      {"push_n_s", kNumber, "N s", "impulse of that push"},
      {"push_yaw_rad", kNumber, "rad", "drawn: its direction", "W"},
      {"stayed_up", kBoolean, "", "whether the robot stood to the end"},
      {"ended_s", kNumber, "s", "when it had fallen, else the end"},
      {"largest_tilt_rad", kNumber, "rad", "of the waist from upright", "W"},
      {"edge_share", kNumber, "1",
       "of the walk's time: the pressure point is at the edge of the soles that carry"},
      {"peak_weights", kNumber, "1", "largest vertical force of 5 ms, in weights"},
      {"flight_s", kNumber, "s", "time in which no sole carries"},
      {"slip_m", kNumber, "m", "of a carrying sole since it took up load"},
      {"sole_turn_rad", kNumber, "rad", "the same of its yaw"},
      {"touches", kInteger, "", "of bodies with obstacles"},
  });
  for (const SeedReplay& one : seeds) {
    const Disturbance& drawn = one.drawn;
    csv.Cell(one.seed).Cell(drawn.friction).Cell(drawn.contact_time).Cell(drawn.stiffness_share);
    csv.Cell(drawn.com_shift.x()).Cell(drawn.com_shift.y()).Cell(drawn.push.at);
    csv.Cell(drawn.push.impulse_W.norm()).Cell(DirectionOf(drawn.push));
    csv.Cell(one.result.stayed_up).Cell(one.result.ended);
    for (const Told& told : kTold) csv.Cell(one.result.*told.number);
    csv.Cell(static_cast<long>(one.result.touches.size())).EndRow();
  }
  return csv.file();
}

}  // namespace halfstep::replay
