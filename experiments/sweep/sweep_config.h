#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/config/experiment_config.h"
#include "experiments/tables/result_tables.h"
#include "wpg/files/fields.h"
#include "wpg/files/key_description.h"
#include "wpg/files/yaml_fields.h"

namespace halfstep {

/// The key of an axis that names other configs in place of the base config.
inline constexpr std::string_view kConfigKey = "config";

/// A key of the config and the values that it takes.
struct SweepAxis {
  std::string key;                    ///< dotted, as after --set
  std::vector<std::string> values{};  ///< YAML texts; reading fills them from a range
  /// A range in place of values, ends included; `step` or `count`.
  std::optional<double> from{}, to{}, step{};
  int count = 0;      ///< number of values of a range; 0: `step` gives it
  std::string zip{};  ///< axes with the same word advance together; "": by itself
};

/// A sweep as its YAML file says it (experiments/config.md).
struct SweepConfig {
  std::string name;              ///< default: the file's stem
  std::string config;            ///< path of the base config, relative to the file
  std::vector<SweepAxis> vary;   ///< every combination is a case
  std::string keep = "summary";  ///< or "all"
  std::string directory;         ///< of the file
  Toolbox tools = {};            ///< that its configs may name
  /// Columns that runs.csv has since a case runs `reference/lipm`, or has the group `replay`.
  SummaryParts parts;

  /// The base config as a path from the working directory.
  std::filesystem::path ConfigPath() const;
  /// The same of another config, whose path is relative to the base config.
  std::filesystem::path ConfigPath(const std::string& other) const;
};

/// One case of a sweep: the base config with some keys set.
struct SweepCase {
  std::string id;  ///< "0007-3f2a9c1b": its number from 1, and a hash of what it sets
  std::vector<YamlOverride> overrides;  ///< one an axis, in their order
};

/// Declares every key of a sweep file once.
void DeclareFields(Fields& fields, SweepConfig* config);
/// What DeclareFields says about each key.
std::vector<KeyDescription> SweepKeys();

/// The Cartesian product of the axes, the first one slowest; zipped axes count as one.
/// Precondition: zipped axes have as many values as each other.
std::vector<SweepCase> SweepCases(const SweepConfig& config);

/// How many there are.
size_t NumSweepCases(const SweepConfig& config);
/// One of them alone, at a cost that does not grow with their number. Precondition: it is there.
SweepCase SweepCaseAt(const SweepConfig& config, size_t index);

/// The config of a case: the base config, or the one that its key `config` names, with the other
/// keys set. Throws InputError.
ExperimentConfig LoadCase(const SweepConfig& config, const SweepCase& one);

/// "smoothing.margins.clearance_m=0.01 seed=3"
std::string OverrideText(const SweepCase& one);

/// Reads a sweep file strictly, ranges turned into values. With `check` the config of every case is
/// read too, of more than 5000 those of 5000 that are spread evenly. Throws InputError.
SweepConfig LoadSweep(const std::string& path, const std::vector<YamlOverride>& overrides,
                      bool check, Toolbox tools = {});
/// The same for a sweep file's text.
SweepConfig ParseSweep(const std::string& path, const std::string& text,
                       const std::vector<YamlOverride>& overrides, bool check, Toolbox tools = {});

}  // namespace halfstep
