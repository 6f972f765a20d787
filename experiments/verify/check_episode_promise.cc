#include "experiments/verify/check_episode_promise.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "experiments/verify/derived_touches.h"
#include "experiments/verify/json_text.h"

namespace halfstep::verify {
namespace {

constexpr double kPromised = 1e-6;  // of numbers that are computed twice

// The same to rounding; both may be infinite.
bool SameSaid(double a, double b) {
  return a == b || std::abs(a - b) <= kPromised * std::max(1.0, std::abs(b));
}
bool SameSaid(const std::optional<double>& a, const std::optional<double>& b) {
  return a.has_value() == b.has_value() && (!a || SameSaid(*a, *b));
}

std::string JudgedBy(const EpisodePromise& promise, const LiveOptions& options) {
  if (options.sensing.source == "client" || promise.killed) return "measurements";
  return promise.in_physics ? "simulation" : "script";
}

// Compares what is said of one obstacle with what is derived. `at_least`: more may be said.
class Comparison {
 public:
  Comparison(const BrokenText& said, const BrokenText& is, bool at_least, Findings* findings)
      : said_(said), is_(is), at_least_(at_least), findings_(*findings) {}

  void Compare() {
    Number("from_s", said_.from, is_.from, !at_least_ || said_.from > is_.from);
    Number("beyond_m", said_.beyond, is_.beyond, !at_least_ || said_.beyond < is_.beyond);
    Number("speed_m_s", said_.speed, is_.speed, !at_least_ || said_.speed < is_.speed);
    Number("error_m", said_.error, is_.error, !at_least_ || said_.error < is_.error);
    Text("was_there", said_.was_there == is_.was_there || (at_least_ && !said_.was_there));
    Text("rested", said_.rested == is_.rested || (at_least_ && said_.rested));
    Text("measured_s", SameSaid(said_.measured, is_.measured));
    Text("known_s", SameSaid(said_.known, is_.known));
    Text("frames", said_.frames == is_.frames);
    if (!at_least_) Text("covered_by", said_.covered_by == is_.covered_by);
    Text("unproved_s", SameWindows());
  }

 private:
  void Number(const char* key, double said, double is, bool matters) {
    if (!matters || SameSaid(said, is)) return;
    findings_.Disagree("manifest.json: promise: " + Quote(is_.name) +
                       Formatted(": %s is %.9g, but it was %.9g", key, said, is));
  }
  void Text(const char* key, bool same) {
    if (same) return;
    findings_.Disagree("manifest.json: promise: " + Quote(is_.name) + ": " + key +
                       " is not what measurements, grants and script say");
  }
  // Where more may be said, each derived one is within one that is said.
  bool SameWindows() const {
    if (!at_least_) {
      return std::ranges::equal(said_.unproved, is_.unproved, [](const auto& a, const auto& b) {
        return SameSaid(a.first, b.first) && SameSaid(a.second, b.second);
      });
    }
    return std::ranges::all_of(is_.unproved, [&](const auto& is) {
      return std::ranges::any_of(said_.unproved, [&](const auto& said) {
        return said.first <= is.first + kPromised && is.second <= said.second + kPromised;
      });
    });
  }

  const BrokenText &said_, &is_;
  bool at_least_;
  Findings& findings_;
};

void CompareBroken(const PromiseText& said, const PromiseText& is, bool at_least,
                   Findings* findings) {
  std::set<std::string> names;
  for (const BrokenText& one : said.broken) {
    if (!names.insert(one.name).second) {
      findings->Disagree("manifest.json: promise: " + Quote(one.name) + " is there twice");
    }
  }
  for (const BrokenText& one : is.broken) {
    const auto same = std::ranges::find(said.broken, one.name, &BrokenText::name);
    if (same != said.broken.end()) {
      Comparison(*same, one, at_least, findings).Compare();
      continue;
    }
    findings->Disagree("manifest.json: promise: it says nothing of " + Quote(one.name) +
                       Formatted(", which did not keep r and v from %.3f s on", one.from));
  }
  for (const BrokenText& one : said.broken) {
    const bool known = std::ranges::find(is.broken, one.name, &BrokenText::name) != is.broken.end();
    if (known || at_least) continue;
    findings->Disagree("manifest.json: promise: " + Quote(one.name) + " kept r and v");
  }
}

void CompareTouched(const PromiseText& said, const PromiseText& is, Findings* findings) {
  for (const TouchText& one : is.touched) {
    const auto same = std::ranges::find(said.touched, one.obstacle, &TouchText::obstacle);
    if (same == said.touched.end()) {
      findings->Disagree("manifest.json: promise: it does not say that the robot touches " +
                         Quote(one.obstacle) + Formatted(", from %.3f s on", one.from));
    } else if (!(std::abs(same->from - one.from) <= 1.5 * kLook)) {
      findings->Disagree("manifest.json: promise: " + Quote(one.obstacle) +
                         Formatted(" is touched from %.3f s on, not %.3f s", one.from, same->from));
    }
  }
  for (const TouchText& one : said.touched) {
    const bool is_so =
        std::ranges::find(is.touched, one.obstacle, &TouchText::obstacle) != is.touched.end();
    if (is_so) continue;
    findings->Disagree("manifest.json: promise: the robot does not touch " + Quote(one.obstacle));
  }
}

// Whether events.csv has what each frame contradicted.
void CheckContradictedEvents(const PromiseRecord& record, Findings* findings) {
  if (record.executed == nullptr) return;
  for (size_t world = 0; world < record.episode.worlds.size(); ++world) {
    // Nothing is told while the robot waits for its first walk.
    if (!(record.episode.worlds[world].known > 0)) continue;
    const long is = Contradictions(record, world);
    const long said = std::ranges::count_if(record.episode.events, [&](const EventRow& event) {
      return event.what == "contradicted" && event.world == static_cast<int>(world);
    });
    if (is == said) continue;
    findings->Disagree(Formatted("events.csv: %ld rows `contradicted` of world %zu instead of %ld",
                                 said, world, is));
  }
}

std::string Sentence(const PromiseText& promise) {
  std::string text;
  for (const BrokenText& one : promise.broken) {
    text += (text.empty() ? "" : ", ") + Quote(one.name) + Formatted(" (from %.3f s on)", one.from);
  }
  text = text.empty()
             ? "the promise held"
             : "not where its error and speed allow, on which the promise rests, was " + text;
  for (size_t i = 0; i < promise.touched.size(); ++i) {
    text += (i == 0 ? "; the robot touched " : ", ") + Quote(promise.touched[i].obstacle);
  }
  return text;
}

}  // namespace

EpisodePromise ReadEpisodePromise(const std::string& path, const std::string& manifest_text,
                                  const EpisodeManifest& manifest) {
  return {.said = ReadPromise(path, manifest_text),
          .in_physics = ParseJson(path, manifest_text).contains("physics"),
          .has_physics_file = manifest.files.contains("physics.csv"),
          .killed = manifest.ending == "killed",
          .waited = manifest.waited};
}

void CheckEpisodePromise(const EpisodePromise& promise, const PromiseRecord& record,
                         Findings* findings) {
  if (promise.in_physics && !promise.has_physics_file) {
    findings->Disagree("manifest.json: physics: there is no physics.csv");
  }
  const std::string judged_by = JudgedBy(promise, record.options);
  if (promise.said.judged_by != judged_by) {
    findings->Disagree("manifest.json: promise: judged_by is not " + judged_by);
  }
  const bool by_script = judged_by == "script", in_physics = judged_by == "simulation";
  const EpisodeTruth truth(record.scene, record.options, promise.waited);
  const PromiseText is = DerivePromise(record, by_script ? &truth : nullptr);
  CompareBroken(promise.said, is, in_physics, findings);
  if (!in_physics) CompareTouched(promise.said, is, findings);
  CheckContradictedEvents(record, findings);
  const PromiseText& told = in_physics ? promise.said : is;
  const std::string status = !told.touched.empty() ? "touched"
                             : told.broken.empty() ? "kept"
                                                   : "not_kept";
  if (promise.said.status != status) {
    findings->Disagree("manifest.json: promise: status: is " + Quote(promise.said.status) +
                       ", but it is " + status);
  }
  const std::string sentence = Sentence(told);
  findings->Say("promise: " + sentence +
                (by_script    ? " (by measurements and script, each 5 ms)"
                 : in_physics ? " (by measurements; what was true in physics is not examined)"
                              : " (by measurements; what was true is not known)"));
  if (status != "kept") findings->Remark(sentence);
}

}  // namespace halfstep::verify
