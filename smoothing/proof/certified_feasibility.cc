#include "smoothing/proof/certified_feasibility.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "wpg/check.h"
#include "wpg/files/plain_locale.h"
#include "wpg/nth.h"
#include "wpg/workers.h"

namespace halfstep {
namespace {

// The statement an open interval is undecided for, to name it.
Margin OpenStatement(const OpenGroup& group, double t, const MarginEvaluator& evaluator,
                     const SuperposedWalk& walk) {
  Margin margin = evaluator.statements(group.family).OfGroup(group.group);
  margin.t = t;
  margin.at = walk.Locate(margin.t);
  return margin;
}

}  // namespace

std::vector<double> KnotsInside(const SuperposedWalk& walk, const TimeSpan& span) {
  std::vector<double> knots;
  for (int i = 0; i < walk.num_half_steps(); ++i) {
    const double t = walk.start_of(i);
    if (t > span.end || walk.end_of(i) < span.begin) continue;
    const HalfStepTracks& p = walk.tracks(i);
    const bool up = walk.half_step(i).kind == HalfStepKind::kUp;
    for (double knot : {t, t + p.t1(), t + p.t2(), walk.end_of(i),
                        t + (up ? p.horizontal_begin() : p.horizontal_end())}) {
      if (knot > span.begin && knot < span.end) knots.push_back(knot);
    }
  }
  std::sort(knots.begin(), knots.end());
  knots.erase(std::unique(knots.begin(), knots.end()), knots.end());
  return knots;
}

TimeSpan ExtendedToKnots(const SuperposedWalk& walk, const TimeSpan& span) {
  const auto begins_stretch = [&walk](double t) {
    return t == walk.duration() || t == walk.start_of(walk.Locate(t).half_step);
  };
  if (begins_stretch(span.begin) && begins_stretch(span.end)) return span;
  TimeSpan extended = span;
  const int before = walk.Locate(std::nextafter(span.begin, -1.0)).half_step;
  const double earliest = walk.start_of(before);
  if (earliest < span.begin) {
    const std::vector<double> knots = KnotsInside(walk, {earliest, span.begin});
    extended.begin = knots.empty() ? earliest : knots.back();
  }
  const int last = walk.Locate(span.end).half_step;
  double latest = walk.end_of(last);
  if (last + 1 < walk.num_half_steps()) latest = std::min(latest, walk.start_of(last + 1));
  if (latest > span.end) {
    const std::vector<double> knots = KnotsInside(walk, {span.end, latest});
    extended.end = knots.empty() ? latest : knots.front();
  }
  return extended;
}

// An interval with what is not yet proved of it.
struct CertifiedFeasibility::Open {
  double begin;
  double end;
  OpenGroups groups;
};

// What a proof of an open interval found.
struct CertifiedFeasibility::Settled {
  bool stopped = false;  // before it began
  std::optional<Margin> violated;
  Certificate rows;
  Work work;
  long queries = 0;
};

CertifiedFeasibility::CertifiedFeasibility(MarginEvaluator evaluator,
                                           const CertificationOptions& options,
                                           CertificationScope scope)
    : evaluator_(std::move(evaluator)),
      options_(options),
      scope_(std::move(scope)),
      statements_(evaluator_),
      all_(statements_.All()) {
  std::erase_if(all_, [this](const OpenGroup& group) {
    return std::ranges::find(scope_.families, group.family) == scope_.families.end();
  });
  HALFSTEP_CHECK(options.resolution > 0.0 && options.longest >= options.resolution,
                 "resolution " << options.resolution << ", longest " << options.longest);
}

std::string CertifiedFeasibility::Description() const {
  PlainStream out;
  out << "certified for all time, resolution " << 1e3 * options_.resolution << " ms";
  return out.str();
}

Feasibility CertifiedFeasibility::Decide(const SuperposedWalk& walk, const TimeSpan& asked,
                                         MarginEvaluator::Scratch* scratch,
                                         Certificate* certificate,
                                         const std::stop_token& stop) const {
  const TimeSpan span{std::max(asked.begin, scope_.since), std::min(asked.end, scope_.until)};
  if (span.end < span.begin) return {Verdict::kFeasible, Evidence::kCertified, {}};
  // Coarse intervals of the whole span first: a violation that lasts is met early.
  std::vector<Open> open;
  std::vector<double> knots = KnotsInside(walk, span);
  knots.push_back(span.end);
  double begin = span.begin;
  for (double end : knots) {
    const int n = std::max(1, static_cast<int>(std::ceil((end - begin) / options_.longest)));
    for (int k = 0; k < n; ++k) {
      const double a = begin + (end - begin) * k / n;
      const double b = k + 1 == n ? end : begin + (end - begin) * (k + 1) / n;
      open.push_back({a, b, all_});
    }
    begin = end;
  }
  while (!open.empty()) {
    std::vector<Settled> settled(open.size());
    const int met = ProveOpen(walk, stop, &open, scratch, certificate != nullptr, &settled);
    for (int i = 0; i <= met && i < std::ssize(open); ++i) {
      const Settled& one = Nth(settled, i);
      scratch->work += one.work;
      scratch->bodies.queries += one.queries;
      if (certificate == nullptr) continue;
      certificate->insert(certificate->end(), one.rows.begin(), one.rows.end());
    }
    if (met < static_cast<int>(open.size())) {
      const Settled& last = Nth(settled, met);
      if (last.violated) return {Verdict::kViolated, Evidence::kCertified, *last.violated};
      const Open& still = Nth(open, met);
      const Margin undecided =
          OpenStatement(still.groups.front(), 0.5 * (still.begin + still.end), evaluator_, walk);
      return {Verdict::kUndecided, Evidence::kCertified, undecided, last.stopped};
    }
    std::vector<Open> halves;
    for (Open& now : open) {
      if (now.groups.empty()) continue;
      const double middle = 0.5 * (now.begin + now.end);
      halves.push_back({now.begin, middle, now.groups});
      halves.push_back({middle, now.end, std::move(now.groups)});
    }
    open = std::move(halves);
  }
  return {Verdict::kFeasible, Evidence::kCertified, {}};
}

int CertifiedFeasibility::ProveOpen(const SuperposedWalk& walk, const std::stop_token& stop,
                                    std::vector<Open>* open, MarginEvaluator::Scratch* scratch,
                                    bool with_rows, std::vector<Settled>* settled) const {
  while (std::ssize(scratch->of_others) < NumThreads(scratch->workers) - 1) {
    scratch->of_others.push_back(evaluator_.MakeScratch());
  }
  const Work work = scratch->work;
  const long queries = scratch->bodies.queries;
  const int met =
      RunWith(scratch->workers, static_cast<int>(open->size()), [&](int index, int thread) {
        Open& now = Nth(*open, index);
        Settled& found = Nth(*settled, index);
        if (stop.stop_requested()) {
          found.stopped = true;
          return false;
        }
        MarginEvaluator::Scratch& own =
            thread == 0 ? *scratch : Nth(scratch->of_others, thread - 1);
        const Work work_before = own.work;
        const long queries_before = own.bodies.queries;
        found.violated = statements_.Prove(walk, now.begin, now.end, &now.groups, &own,
                                           with_rows ? &found.rows : nullptr);
        found.work = own.work - work_before;
        found.queries = own.bodies.queries - queries_before;
        return !found.violated &&
               (now.groups.empty() || now.end - now.begin >= options_.resolution);
      });
  // What was done beyond that interval depends on the threads.
  scratch->work = work;
  scratch->bodies.queries = queries;
  return met;
}

Feasibility CertifiedFeasibility::Check(const SuperposedWalk& walk, const TimeSpan& span,
                                        MarginEvaluator::Scratch* scratch) const {
  return Decide(walk, ExtendedToKnots(walk, span), scratch, nullptr, scratch->stop);
}

Feasibility CertifiedFeasibility::Certify(const SuperposedWalk& walk,
                                          MarginEvaluator::Scratch* scratch,
                                          Certificate* certificate,
                                          const std::stop_token& stop) const {
  certificate->clear();
  const Feasibility answer = Decide(walk, {0.0, walk.duration()}, scratch, certificate, stop);
  std::sort(certificate->begin(), certificate->end(),
            [](const CertificateRow& a, const CertificateRow& b) {
              return std::tie(a.begin, a.end, a.family) < std::tie(b.begin, b.end, b.family);
            });
  return answer;
}

}  // namespace halfstep
