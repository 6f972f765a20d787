#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "smoothing/margins/margin_statements.h"
#include "wpg/nth.h"

namespace halfstep {

/// A number of each joint of the legs, by Index(Side).
using ByLegs = std::array<Vector6d, 2>;

/// Families with a statement about each joint of the legs. Subject: 6·Index(Side) + joint.
class JointFamily : public WholeFamily {
 public:
  /// `place` is borrowed.
  JointFamily(const FamilyTraits& traits, const MarginPlace& place)
      : WholeFamily(traits), place_(place) {}

  int count() const override { return 12; }
  std::string Subject(const Margin& margin) const final {
    if (margin.subject < 0) return "legs";
    return Nth(Nth(place_.robot.legs, margin.subject / 6).joints, margin.subject % 6).name;
  }
  std::vector<Side> PlacedFeet(const Margin&) const final { return {}; }

 protected:
  /// Calls visit(Index(Side), joint, its data, its subject) in the order of subjects.
  template <typename Visit>
  void ForEachJoint(const Visit& visit) const {
    for (size_t s = 0; s < 2; ++s) {
      for (int j = 0; j < 6; ++j) {
        visit(s, j, Nth(place_.robot.legs[s].joints, j), 6 * static_cast<int>(s) + j);
      }
    }
  }
  /// Robot and scene.
  const MarginPlace& place() const { return place_; }

 private:
  const MarginPlace& place_;
};

/// A joint of which something is limited, and the sign of that.
struct JointValue {
  size_t leg = 0;     ///< Index(Side)
  int joint = 0;      ///< from the hip down
  double sign = 1.0;  ///< ±1
};

/// Families that limit the size of something of each joint: limit − |value|; −∞ where nothing can
/// be said of the legs. `Family` has
///   - `std::optional<ByLegs> ValuesAt(Instant*)`: none where nothing can be said;
///   - `double Limit(const Instant&, const LegJoint&)`: +∞ where there is none;
///   - `void AddSize(Instant*, const JointValue&, double margin, SlackSink*,
///   std::vector<ByLegs>*)`,
///     which adds the row of a joint; the last is for what it makes once for all joints.
template <typename Family>
class JointSizeFamily : public JointFamily {
 public:
  /// Traits and place of the class.
  using JointFamily::JointFamily;

  Margin Least(Instant* at, double) const final {
    const auto values = self().ValuesAt(at);
    return values ? LeastOf(*at, *values) : Of(-kUnlimited, -1);
  }
  void AddRows(Instant* at, SlackSink* rows) const final {
    if (at->demanded(family()) == kNotDemanded) return;
    const auto values = self().ValuesAt(at);
    if (!values) return;
    std::vector<ByLegs> made;
    ForEachJoint([&](size_t s, int j, const LegJoint& joint, int) {
      const double value = (*values)[s][j];
      const JointValue of{.leg = s, .joint = j, .sign = value < 0.0 ? -1.0 : 1.0};
      self().AddSize(at, of, self().Limit(*at, joint) - std::abs(value), rows, &made);
    });
  }

 protected:
  /// The least margin of known values.
  Margin LeastOf(const Instant& at, const ByLegs& values) const {
    Margin least = Of(kUnlimited, -1);
    ForEachJoint([&](size_t s, int j, const LegJoint& joint, int subject) {
      Lower(Of(self().Limit(at, joint) - std::abs(values[s][j]), subject), &least);
    });
    return least;
  }

 private:
  const Family& self() const { return static_cast<const Family&>(*this); }
};

}  // namespace halfstep
