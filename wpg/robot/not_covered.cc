#include "wpg/robot/not_covered.h"

#include "wpg/files/text.h"
#include "wpg/nth.h"
#include "wpg/robot/placeholder_limits.h"
#include "wpg/robot/torque_limits.h"

namespace halfstep {
namespace {

struct KindWords {
  NotCoveredKind kind;
  std::string_view name, plural;
};

constexpr KindWords kKinds[] = {
    {NotCoveredKind::kFamily, "family", "margin families"},
    {NotCoveredKind::kLimit, "limit", "joints whose limits are not known"},
    {NotCoveredKind::kPlaceholder, "placeholder", "limits that nothing ever meets"},
    {NotCoveredKind::kAssumed, "assumed", "assumed values"},
    {NotCoveredKind::kMass, "mass", "parts of the mass without a body"},
    {NotCoveredKind::kPair, "pair", "pairs of bodies that are not watched"},
};

// Where no torque limit is known the whole family says so.
void AddUnknownTorques(const RobotModel& robot, std::vector<NotCovered>* list) {
  if (!TorqueFault(robot).empty()) return;
  for (const std::string& joint : JointsOfUnknownTorque(robot)) {
    list->push_back({NotCoveredKind::kLimit, joint,
                     joint + ": its torque limit is not known (`effort_limits_n_m` of the robot "
                             "file), so that nothing is demanded of its torque"});
  }
}

void AddMassWithoutBodies(const RobotModel& robot, std::vector<NotCovered>* list) {
  if (robot.bare_links.empty()) return;
  double mass = 0.0;
  std::string links;
  for (const BareLink& link : robot.bare_links) {
    mass += link.mass;
    links += (links.empty() ? "" : ", ") + link.name + Formatted(" (%.3g kg)", link.mass);
  }
  list->push_back({NotCoveredKind::kMass, "mass",
                   Formatted("%.3g %% of the mass (%.3g of %.3g kg) has no body, so that nothing "
                             "watches what it touches: ",
                             100.0 * mass / robot.mass, mass, robot.mass) +
                       links});
}

void AddPairs(const RobotModel& robot, std::vector<NotCovered>* list) {
  const auto name = [&robot](int body) { return Nth(robot.bodies, body).name; };
  for (const UnwatchedPair& pair : robot.unwatched_pairs) {
    const std::string subject = name(pair.a) + " - " + name(pair.b);
    list->push_back({NotCoveredKind::kPair, subject, subject + ": not watched: " + pair.why});
  }
}

}  // namespace

std::string_view Name(NotCoveredKind kind) { return Nth(kKinds, kind).name; }

std::optional<NotCoveredKind> NotCoveredKindOf(std::string_view name) {
  for (const KindWords& kind : kKinds) {
    if (kind.name == name) return kind.kind;
  }
  return std::nullopt;
}

std::vector<NotCovered> NotCoveredOf(const RobotModel& robot) {
  std::vector<NotCovered> list;
  AddUnknownTorques(robot, &list);
  for (const PlaceholderLimit& limit : PlaceholderLimits(robot)) {
    list.push_back({NotCoveredKind::kPlaceholder, limit.joint, limit.joint + ": " + limit.why});
  }
  AddMassWithoutBodies(robot, &list);
  AddPairs(robot, &list);
  return list;
}

NotCovered NotDemandedFamily(std::string_view name, const std::string& why) {
  return {NotCoveredKind::kFamily, std::string(name),
          std::string(name) + ": nothing is demanded: " + why};
}

NotCovered UnlimitedFamily(std::string_view name) {
  return {NotCoveredKind::kFamily, std::string(name),
          std::string(name) + ": has no limit: the config sets none"};
}

NotCovered AssumedFriction(double coefficient) {
  return {NotCoveredKind::kAssumed, "friction",
          Formatted("friction: the floor's coefficient %.3g is what is assumed where a scene "
                    "states none",
                    coefficient)};
}

NotCovered AssumedAccelerations(const AssumedAcceleration& assumed) {
  constexpr int kAll = 12;
  const std::string of =
      assumed.joints == kAll ? "" : Formatted(" of %d of %d joints", assumed.joints, kAll);
  return {NotCoveredKind::kAssumed, "joint_acceleration",
          Formatted("limits of joint accelerations are assumed (%.6g rad/s²): the robot file "
                    "states none",
                    assumed.limit) +
              of};
}

std::vector<std::string> SummaryOf(const std::vector<NotCovered>& list) {
  constexpr size_t kMost = 4;
  std::vector<std::string> lines;
  for (const KindWords& kind : kKinds) {
    std::vector<const NotCovered*> of_kind;
    for (const NotCovered& one : list) {
      if (one.kind == kind.kind) of_kind.push_back(&one);
    }
    if (of_kind.size() <= kMost) {
      for (const NotCovered* one : of_kind) lines.push_back(one->sentence);
      continue;
    }
    std::string line = Formatted("%zu ", of_kind.size()) + std::string(kind.plural) + ": ";
    for (size_t i = 0; i + 1 < kMost; ++i) line += (i == 0 ? "" : ", ") + of_kind[i]->subject;
    lines.push_back(line + Formatted(" and %zu more", of_kind.size() - (kMost - 1)));
  }
  return lines;
}

std::string NotCoveredText(const std::vector<NotCovered>& list, const std::string& all,
                           const std::string& begin) {
  if (list.empty()) return "";
  std::string text =
      begin + (list.size() == 1 ? std::string("1 thing") : Formatted("%zu things", list.size())) +
      " that these certificates do not cover (each with its reason: " + all + ")\n";
  for (const std::string& line : SummaryOf(list)) text += begin + "  " + line + "\n";
  return text;
}

}  // namespace halfstep
