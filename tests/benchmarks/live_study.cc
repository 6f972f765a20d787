// Episodes drawn at random: one row an episode, then what the bench asks, then a histogram.
//   live_study [FIRST [COUNT [POLICY [THREADS [MINUTES]]]]]
//   live_study events SEED [POLICY]
//   live_study tables SEED [COUNT [POLICY]]
// Default: seeds 1 … 100, policy replan, one thread; no episode begins after so many minutes. The
// policy `wall` is replan by the wall clock, `counted` replan in lockstep that charges what was
// counted, 1 s a unit of effort. `events` prints what happened in one episode; `tables` walks
// episodes and does nothing else, and prints the hash of each one's tables, and what answers cost:
// a change that only makes replanning cheaper leaves the hashes as they are (callgrind counts what
// it saves). HRP-2's swept volumes from the user's cache, baked when they are not there.

#include <cstdio>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "tests/benchmarks/live_table.h"
#include "tests/benchmarks/studied_episode.h"
#include "tests/places.h"

namespace {

using namespace halfstep;

LiveStudy MakeStudy(const std::string& policy) {
  LiveStudy study;
  study.base = LoadLiveConfig(InSources("experiments/episodes/live_bar.yaml"), {});
  study.base.live.policy = policy == "wall" || policy == "counted" ? "replan" : policy;
  if (policy == "wall") study.base.live.clock = "wall";
  if (policy == "counted") study.base.live.budget.effort = 1.0;
  study.base.live.longest = 90.0;
  study.place = LoadPlace(study.base.experiment);
  study.baked = BakeHalfSteps(study.place.robot, study.base.experiment, {});
  study.start = StartOf(study.base.experiment, study.place.robot, *study.place.scene.ground);
  return study;
}

// Walks the episodes in threads and prints their rows in the order of the seeds.
std::vector<StudiedEpisode> Walk(const LiveStudy& study, std::uint64_t first, std::uint64_t count,
                                 int threads, double minutes) {
  std::mutex mutex;
  std::uint64_t next = first;
  std::map<std::uint64_t, StudiedEpisode> done;
  std::vector<StudiedEpisode> printed;
  const double begin = SteadySeconds();
  const auto work = [&] {
    while (true) {
      std::uint64_t seed = 0;
      {
        const std::lock_guard lock(mutex);
        if (next == first + count || SteadySeconds() > begin + 60.0 * minutes) return;
        seed = next++;
      }
      StudiedEpisode episode = WalkEpisode(study, seed);
      const std::lock_guard lock(mutex);
      done.emplace(seed, std::move(episode));
      for (auto it = done.begin(); it != done.end() && it->first == first + printed.size();
           it = done.erase(it)) {
        PrintRow(it->second);
        printed.push_back(std::move(it->second));
      }
    }
  };
  std::vector<std::jthread> workers;
  for (int i = 0; i < threads; ++i) workers.emplace_back(work);
  workers.clear();  // joins
  return printed;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const auto argument = [&](size_t i, const std::string& otherwise) {
    return i < arguments.size() ? arguments[i] : otherwise;
  };
  if (argument(0, "") == "events") {
    for (const EpisodeEvent& event :
         WalkEpisode(MakeStudy(argument(2, "replan")), std::stoull(argument(1, "1"))).events) {
      if (event.what == "measured") continue;
      std::printf("%.3f %s world %d walk %d half-step %d %s\n", event.t, event.what.c_str(),
                  event.version, event.walk, event.half_step + 1, event.text.c_str());
    }
    return 0;
  }
  if (argument(0, "") == "tables") {
    const LiveStudy tabled = MakeStudy(argument(3, "replan"));
    const std::uint64_t first = std::stoull(argument(1, "1"));
    std::vector<Answered> answers;
    for (std::uint64_t seed = first; seed < first + std::stoull(argument(2, "1")); ++seed) {
      const WalkedEpisode walked = WalkOnly(tabled, seed);
      std::printf("%llu %s %zu walks %s\n", static_cast<unsigned long long>(seed),
                  std::string(Name(walked.episode.ending)).c_str(), walked.episode.walks.size(),
                  walked.tables.c_str());
      std::fflush(stdout);
      answers.insert(answers.end(), walked.answers.begin(), walked.answers.end());
    }
    PrintSpent(answers);
    return 0;
  }
  const LiveStudy study = MakeStudy(argument(2, "replan"));
  PrintHeader();
  const std::vector<StudiedEpisode> episodes =
      Walk(study, std::stoull(argument(0, "1")), std::stoull(argument(1, "100")),
           std::stoi(argument(3, "1")), std::stod(argument(4, "1e9")));
  std::printf("\n");
  PrintTable(episodes);
  std::printf("\n");
  std::vector<Answered> answers;
  for (const StudiedEpisode& episode : episodes) {
    answers.insert(answers.end(), episode.answers.begin(), episode.answers.end());
  }
  PrintSpent(answers);
  std::printf("\n");
  PrintHistogram(episodes);
  for (const StudiedEpisode& episode : episodes) {
    if (episode.touched() && !episode.excused) return 1;
  }
  return 0;
}
