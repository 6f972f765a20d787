#pragma once

#include <memory>
#include <string>
#include <vector>

#include "smoothing/margins/margin_statements.h"

namespace halfstep {

/// A margin of one's own, which a program registers: demanded, proved and followed by optimizers as
/// those built in are, in the family `own`. What is proved is as true as Change() is. Const and
/// thread-safe. Its first user is the numbered example 07 (experiments/examples).
class OwnStatement {
 public:
  virtual ~OwnStatement() = default;
  virtual std::string name() const = 0;  ///< what a margin of it is said to belong to
  /// What counts as a clear change of the margin [its unit]; the family `own` counts in it.
  virtual double scale() const = 0;
  /// The margin at an instant [its unit], positive inside the limit; +∞ where there is none.
  virtual double Value(Instant* at) const = 0;
  /// How much the margin changes at most between the midpoint of an interval and any of its
  /// instants [its unit]. IntervalMotion has bounds of the walk's quantities; MarginInterval those
  /// of bodies and of the robot's ZMP. Asked only where Value is finite at the midpoint.
  virtual double Change(const MarginInterval& interval) const = 0;
  /// ∂Value/∂parameter i (n), in the order of `along`. Asked only where Value is finite.
  virtual std::vector<double> Slopes(Instant* at,
                                     const std::vector<WalkSensitivity>& along) const = 0;
};

/// Adds a margin of one's own. It must be known before any margin is evaluated or any config read,
/// so a program registers its margins first of all (std::logic_error afterwards).
void RegisterOwnMargin(std::unique_ptr<const OwnStatement> statement);
/// Those that are registered, in that order.
const std::vector<std::unique_ptr<const OwnStatement>>& OwnMargins();

/// The least of the registered margins, each divided by its scale. Subject: its place in
/// OwnMargins(). AllMarginFamilies() has this family only when something is registered.
class OwnMargin final : public WholeFamily {
 public:
  /// Of the family `own`.
  static constexpr FamilyTraits kTraits = {
      .family = MarginFamily::kOwn,
      .name = "own",
      .unit = "1",
      .key = "own",
      .meaning = "inside every margin that this program registered, of its scale",
      .remedy = "what the margin is about",
      .scale = 1.0,
      .demanded = 0.0,
      .raised = true,
      .cost = MarginCost::kWalk,
      .row = MarginFamily::kOwn,
      .most = 1000.0,
  };

  /// Needs nothing of the place.
  explicit OwnMargin(const MarginPlace&) : WholeFamily(kTraits) {}

  int count() const override;
  std::string Subject(const Margin& margin) const override;
  Margin Least(Instant* at, double enough) const override;
  void AddRows(Instant* at, SlackSink* rows) const override;

 protected:
  void AddBounds(const MarginInterval& interval, TightestStatement* tightest) const override;
};

}  // namespace halfstep
