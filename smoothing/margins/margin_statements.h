#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "smoothing/margins/family_traits.h"
#include "smoothing/margins/instant.h"
#include "smoothing/margins/slack_sink.h"

namespace halfstep {

/// The statement with the least to spare, margin − change, of those that were added, and how many
/// there were.
struct TightestStatement {
  Margin margin;
  double bound = 0.0;  ///< how much the margin changes at most [its unit]
  int count = 0;

  void Add(const Margin& added, double change);
  /// Adds one that has at least `spare`, unless it may be the tightest: false.
  bool Pass(double spare);
};

/// What came of a family's statements over an interval.
struct FamilyProof {
  TightestStatement held;          ///< of those that hold for all t; their number may be 0
  std::optional<Margin> violated;  ///< one that is violated at the midpoint
};

/// All statements of one family: their values at an instant, how much these change at most around
/// it, and their derivatives along the parameters of the homotopy. A family is a class that defines
/// all of it: one without a bound cannot be made. Const and thread-safe; scratch is the instant's.
class MarginStatements {
 public:
  explicit MarginStatements(const FamilyTraits& traits) : traits_(traits) {}
  virtual ~MarginStatements() = default;
  MarginStatements(const MarginStatements&) = delete;
  MarginStatements& operator=(const MarginStatements&) = delete;

  const FamilyTraits& traits() const { return traits_; }
  MarginFamily family() const { return traits_.family; }

  /// How many statements there are at every instant.
  virtual int count() const = 0;
  /// What a margin of the family belongs to: "RLEG_LINK5 - bar", "right foot", "LLEG_JOINT3".
  virtual std::string Subject(const Margin& margin) const = 0;

  /// The least margin at an instant, its place in time left open; +∞: nothing to watch. −∞ when a
  /// leg does not reach and the margin needs it. Margins of `enough` and more are not told apart.
  virtual Margin Least(Instant* at, double enough) const = 0;
  /// A margin below what is demanded, the first found.
  virtual std::optional<Margin> FirstBelow(Instant* at, double demanded) const;

  /// Adds every statement that is nearer to its limit than the sink's cutoff, smooth one by one,
  /// with its derivatives.
  virtual void AddRows(Instant* at, SlackSink* rows) const = 0;

  /// Statements are proved in groups, each by itself: all at once, or body by body.
  virtual int groups() const { return 1; }
  /// A margin that stands for a group that could not be decided.
  virtual Margin OfGroup(uint16_t group) const;
  /// Removes from `open` the groups whose statements hold for all t of the interval.
  virtual FamilyProof Prove(const MarginInterval& interval, std::vector<uint16_t>* open) const = 0;

 protected:
  /// Added to every bound, in its unit, for the rounding of postures and margins: on random
  /// intervals the truth exceeded the bounds of places, which can be zero, by up to 2e-15 m.
  static constexpr double kRounding = 1e-12;

  Margin Of(double value, int subject, int other = -1) const {
    return {.family = family(), .value = value, .subject = subject, .other = other};
  }
  /// Keeps the smaller of a margin and a new one; what is not a number is −∞.
  static void Lower(const Margin& other, Margin* least);
  /// "right foot", "both feet"; "LLEG_JOINT3", "legs"; "RLEG_LINK5", "robot".
  static std::string FootName(const Margin& margin);
  static std::string JointName(const RobotModel& robot, const Margin& margin);
  static std::string BodyName(const RobotModel& robot, int body);
  /// Distances are told apart up to here [m].
  static double ClearanceHorizon(const MarginLimits& limits);

 private:
  const FamilyTraits& traits_;
};

/// A family whose statements are proved all at once: from the margins at the midpoint and how much
/// each changes at most.
class WholeFamily : public MarginStatements {
 public:
  using MarginStatements::MarginStatements;
  FamilyProof Prove(const MarginInterval& interval, std::vector<uint16_t>* open) const final;

 protected:
  /// Adds all statements: margin at the midpoint, and its change in the interval at most.
  virtual void AddBounds(const MarginInterval& interval, TightestStatement* tightest) const = 0;
};

}  // namespace halfstep
