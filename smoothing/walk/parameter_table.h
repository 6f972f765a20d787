#pragma once

#include <optional>
#include <string>
#include <vector>

#include "smoothing/walk/homotopy_parameters.h"
#include "wpg/nth.h"

namespace halfstep {

/// A parameter that methods must leave alone.
struct FixedParameter {
  HomotopyParameter parameter;                 ///< which one
  std::optional<double> value = std::nullopt;  ///< in the family's unit; none: as planned
};

/// One parameter of a sequence.
struct ParameterRow {
  HomotopyParameter parameter;  ///< which one
  double start = 0.0;           ///< where methods begin: as planned, or where it is fixed
  /// The range that methods may choose from, start included. An overlap's natural bound, which
  /// depends on durations, holds besides; beside a fixed overlap, durations stay long
  /// enough for it, and the ZMP's shifts short enough.
  double lower = 0.0, upper = 0.0;  ///< lower ≤ start ≤ upper, in the family's unit
  bool fixed = false;  ///< or of a family that methods may not move: lower = start = upper
};

/// Every parameter of a sequence, family after family: what a method may move, how far, and from
/// where. All code that goes through the parameters goes through these rows.
class ParameterTable {
 public:
  /// Throws std::logic_error where ComplaintAbout() complains.
  explicit ParameterTable(const HalfStepSequence& sequence,
                          const std::vector<FixedParameter>& fixed = {},
                          const ParameterChoice& choice = {});

  /// In the order of ParameterFamily, then of the index.
  const std::vector<ParameterRow>& rows() const& { return rows_; }
  const std::vector<ParameterRow>& rows() const&& = delete;  // of a temporary: `for` would dangle
  /// The row of a parameter, and its number. Precondition: the sequence has it.
  const ParameterRow& row(const HomotopyParameter& parameter) const {
    return Nth(rows_, IndexOf(parameter));
  }
  /// Number of its row.
  int IndexOf(const HomotopyParameter& parameter) const {
    return first_[parameter.family] + parameter.index;
  }
  /// Whether methods may move it.
  bool free(const HomotopyParameter& parameter) const { return !row(parameter).fixed; }

  /// The planned motion, except for the parameters that are fixed at another value.
  HomotopyParameters Start() const;

 private:
  // Durations beside a fixed overlap stay so long, and the ZMP's shifts so short, that it is within
  // its natural bound.
  void LeaveRoomFor(int junction, const HomotopyParameters& start);

  std::vector<ParameterRow> rows_;
  ByParameterFamily<int> first_;  // row of each family
};

/// Why these parameters of a sequence cannot be fixed together at these values; "" when they can.
/// It is a sentence that counts from 1: "overlap 9: there are 5 (valid: 1 … 5)".
std::string ComplaintAbout(const HalfStepSequence& sequence,
                           const std::vector<FixedParameter>& fixed);

}  // namespace halfstep
