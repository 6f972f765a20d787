#pragma once

#include <array>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "wpg/motion/half_step_sequence.h"

namespace halfstep {

struct HomotopyParameters;

/// The families of parameters that a point of the smoothing homotopy is made of.
enum class ParameterFamily {
  kOverlap,      ///< Δ of a junction
  kHeightScale,  ///< η of a step
  kDuration,     ///< T of a half-step
};
inline constexpr int kNumParameterFamilies = 3;

/// What a method may move besides overlaps, and how far.
struct ParameterChoice {
  bool heights = false;    ///< η
  bool durations = false;  ///< T
  double least_height_scale = 0.2;
  double least_duration = 0.5;  ///< as a fraction of the planned one
  double most_duration = 1.5;   ///< as a fraction of the planned one
};

/// A number of ParameterChoice, as configs name it.
struct ParameterBoundKey {
  std::string_view key;
  std::string_view meaning;
  double ParameterChoice::*value;
  double min, max;
};

/// All that programs, proofs, files and messages need to know about a family. What the parameters
/// do to a walk is SuperposedWalk's, with its Sensitivities.
struct ParameterFamilyTraits {
  std::string_view name;     ///< in YAML and messages: "overlap"
  std::string_view unit;     ///< "s"; "": a number
  std::string_view table;    ///< the CSV that holds the values, one row a junction or half-step …
  std::string_view column;   ///< … and its column there,
  int rank;                  ///< after those of the same table with a smaller one
  std::string_view meaning;  ///< one line, for the column and for messages
  std::vector<double> HomotopyParameters::*values;
  int (*count)(const HalfStepSequence&);
  double (*planned)(const HalfStepSequence&, int index);
  /// First and last half-step that the parameter belongs to.
  std::pair<int, int> (*half_steps)(int index);
  /// The one of the family that a half-step carries, of those that join the one with its successor;
  /// the last half-step's may not exist.
  int (*index_at)(int half_step);
  /// It bears on an instant only where all of its half-steps may be under way; else where one may.
  bool joins;
  /// Least value that makes sense, and whether it is itself one.
  double least;
  bool least_itself;
  /// The flag that lets methods move the family, its key in configs ("heights") and what that
  /// means; null: they always may.
  bool ParameterChoice::*chosen;
  std::string_view key, key_meaning;
  std::span<const ParameterBoundKey> bounds;
  /// Between which values methods choose, given the planned one. Overlaps have their natural bounds
  /// besides.
  std::pair<double, double> (*range)(const ParameterChoice&, double planned);
};

/// The traits of a family. A family is a row of the table behind it, a member of
/// HomotopyParameters, and what SuperposedWalk makes of it.
const ParameterFamilyTraits& Traits(ParameterFamily family);

/// Every family, in the order of programs and files.
constexpr std::array<ParameterFamily, kNumParameterFamilies> AllParameterFamilies() {
  return {ParameterFamily::kOverlap, ParameterFamily::kHeightScale, ParameterFamily::kDuration};
}

}  // namespace halfstep
