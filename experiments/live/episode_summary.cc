#include "experiments/live/episode_summary.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "experiments/live/promise_words.h"
#include "experiments/tables/not_covered_json.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

int CountOf(const Episode& episode, const std::string& what) {
  return static_cast<int>(std::ranges::count(episode.events, what, &EpisodeEvent::what));
}

std::string Counted(int count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string NearestLine(const Approach& nearest) {
  if (nearest.obstacle.empty()) return "nearest      no obstacle within 0.3 m while it moved\n";
  return Formatted("nearest      %.4f m, %s to %s at %.2f s (sampled every 5 ms)\n",
                   nearest.distance, nearest.body.c_str(), nearest.obstacle.c_str(), nearest.t);
}

}  // namespace

EpisodeSummary Summarize(const Episode& episode, const TrueWorld* truth, const RobotModel& robot) {
  EpisodeSummary summary;
  summary.ending = Name(episode.ending);
  summary.duration = episode.end;
  summary.half_steps = static_cast<int>(episode.begun.size());
  std::vector<const EpisodeEvent*> begins;
  for (const EpisodeEvent& event : episode.events) {
    if (event.what == "begins") begins.push_back(&event);
  }
  const bool is_commanded = CountOf(episode, "commanded") > 0;
  for (size_t k = 1; k < episode.walks.size(); ++k) {
    const ExecutedWalk& walk = episode.walks[k];
    if (walk.kind == ProposalKind::kShortened) ++summary.shortened;
    if (walk.kind == ProposalKind::kSmoothed) ++summary.smoothed;
    if (walk.kind == ProposalKind::kResumed) ++summary.resumed;
    const bool commanded = walk.kind == ProposalKind::kCommanded;
    if (walk.kind != ProposalKind::kChanged && !commanded) continue;
    ++summary.changed;
    // A walk that goes on at its end as it was commanded was prompted by no measurement.
    const int planned = episode.walks[k - 1].tail.size();
    if (is_commanded && walk.first_changed >= planned) continue;
    summary.latencies.push_back(walk.t - walk.measured);
    int begun = 0;
    for (const EpisodeEvent* event : begins) {
      begun += event->t > walk.measured && event->t <= walk.t &&
               event->half_step < walk.first_changed && event->walk <= static_cast<int>(k);
    }
    summary.begun_meanwhile.push_back(begun);
  }
  summary.refused = CountOf(episode, "refused");
  summary.contradicted = CountOf(episode, "contradicted");
  summary.stops = CountOf(episode, "stopped");
  summary.unsafe = CountOf(episode, "unsafe");
  summary.early = CountOf(episode, "early");
  summary.late = CountOf(episode, "late");
  summary.waited = episode.waited;
  if (truth != nullptr) {
    summary.nearest = NearestApproach(episode, *truth, robot, 0.005, 0.3);
  }
  return summary;
}

std::string SummaryScreen(const Episode& episode, const EpisodeSummary& summary,
                          const std::string& folder) {
  std::string text = summary.ending;
  if (!episode.message.empty()) text += ": " + episode.message;
  if (summary.waited > 0.0) text += Formatted(", waited %.2f s", summary.waited);
  text += Formatted(", %.2f s, ", summary.duration);
  text += Counted(summary.half_steps, "half-step", "half-steps");
  if (episode.promise.status() != PromiseStatus::kKept) {
    text += ", but " + PromiseSentence(episode.promise);
  }
  text += "\n";
  text += "handed over  " +
          Counted(summary.changed, "walk with other footsteps", "walks with other footsteps") +
          ", " + std::to_string(summary.shortened) + " with fewer footsteps, " +
          std::to_string(summary.smoothed) + " with other overlaps, " +
          std::to_string(summary.resumed) + " after a stop\n";
  text += "world        " + Counted(summary.contradicted, "contradiction", "contradictions") +
          ", " + Counted(summary.stops, "stop", "stops") + ", " + std::to_string(summary.refused) +
          " refused, " + std::to_string(summary.unsafe) + " times no safe way\n";
  if (summary.early + summary.late > 0) {
    text += "contact      " + std::to_string(summary.early) + " early, " +
            std::to_string(summary.late) + " late\n";
  }
  if (!summary.latencies.empty()) {
    std::vector<double> sorted = summary.latencies;
    std::ranges::sort(sorted);
    text += Formatted("latency      median %.3f s, largest %.3f s from measurement to hand-over\n",
                      sorted[sorted.size() / 2], sorted.back());
  }
  if (episode.latest_tick > 0.0) {
    text += Formatted("wall clock   ticks at most %.1f ms late\n", 1e3 * episode.latest_tick);
  }
  if (summary.nearest) text += NearestLine(*summary.nearest);
  text += PromiseText(episode.promise);
  text += NotCoveredText(summary.not_covered, "not_covered in manifest.json");
  return text + "written to   " + folder + "\n";
}

std::string SummaryJson(const Episode& episode, const EpisodeSummary& summary,
                        const std::string& folder) {
  nlohmann::ordered_json json = {{"ending", summary.ending},
                                 {"message", episode.message},
                                 {"waited_s", summary.waited},
                                 {"duration_s", summary.duration},
                                 {"half_steps", summary.half_steps},
                                 {"changed", summary.changed},
                                 {"shortened", summary.shortened},
                                 {"smoothed", summary.smoothed},
                                 {"resumed", summary.resumed},
                                 {"refused", summary.refused},
                                 {"contradicted", summary.contradicted},
                                 {"stops", summary.stops},
                                 {"unsafe", summary.unsafe},
                                 {"early", summary.early},
                                 {"late", summary.late},
                                 {"latencies_s", summary.latencies},
                                 {"begun_meanwhile", summary.begun_meanwhile}};
  if (const std::optional<Approach>& nearest = summary.nearest) {
    json["nearest_m"] = nearest->distance;
    json["nearest_obstacle"] = nearest->obstacle;
    json["nearest_t_s"] = nearest->t;
  }
  json["promise"] = PromiseJson(episode.promise);
  json["not_covered"] = NotCoveredJson(summary.not_covered);
  if (!folder.empty()) json["folder"] = folder;
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace halfstep
