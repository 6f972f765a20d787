#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "smoothing/walk/parameter_choice.h"
#include "smoothing/walk/parameter_family.h"
#include "wpg/motion/half_step_sequence.h"

namespace halfstep {

struct HomotopyParameters;

/// What the index of a parameter counts.
enum class ParameterOf { kJunction, kStep, kHalfStep };

/// What a parameter is of the half-steps that it belongs to, and so of their tracks.
enum class ParameterPart {
  kBegin,     ///< when the next half-step begins
  kDuration,  ///< T
  kState,     ///< a number of the states in which they rest (SlopesOfStates): of from and to
  kProfile,   ///< a number of the profiles (Profile::ByShape)
  kFootstep,  ///< where the swing foot lands: of from and to
};

/// What a number is multiplied by for a robot that is not of HRP-2's size.
enum class ParameterScale { kNone, kLegLength, kStanceWidth };

/// A number that limits how far methods may move a family, and its key in configs.
struct ParameterBoundKey {
  std::string_view key = "";                     ///< in configs
  std::string_view meaning = "";                 ///< one line, for `halfstep explain-config`
  double initial = 0.0;                          ///< by default
  double min = 0.0, max = 0.0;                   ///< valid range
  std::string_view unit = "";                    ///< "m"; "": a number
  ParameterScale scale = ParameterScale::kNone;  ///< of the default
};

/// All that programs, proofs, files and messages need to know about a family: its row.
struct ParameterFamilyTraits {
  ParameterFamily family;      ///< whose row it is
  std::string_view name;       ///< in YAML and messages: "overlap"
  std::string_view unit = "";  ///< "s"; "": a number
  ParameterOf of;              ///< what its index counts
  ParameterPart part;          ///< what it is of half-steps
  std::string_view column;     ///< of its values in the CSV `table()`
  int rank;                    ///< order of the families' columns in one table, smallest first
  std::string_view meaning;    ///< one line, for the column and for messages
  /// Its column is in tables only of walks in which a value of such a family is not the plan's.
  bool of_form = false;
  /// It means something only where soles stand at different heights: no table of another walk has
  /// its column, and what moves heights moves it.
  bool of_heights = false;
  // Which number of `part` it is; null: none of these.
  double HalfStep::*number = nullptr;      ///< of the half-step
  double HalfStepShape::*shape = nullptr;  ///< of its shape
  double Pose2::*move = nullptr;           ///< of a footstep's move
  bool factor = false;                     ///< it multiplies that number, instead of being it
  double unmoved = 0.0;  ///< the planned value, where it is no number of a half-step
  /// Where values are kept that algorithms name; null: among HomotopyParameters::others.
  std::vector<double> HomotopyParameters::*values = nullptr;
  /// Whether methods leave one of the parameters alone though they may move the family; null: none.
  bool (*stays)(const HalfStepSequence&, int index) = nullptr;
  double least;              ///< the least value that makes sense
  bool least_itself = true;  ///< whether `least` is allowed
  double most;               ///< the largest value; +∞ where the natural bound limits it
  bool always = false;       ///< whether methods may always move it
  /// The flag that lets methods move a family that algorithms name; null: among
  /// ParameterChoice::others.
  bool ParameterChoice::*chosen = nullptr;
  /// The flag's key in configs ("heights"), and what it means. "" where another family's key is for
  /// both.
  std::string_view key = "", key_meaning = "";
  std::array<ParameterBoundKey, 2> bound_keys = {};  ///< those without a key: there is none
  /// The range that methods choose from, given the numbers of `bounds()` and the planned value.
  /// Overlaps have their natural bounds besides.
  std::pair<double, double> (*range_of)(const ParameterFamilyTraits& row,
                                        const std::array<double, 2>& bounds, double planned);

  /// The number of a half-step that it is, or multiplies; null: none.
  double* number_of(HalfStep* half_step) const;

  std::string_view table() const;  ///< the CSV that holds the values, a row for each `of`
  int count(const HalfStepSequence& sequence) const;                  ///< how many a sequence has
  double planned(const HalfStepSequence& sequence, int index) const;  ///< the plan's value
  /// First and last half-step that the parameter belongs to; the last may be beyond the sequence.
  std::pair<int, int> half_steps(int index) const;
  /// Index of the parameter that a half-step carries. A parameter that joins two half-steps is
  /// carried by the first of them, so the index of the last half-step may not exist.
  int index_at(int half_step) const { return of == ParameterOf::kStep ? half_step / 2 : half_step; }
  /// True when the parameter bears on an instant only where all of its half-steps may be under way;
  /// false when it does where one of them may be.
  bool joins() const { return of == ParameterOf::kJunction; }
  /// The numbers that limit the range.
  constexpr std::span<const ParameterBoundKey> bounds() const {
    size_t count = 0;
    while (count < bound_keys.size() && !bound_keys[count].key.empty()) ++count;
    return std::span(bound_keys).first(count);
  }
  /// The range that methods choose from.
  std::pair<double, double> range(const ParameterChoice& choice, double planned_value) const {
    return range_of(*this, choice.bounds[family], planned_value);
  }
};

/// "junction", "step" or "half_step".
std::string_view Name(ParameterOf of);
/// What the values of a family are called in Python and on pages: "overlaps".
std::string PluralOf(const ParameterFamilyTraits& traits);
/// The row of a family.
const ParameterFamilyTraits& Traits(ParameterFamily family);

}  // namespace halfstep
