#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wpg/robot/robot_model.h"

namespace halfstep {

/// Why a certificate says nothing of something.
enum class NotCoveredKind {
  kFamily,       ///< a margin family of which nothing is demanded, or that has no limit
  kLimit,        ///< a limit of one joint that neither URDF nor robot file states
  kPlaceholder,  ///< a limit that is stated, but that nothing ever meets
  kAssumed,      ///< a value that is assumed, since no file states it
  kMass,         ///< mass without a body
  kPair,         ///< two bodies whose distance is not watched
};
/// "family", "limit", "placeholder", "assumed", "mass" or "pair", as in certificates.
std::string_view Name(NotCoveredKind kind);
/// The kind of that name; none: there is no such kind.
std::optional<NotCoveredKind> NotCoveredKindOf(std::string_view name);

/// One thing that a certificate does not cover.
struct NotCovered {
  NotCoveredKind kind = NotCoveredKind::kFamily;  ///< why it is not
  std::string subject;   ///< a family, a joint's name, "friction", "mass", "A - B" of two bodies
  std::string sentence;  ///< whole, with the subject and the reason, without a full stop
  friend bool operator==(const NotCovered&, const NotCovered&) = default;
};

/// All that no certificate about a robot covers, whatever is demanded: limits that are not known
/// or placeholders, mass without bodies, pairs of bodies that are not watched, in this order.
std::vector<NotCovered> NotCoveredOf(const RobotModel& robot);

/// A family by its name of which nothing is demanded, and why.
NotCovered NotDemandedFamily(std::string_view name, const std::string& why);
/// A family by its name that has no limit in the config.
NotCovered UnlimitedFamily(std::string_view name);
/// The friction coefficient that is assumed where a scene states none.
NotCovered AssumedFriction(double coefficient);

/// The limits of joint accelerations that are assumed where a robot file states none.
NotCovered AssumedAccelerations(const AssumedAcceleration& assumed);

/// The list for a screen: every sentence of a kind that has few, else its number and the first
/// subjects.
std::vector<std::string> SummaryOf(const std::vector<NotCovered>& list);
/// The same as lines of text under a heading with their number, each line after `begin`; `all` says
/// where every sentence is ("certificate.json"). "" for an empty list.
std::string NotCoveredText(const std::vector<NotCovered>& list, const std::string& all,
                           const std::string& begin = "");

}  // namespace halfstep
