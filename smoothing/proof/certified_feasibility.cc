#include "smoothing/proof/certified_feasibility.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <sstream>
#include <tuple>
#include <utility>

#include "wpg/check.h"

namespace halfstep {
namespace {

struct Open {
  double begin;
  double end;
  OpenGroups groups;
};

// The statement an open interval is undecided for, to name it.
Margin OpenStatement(const Open& open, const MarginEvaluator& evaluator,
                     const SuperposedWalk& walk) {
  const OpenGroup& group = open.groups.front();
  Margin margin = evaluator.statements(group.family).OfGroup(group.group);
  margin.t = 0.5 * (open.begin + open.end);
  margin.at = walk.Locate(margin.t);
  return margin;
}

}  // namespace

std::vector<double> KnotsInside(const SuperposedWalk& walk, const TimeWindow& window) {
  std::vector<double> knots;
  for (int i = 0; i < walk.num_half_steps(); ++i) {
    const double t = walk.start_of(i);
    if (t > window.end || walk.end_of(i) < window.begin) continue;
    const HalfStepProfiles& p = walk.profiles(i);
    const bool up = walk.half_step(i).kind == HalfStepKind::kUp;
    for (double knot : {t, t + p.t1(), t + p.t2(), walk.end_of(i),
                        t + (up ? p.horizontal_begin() : p.horizontal_end())}) {
      if (knot > window.begin && knot < window.end) knots.push_back(knot);
    }
  }
  std::sort(knots.begin(), knots.end());
  knots.erase(std::unique(knots.begin(), knots.end()), knots.end());
  return knots;
}

TimeWindow ExtendedToKnots(const SuperposedWalk& walk, const TimeWindow& window) {
  const auto begins_stretch = [&walk](double t) {
    return t == walk.duration() || t == walk.start_of(walk.Locate(t).half_step);
  };
  if (begins_stretch(window.begin) && begins_stretch(window.end)) return window;
  TimeWindow extended = window;
  const int before = walk.Locate(std::nextafter(window.begin, -1.0)).half_step;
  const double earliest = walk.start_of(before);
  if (earliest < window.begin) {
    const std::vector<double> knots = KnotsInside(walk, {earliest, window.begin});
    extended.begin = knots.empty() ? earliest : knots.back();
  }
  const int last = walk.Locate(window.end).half_step;
  double latest = walk.end_of(last);
  if (last + 1 < walk.num_half_steps()) latest = std::min(latest, walk.start_of(last + 1));
  if (latest > window.end) {
    const std::vector<double> knots = KnotsInside(walk, {window.end, latest});
    extended.end = knots.empty() ? latest : knots.front();
  }
  return extended;
}

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
  std::ostringstream out;
  out << "certified for all time, resolution " << 1e3 * options_.resolution << " ms";
  return out.str();
}

Feasibility CertifiedFeasibility::Decide(const SuperposedWalk& walk, const TimeWindow& asked,
                                         MarginEvaluator::Scratch* scratch,
                                         Certificate* certificate,
                                         const std::stop_token& stop) const {
  const TimeWindow window{std::max(asked.begin, scope_.since), std::min(asked.end, scope_.until)};
  if (window.end < window.begin) return {Verdict::kFeasible, Evidence::kCertified, {}};
  // Coarse intervals of the whole window first: a violation that lasts is met early.
  std::deque<Open> open;
  std::vector<double> knots = KnotsInside(walk, window);
  knots.push_back(window.end);
  double begin = window.begin;
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
    if (stop.stop_requested()) {
      return {Verdict::kUndecided, Evidence::kCertified,
              OpenStatement(open.front(), evaluator_, walk), /*stopped=*/true};
    }
    Open now = std::move(open.front());
    open.pop_front();
    const auto violated =
        statements_.Prove(walk, now.begin, now.end, &now.groups, scratch, certificate);
    if (violated) return {Verdict::kViolated, Evidence::kCertified, *violated};
    if (now.groups.empty()) continue;
    if (now.end - now.begin < options_.resolution) {
      return {Verdict::kUndecided, Evidence::kCertified, OpenStatement(now, evaluator_, walk)};
    }
    const double middle = 0.5 * (now.begin + now.end);
    open.push_back({now.begin, middle, now.groups});
    open.push_back({middle, now.end, std::move(now.groups)});
  }
  return {Verdict::kFeasible, Evidence::kCertified, {}};
}

Feasibility CertifiedFeasibility::Check(const SuperposedWalk& walk, const TimeWindow& window,
                                        MarginEvaluator::Scratch* scratch) const {
  return Decide(walk, ExtendedToKnots(walk, window), scratch, nullptr, scratch->stop);
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
