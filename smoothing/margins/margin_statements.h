#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "smoothing/margins/family_traits.h"
#include "smoothing/margins/instant.h"
#include "smoothing/margins/slack_sink.h"

namespace halfstep {

/// Of the statements that were added, the one with the least to spare (margin − change), and how
/// many there were.
struct TightestStatement {
  Margin margin;       ///< its value, subject and time
  double bound = 0.0;  ///< how much the margin changes at most [its unit]
  int count = 0;       ///< of all that were added

  /// Adds a statement whose margin changes by at most `change` [its unit], but for the rounding of
  /// that number and of what it was subtracted to (smoothing/README.md, "Rounding", 1).
  void Add(const Margin& added, double change);
  /// Counts a statement with at least `spare` to spare, without its margin. Returns false, and
  /// counts nothing, when it may be the tightest.
  bool Pass(double spare);
};

/// What was found about a family's statements over an interval.
struct FamilyProof {
  TightestStatement held;          ///< of those that hold for all t; there may be none
  std::optional<Margin> violated;  ///< one that is violated at the midpoint
};

/// All statements of one family: their values at an instant, how much these change at most around
/// it, and their derivatives along the parameters of the homotopy. A family is a class that defines
/// all three, so a family without a bound does not compile. Const and thread-safe; scratch is the
/// instant's.
class MarginStatements {
 public:
  /// `traits` are those of the class.
  explicit MarginStatements(const FamilyTraits& traits) : traits_(traits) {}
  virtual ~MarginStatements() = default;
  MarginStatements(const MarginStatements&) = delete;
  MarginStatements& operator=(const MarginStatements&) = delete;

  const FamilyTraits& traits() const { return traits_; }  ///< name, unit and use of the family
  MarginFamily family() const { return traits_.family; }  ///< which it is

  /// Whether the robot has what the family is about, and the limits ask for it. If not, nobody asks
  /// for statements, every margin is +∞, and no file has a line of it.
  virtual bool present(const MarginLimits&) const { return true; }
  /// How many statements there are at every instant.
  virtual int count() const = 0;
  /// The name of what a margin of the family belongs to: "RLEG_LINK5 - bar", "right foot",
  /// "LLEG_JOINT3".
  virtual std::string Subject(const Margin& margin) const = 0;
  /// The feet whose places alone decide a margin while all of them stand: then the footsteps that
  /// put them there are to blame for it. Empty: it is about how something moves.
  virtual std::vector<Side> PlacedFeet(const Margin& margin) const = 0;

  /// The least margin at an instant, without `at` and `t`. It is +∞ when there is nothing to watch,
  /// and −∞ when a leg does not reach that the margin needs. Margins of `enough` or more [its unit]
  /// are not told apart.
  virtual Margin Least(Instant* at, double enough) const = 0;
  /// The first margin that is found below `demanded` [its unit]; none when there is none.
  virtual std::optional<Margin> FirstBelow(Instant* at, double demanded) const;
  /// Adds every margin below `demanded` [its unit] that the family tells apart: of each pair or
  /// body, or else the least one.
  virtual void AddBelow(Instant* at, double demanded, std::vector<Margin>* below) const;

  /// Adds every statement that is nearer to its limit than the sink's cutoff, with its derivatives.
  /// Each statement is smooth by itself (one for each polygon edge, or end of a joint's range).
  virtual void AddRows(Instant* at, SlackSink* rows) const = 0;

  /// How many groups of statements are proved separately: 1 when all are proved at once, else one
  /// for each body or pair of bodies.
  virtual int groups() const { return 1; }
  /// A margin that names a group that could not be decided. Its value is not a number.
  virtual Margin OfGroup(uint16_t group) const;
  /// Removes from `open` the groups whose statements hold for all t of the interval.
  virtual FamilyProof Prove(const MarginInterval& interval, std::vector<uint16_t>* open) const = 0;

 protected:
  /// A margin of this family about a subject; its instant is filled in by the caller.
  Margin Of(double value, int subject, int other = -1) const {
    return {.family = family(), .value = value, .subject = subject, .other = other};
  }
  /// Replaces `least` by `other` where that is smaller. What is not a number counts as −∞.
  static void Lower(const Margin& other, Margin* least);
  /// Names for Subject: "right foot", "both feet"; "RLEG_LINK5", "robot".
  static std::string FootName(const Margin& margin);
  /// As FootName, of bodies.
  static std::string BodyName(const RobotModel& robot, int body);
  /// The foot to which a body belongs (index of RobotModel::bodies); empty: to none.
  static std::vector<Side> FootOf(const RobotModel& robot, int body);
  /// Distances are told apart up to this [m]: MarginLimits::clearance_cap, or twice the largest
  /// demanded clearance where that is more.
  static double ClearanceCap(const MarginLimits& limits);

 private:
  const FamilyTraits& traits_;
};

/// A family whose statements are proved all at once, from the margins at the midpoint and bounds of
/// how much each changes.
class WholeFamily : public MarginStatements {
 public:
  /// The traits of the class.
  using MarginStatements::MarginStatements;
  FamilyProof Prove(const MarginInterval& interval, std::vector<uint16_t>* open) const final;

 protected:
  /// Adds every statement with its margin at the midpoint and a bound of its change within the
  /// interval.
  virtual void AddBounds(const MarginInterval& interval, TightestStatement* tightest) const = 0;
};

}  // namespace halfstep
