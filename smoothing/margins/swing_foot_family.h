#pragma once

#include <string>
#include <vector>

#include "smoothing/margins/margin_statements.h"

namespace halfstep {

/// Families with one statement about the foot in the air; +∞ while both feet stand. Subject:
/// Index(Side). `Family` has
///   - `bool Watches(const Instant&)`: whether there is something to watch of a foot in the air;
///   - `double Value(const Instant&)`: the margin, and `AddRow(Instant*, SlackSink*)`: its row;
///   - `double Change(const MarginInterval&)`: how much it changes at most.
/// All but the first are asked only where it watches.
template <typename Family>
class SwingFootFamily : public WholeFamily {
 public:
  /// The traits of the class.
  using WholeFamily::WholeFamily;
  int count() const final { return 1; }
  std::string Subject(const Margin& margin) const final { return FootName(margin); }
  std::vector<Side> PlacedFeet(const Margin&) const final { return {}; }

  Margin Least(Instant* at, double) const final {
    Margin least = Of(kUnlimited, -1);
    if (IsWatched(*at)) Lower(Of(self().Value(*at), Index(at->swing())), &least);
    return least;
  }
  void AddRows(Instant* at, SlackSink* rows) const final {
    if (IsWatched(*at)) self().AddRow(at, rows);
  }

 protected:
  void AddBounds(const MarginInterval& interval, TightestStatement* tightest) const final {
    const Margin margin = Least(&interval.mid, kUnlimited);
    tightest->Add(margin, margin.subject < 0 ? 0.0 : self().Change(interval));
  }

 private:
  const Family& self() const { return static_cast<const Family&>(*this); }
  bool IsWatched(const Instant& at) const { return at.step_in_air() >= 0 && self().Watches(at); }
};

}  // namespace halfstep
