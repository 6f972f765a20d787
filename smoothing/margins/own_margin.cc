#include "smoothing/margins/own_margin.h"

#include <cmath>

#include "smoothing/margins/family_class.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

// The least of a program's own margins, each divided by its scale. Subject: its place among them.
class OwnMargin final : public WholeFamily {
 public:
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kOwn,
      .name = "own",
      .unit = "1",
      .key = "own",
      .meaning = "inside every margin that this program registered, of its scale",
      .remedy = "what the margin is about",
      .sentence = kOfALimit,
      .coverage = kAlwaysCovered,
      .scope = MarginScope::kRobot,
      .scale = 1.0,
      .demanded = 0.0,
      .raised = true,
      .cost = MarginCost::kWalk,
      .row = MarginFamily::kOwn,
      .most = 1000.0,
  };

  explicit OwnMargin(const MarginPlace& place) : WholeFamily(kTraits), all_(place.own) {}

  bool present(const MarginLimits&) const override { return !all_.empty(); }
  int count() const override { return static_cast<int>(all_.size()); }
  int groups() const override { return all_.empty() ? 0 : 1; }
  std::string Subject(const Margin& margin) const override {
    if (margin.subject >= 0) return Nth(all_, margin.subject)->name();
    std::string names;  // where it is not known which one
    for (const auto& own : all_) names += (names.empty() ? "" : ", ") + own->name();
    return names;
  }
  std::vector<Side> PlacedFeet(const Margin&) const override { return {}; }

  Margin Least(Instant* at, double) const override {
    Margin least = Of(kUnlimited, -1);
    for (int i = 0; i < count(); ++i) Lower(MarginOf(i, at), &least);
    return least;
  }

  void AddRows(Instant* at, SlackSink* rows) const override {
    for (const auto& own : all_) {
      const double value = own->Value(at) / own->scale();
      if (!(value <= rows->cutoff_margin()) || !std::isfinite(value)) continue;
      const std::vector<double> slopes = own->Slopes(at, rows->sensitivities);
      rows->AddAlong(value, [&](size_t i) { return slopes[i] / own->scale(); });
    }
  }

 protected:
  void AddBounds(const MarginInterval& interval, TightestStatement* tightest) const override {
    for (int i = 0; i < count(); ++i) {
      const Margin margin = MarginOf(i, &interval.mid);
      if (margin.value == kUnlimited) continue;
      const OwnStatement& own = *Nth(all_, i);
      tightest->Add(margin, own.Change(interval) / own.scale());
    }
  }

 private:
  Margin MarginOf(int i, Instant* at) const {
    return Of(Nth(all_, i)->Value(at) / Nth(all_, i)->scale(), i);
  }

  const OwnMargins& all_;
};

}  // namespace

const FamilyClass& ClassOf(TagOf<OwnMargin>) { return kClassOf<OwnMargin>; }

}  // namespace halfstep
