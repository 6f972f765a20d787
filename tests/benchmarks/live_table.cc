#include "tests/benchmarks/live_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>

#include "wpg/files/text.h"

namespace halfstep {
namespace {

using Episodes = std::vector<StudiedEpisode>;

long CountOf(const Episodes& episodes, const std::function<bool(const StudiedEpisode&)>& which) {
  return std::ranges::count_if(episodes, which);
}

// The value that a part of all values is below; NaN when there is none.
double At(std::vector<double> values, double part) {
  if (values.empty()) return std::nan("");
  std::ranges::sort(values);
  const auto index = static_cast<size_t>(part * static_cast<double>(values.size()));
  return values[std::min(values.size() - 1, index)];
}

std::vector<double> Latencies(const Episodes& episodes, double Latency::*part) {
  std::vector<double> values;
  for (const StudiedEpisode& episode : episodes) {
    for (const Latency& latency : episode.latencies) values.push_back(latency.*part);
  }
  return values;
}

void Line(const std::string& measured, const std::string& value, const std::string& goal) {
  std::printf("| %s | %s | %s |\n", measured.c_str(), value.c_str(), goal.c_str());
}

std::string Milliseconds(const std::vector<double>& seconds) {
  return Formatted("%.0f ms, %.0f ms, of %zu", 1e3 * At(seconds, 0.5), 1e3 * At(seconds, 0.99),
                   seconds.size());
}

void PrintArrivals(const Episodes& episodes) {
  const auto arrived = [](const StudiedEpisode& e) { return e.reachable && e.arrived(); };
  const auto fair = [](const StudiedEpisode& e) { return e.reachable && e.rests && !e.pressed; };
  Line("walk ends in the goal when one can be reached",
       Formatted("%ld of %ld", CountOf(episodes, arrived),
                 CountOf(episodes, [](const StudiedEpisode& e) { return e.reachable; })),
       "≥ 99 %");
  Line("the same where what stays is taken to rest and nothing was put against the robot",
       Formatted("%ld of %ld",
                 CountOf(episodes, [&](const StudiedEpisode& e) { return fair(e) && e.arrived(); }),
                 CountOf(episodes, fair)),
       "");
  std::vector<double> longer;
  for (const StudiedEpisode& e : episodes) {
    if (e.arrived() && e.clairvoyant > 0.0) longer.push_back(e.duration / e.clairvoyant - 1.0);
  }
  Line("longer than the clairvoyant walk, median, 90 %",
       Formatted("%.1f %%, %.1f %%", 100.0 * At(longer, 0.5), 100.0 * At(longer, 0.9)),
       "median below 15 %");
}

}  // namespace

void PrintHeader() {
  std::printf(
      "seed,ending,reachable,rests,waited_s,duration_s,clairvoyant_s,changed,stopped,unsafe,"
      "nearest_m,nearest,excused,pressed,stops,safe_stops,cpu_s\n");
}

void PrintRow(const StudiedEpisode& e) {
  std::printf("%llu,%s,%d,%d,%.2f,%.2f,%.2f,%d,%d,%d,%.4f,%s,%d,%d,%d,%d,%.2f\n",
              static_cast<unsigned long long>(e.seed), std::string(Name(e.ending)).c_str(),
              e.reachable, e.rests, e.waited, e.duration, e.clairvoyant, e.changed, e.stopped,
              e.unsafe, e.nearest, e.nearest_obstacle.c_str(), e.excused, e.pressed, e.stops,
              e.safe_stops, e.cpu);
  std::fflush(stdout);
}

void PrintTable(const Episodes& episodes) {
  long changes = 0, quick = 0, stops = 0, safe = 0;
  double longest = 0.0, jump = 0.0, residual = 0.0, cpu = 0.0, walked = 0.0;
  for (const StudiedEpisode& e : episodes) {
    changes += std::ssize(e.begun_meanwhile);
    quick += std::ranges::count_if(e.begun_meanwhile, [](int begun) { return begun <= 1; });
    stops += e.stops;
    safe += e.safe_stops;
    longest = std::max(longest, e.longest_stop);
    jump = std::max(jump, e.jump);
    residual = std::max(residual, e.residual);
    cpu += e.cpu;
    walked += e.duration;
  }
  std::printf("| measured | %zu episodes | goal |\n|---|---|---|\n", episodes.size());
  Line("touched an obstacle that kept to r and v",
       std::to_string(CountOf(episodes, [](const auto& e) { return e.touched() && !e.excused; })),
       "0");
  Line("touched one that had just broken its bounds",
       std::to_string(CountOf(episodes, [](const auto& e) { return e.excused; })), "");
  Line("from the measurement to the hand-over of a safe walk, median, p99",
       Milliseconds(Latencies(episodes, &Latency::whole)), "20 ms, 100 ms");
  Line("of that the answer, from when work began, median, p99",
       Milliseconds(Latencies(episodes, &Latency::answer)), "20 ms, 100 ms");
  Line("the same with the searches before that found nothing",
       Milliseconds(Latencies(episodes, &Latency::since_unsafe)), "");
  Line("at most one half-step begun between measurement and the first changed one",
       Formatted("%ld of %ld", quick, changes), "95 %");
  PrintArrivals(episodes);
  Line("largest jump of C² over all hand-overs", Formatted("%.2g", jump), "1e-9");
  Line("LIPM residual", Formatted("%.2g m", residual), "1e-9");
  Line("stops at random times that come to rest, proved", Formatted("%ld of %ld", safe, stops),
       "all");
  Line("from such a time to the rest, at most", Formatted("%.2f s", longest), "a half-step");
  Line("an obstacle was put against the robot",
       std::to_string(CountOf(episodes, [](const auto& e) { return e.pressed; })), "");
  Line("computing for each second of walk", Formatted("%.2f s", cpu / walked), "");
}

void PrintSpent(const std::vector<Answered>& answers) {
  std::printf(
      "| part of an answer | answers | counted, median, p99 [ms] | processor, median, p99 [ms] | "
      "processor for each unit counted |\n|---|---|---|---|---|\n");
  const auto line = [&](const char* part, ProposalKind kind,
                        const std::function<double(const Spent&)>& of, bool prepared = false) {
    std::vector<double> counted, taken;
    double all_counted = 0.0, all_taken = 0.0;
    for (const Answered& answer : answers) {
      if (answer.kind != kind) continue;
      counted.push_back(of(answer.effort));
      taken.push_back(prepared ? answer.asking : of(answer.seconds));
      all_counted += counted.back();
      all_taken += taken.back();
    }
    std::printf("| %s | %zu | %.1f, %.1f | %.1f, %.1f | %.2f |\n", part, counted.size(),
                1e3 * At(counted, 0.5), 1e3 * At(counted, 0.99), 1e3 * At(taken, 0.5),
                1e3 * At(taken, 0.99), all_taken / all_counted);
  };
  const auto all = [](const Spent& spent) { return spent.all(); };
  line("other footsteps: check", ProposalKind::kChanged, [](const Spent& s) { return s.check; });
  line("other footsteps: plan", ProposalKind::kChanged, [](const Spent& s) { return s.plan; });
  line("other footsteps, all of it", ProposalKind::kChanged, all);
  line("the same with preparing its world", ProposalKind::kChanged, all, true);
  line("other overlaps: check", ProposalKind::kSmoothed, [](const Spent& s) { return s.check; });
  line("other overlaps: smooth", ProposalKind::kSmoothed, [](const Spent& s) { return s.smooth; });
  line("searches in vain", ProposalKind::kUnsafe, all);
}

void PrintHistogram(const Episodes& episodes) {
  const std::vector<double> bounds = {0.001, 0.002, 0.005, 0.01, 0.02, 0.05,    0.1,
                                      0.2,   0.5,   1.0,   2.0,  5.0,  INFINITY};
  const auto print = [&](const char* part, const std::vector<double>& values) {
    double above = -INFINITY;
    for (const double bound : bounds) {
      const long count = std::ranges::count_if(
          values, [&](double value) { return value > above && value <= bound; });
      std::printf("%s,%g,%ld\n", part, bound, count);
      above = bound;
    }
  };
  std::printf("part,up_to_s,count\n");
  print("whole", Latencies(episodes, &Latency::whole));
  print("since_unsafe", Latencies(episodes, &Latency::since_unsafe));
  print("age", Latencies(episodes, &Latency::age));
  print("answer", Latencies(episodes, &Latency::answer));
  print("check", Latencies(episodes, &Latency::check));
  print("plan", Latencies(episodes, &Latency::plan));
  std::vector<double> smoothing;
  for (const StudiedEpisode& episode : episodes) {
    smoothing.insert(smoothing.end(), episode.smoothing.begin(), episode.smoothing.end());
  }
  print("smooth", smoothing);
}

}  // namespace halfstep
