#include "smoothing/margins/margin_statements.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "wpg/nth.h"
#include "wpg/rounded.h"

namespace halfstep {

void TightestStatement::Add(const Margin& added, double given) {
  // Sums and products of less than a thousand numbers ≥ 0, and the margin's own difference.
  const double change = std::isfinite(added.value) ? given * (1.0 + 1024.0 * kRoundoff) +
                                                         8.0 * kRoundoff * std::abs(added.value)
                                                   : given;
  const double spare = added.value - change;
  // What is not a number stays, and meets no demand.
  if (count++ == 0 || std::isnan(spare) || spare < margin.value - bound) {
    margin = added;
    bound = change;
  }
}

bool TightestStatement::Pass(double spare) {
  if (count == 0 || !(spare >= margin.value - bound)) return false;
  ++count;
  return true;
}

std::optional<Margin> MarginStatements::FirstBelow(Instant* at, double demanded) const {
  if (demanded == kNotDemanded) return std::nullopt;
  const Margin least = Least(at, demanded);
  if (least.value >= demanded) return std::nullopt;
  return least;
}

void MarginStatements::AddBelow(Instant* at, double demanded, std::vector<Margin>* below) const {
  const Margin least = Least(at, demanded);
  if (!(least.value >= demanded)) below->push_back(least);
}

Margin MarginStatements::OfGroup(uint16_t) const { return Of(std::nan(""), -1); }

void MarginStatements::Lower(const Margin& other, Margin* least) {
  if (other.value >= least->value) return;
  *least = other;
  if (std::isnan(other.value)) least->value = -std::numeric_limits<double>::infinity();
}

std::string MarginStatements::FootName(const Margin& margin) {
  return margin.subject < 0 ? "both feet"
                            : std::string(Name(static_cast<Side>(margin.subject))) + " foot";
}

std::string MarginStatements::BodyName(const RobotModel& robot, int body) {
  return body < 0 ? "robot" : Nth(robot.bodies, body).name;
}

std::vector<Side> MarginStatements::FootOf(const RobotModel& robot, int body) {
  if (body < 0 || !IsOnFoot(Nth(robot.bodies, body))) return {};
  return {static_cast<Side>(Nth(robot.bodies, body).leg)};
}

double MarginStatements::ClearanceCap(const MarginLimits& limits) {
  return std::max({limits.clearance_cap, 2.0 * limits.demanded_of(MarginFamily::kClearance),
                   2.0 * limits.demanded_of(MarginFamily::kSelfClearance)});
}

FamilyProof WholeFamily::Prove(const MarginInterval& interval, std::vector<uint16_t>* open) const {
  TightestStatement tightest;
  AddBounds(interval, &tightest);
  const double demanded = interval.mid.demanded(family());
  FamilyProof proof;
  if (tightest.margin.value < demanded) proof.violated = tightest.margin;
  if (tightest.margin.value - tightest.bound >= demanded) {
    proof.held = tightest;
    open->clear();
  }
  return proof;
}

}  // namespace halfstep
