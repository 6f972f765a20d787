#include "experiments/sweep/sweep_config.h"

#include <algorithm>
#include <cmath>

#include "experiments/config/data_folder.h"
#include "experiments/config/folder_name.h"
#include "wpg/files/input_error.h"
#include "wpg/files/number_text.h"
#include "wpg/files/sha256.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

constexpr size_t kMostCases = 100000;
constexpr size_t kMostChecked = 5000;  // their configs are read before anything runs

// Twelve digits: 0.3 and not 0.30000000000000004, 100000 and not 1e+05.
std::string ValueText(double value) { return Formatted("%.12g", value == 0.0 ? 0.0 : value); }

// What is wrong with a range, "" if nothing: the key and the sentence.
std::pair<const char*, std::string> MistakeInRange(const SweepAxis& axis) {
  if (!axis.from || !axis.to) {
    return {axis.from ? "to" : "from", "is missing (valid: values, or from and to)"};
  }
  if (*axis.from > *axis.to) return {"to", "is below from (valid: not below it)"};
  if (axis.step && axis.count > 0) return {"count", "there is a step as well (valid: either)"};
  const double steps = (*axis.to - *axis.from) / axis.step.value_or(1.0);
  if (axis.count == 0 && steps > static_cast<double>(kMostCases)) {
    return {"step", "makes too many values (valid: at most " + std::to_string(kMostCases) + ")"};
  }
  return {"", ""};
}

std::vector<std::string> ValuesOf(const SweepAxis& axis) {
  const double width = *axis.to - *axis.from;
  const double step = axis.count == 0  ? axis.step.value_or(1.0)
                      : axis.count > 1 ? width / (axis.count - 1)
                                       : 0.0;
  const int count =
      axis.count == 0 ? static_cast<int>(std::floor(width / step + 1e-9)) + 1 : axis.count;
  std::vector<std::string> values;
  for (int i = 0; i < count; ++i) values.push_back(ValueText(*axis.from + i * step));
  return values;
}

void DeclareAxis(Fields& fields, SweepAxis* axis) {
  fields.Text("key", &axis->key,
              {.meaning = "of the config, dotted as after `--set`; `config`: another config in its "
                          "place, by its path from the folder of `config`",
               .required = true});
  if (axis->key == "name" || axis->key == "output" || axis->key.starts_with("output.directory")) {
    fields.Complain("key", Quote(axis->key) + " is what tells the cases apart (valid: other keys)");
  }
  fields.Texts("values", &axis->values,
               {.meaning = "that it takes, each as after `--set KEY=`: a list or a map in quotes"});
  fields.OptionalNumber("from", &axis->from, {.meaning = "first value, in place of `values`"});
  fields.OptionalNumber("to", &axis->to, {.meaning = "last value"});
  fields.OptionalNumber("step", &axis->step,
                        {.meaning = "from value to value; none: 1", .min = 1e-12});
  fields.Integer("count", &axis->count,
                 {.meaning = "of values, evenly spaced, in place of `step`; 0: by `step`",
                  .min = 0,
                  .max = static_cast<double>(kMostCases)});
  fields.Text("zip", &axis->zip,
              {.meaning = "axes with the same word advance together", .otherwise = "by itself"});
  const bool range = axis->from || axis->to || axis->step || axis->count > 0;
  for (const std::string& value : axis->values) {
    if (!LooksLikeFormula(value) || ParseNumber(value).kind == NumberText::Kind::kNumber) continue;
    fields.Complain("values",
                    Quote(value) +
                        " would be taken for a formula where a spreadsheet shows runs.csv "
                        "(valid: a number, a text that begins otherwise, ./ before a path)");
  }
  if (!axis->values.empty()) {
    if (range) fields.Complain("values", "there is a range as well (valid: either)");
    return;
  }
  const auto [key, mistake] = MistakeInRange(*axis);
  if (mistake.empty()) {
    axis->values = ValuesOf(*axis);
    axis->from = axis->to = axis->step = std::nullopt;
    axis->count = 0;
  } else {
    fields.Complain(range ? key : "values",
                    range ? mistake : "there are none (valid: values, or from and to)");
  }
}

// What is wrong with the axes taken together, "" if nothing.
std::string MistakeInAxes(const std::vector<SweepAxis>& axes) {
  if (axes.empty()) return "there are none (valid: at least one key)";
  double cases = 1.0;
  for (auto axis = axes.begin(); axis != axes.end(); ++axis) {
    const auto same = [&](const SweepAxis& other) { return other.key == axis->key; };
    if (std::find_if(axes.begin(), axis, same) != axis) {
      return Quote(axis->key) + " is there twice (valid: each key once)";
    }
    const auto zipped = [&](const SweepAxis& other) {
      return !axis->zip.empty() && other.zip == axis->zip;
    };
    const auto first = std::find_if(axes.begin(), axis, zipped);
    if (first == axis) {
      cases *= static_cast<double>(axis->values.size());
    } else if (first->values.size() != axis->values.size()) {
      return "zipped " + Quote(axis->zip) + ": " + std::to_string(first->values.size()) + " and " +
             std::to_string(axis->values.size()) + " values (valid: as many)";
    }
  }
  return cases <= static_cast<double>(kMostCases)
             ? ""
             : "makes " + ValueText(cases) + " cases (valid: at most " +
                   std::to_string(kMostCases) + ")";
}

// Indices of the cases whose configs are read before anything runs: of a large sweep some that are
// spread evenly, by multiples of the golden ratio, so that they meet all values of short axes.
std::vector<size_t> CheckedCases(size_t cases) {
  std::vector<size_t> checked;
  for (size_t i = 0; i < std::min(cases, kMostChecked); ++i) {
    const double turn = static_cast<double>(i) * 0.6180339887498949;
    checked.push_back(cases <= kMostChecked ? i
                                            : static_cast<size_t>((turn - std::floor(turn)) *
                                                                  static_cast<double>(cases)));
  }
  if (cases > 0) checked.push_back(cases - 1);
  return checked;
}

// What is wrong with the config of the first case that is read and cannot be.
std::string MistakeInCases(const SweepConfig& config) {
  for (const size_t index : CheckedCases(NumSweepCases(config))) {
    const SweepCase one = SweepCaseAt(config, index);
    try {
      LoadCase(config, one);
    } catch (const InputError& error) {
      return "case " + one.id + ": " + error.complaints().front();
    }
  }
  return "";
}

// What its first case, or an axis, says of the columns of runs.csv.
SummaryParts PartsOf(const SweepConfig& config) {
  constexpr char kBound[] = "reference/lipm";
  SummaryParts parts;
  for (const SweepAxis& axis : config.vary) {
    if (axis.values.empty()) return {};  // a mistake that is told elsewhere
    parts.replay = parts.replay || axis.key.starts_with("replay.");
    for (const std::string& value : axis.values) {
      parts.bound = parts.bound || value.find(kBound) != std::string::npos;
    }
  }
  try {
    const ExperimentConfig first = LoadCase(config, SweepCaseAt(config, 0));
    const std::vector<std::string>& methods = first.smoothing.methods;
    parts.bound = parts.bound || std::ranges::find(methods, kBound) != methods.end();
    parts.replay = parts.replay || first.has_replay;
  } catch (const InputError&) {  // which is told where the case is run
  }
  return parts;
}

// The first axis that advances together with this one; itself when it is that.
size_t FirstOfZip(const std::vector<SweepAxis>& axes, size_t axis) {
  for (size_t k = 0; k < axis; ++k) {
    if (!axes[axis].zip.empty() && axes[k].zip == axes[axis].zip) return k;
  }
  return axis;
}

}  // namespace

std::filesystem::path SweepConfig::ConfigPath() const {
  return (std::filesystem::path(directory) / config).lexically_normal();
}

std::filesystem::path SweepConfig::ConfigPath(const std::string& other) const {
  return (ConfigPath().parent_path() / other).lexically_normal();
}

ExperimentConfig LoadCase(const SweepConfig& config, const SweepCase& one) {
  std::filesystem::path path = config.ConfigPath();
  std::vector<YamlOverride> overrides;
  for (const YamlOverride& set : one.overrides) {
    if (set.key == kConfigKey) {
      path = config.ConfigPath(set.value);
    } else {
      overrides.push_back(set);
    }
  }
  return LoadConfig(path.string(), overrides, config.tools);
}

void DeclareFields(Fields& fields, SweepConfig* c) {
  fields.Text("name", &c->name,
              {.meaning = "of the sweep and its folder; as of a config",
               .otherwise = "the file's name without extension"});
  CheckName(fields, c->name);
  fields.Text("config", &c->config,
              {.meaning = "path of the config that is varied, relative to the sweep file",
               .required = true});
  fields.List("vary",
              {.meaning = "the keys that vary; the cases are all combinations, the first key "
                          "varies slowest",
               .required = true,
               .max_items = 100},
              &c->vary, DeclareAxis);
  fields.Text("keep", &c->keep,
              {.meaning = "of each case: its rows and resolved config, or its whole run folder",
               .choices = {"summary", "all"}});
}

std::vector<KeyDescription> SweepKeys() {
  SweepConfig config;
  return DescribeKeys([&config](Fields& fields) { DeclareFields(fields, &config); });
}

size_t NumSweepCases(const SweepConfig& config) {
  size_t cases = 1;
  for (size_t k = 0; k < config.vary.size(); ++k) {
    if (FirstOfZip(config.vary, k) == k) cases *= config.vary[k].values.size();
  }
  return cases;
}

SweepCase SweepCaseAt(const SweepConfig& config, size_t index) {
  SweepCase one;
  one.overrides.resize(config.vary.size());
  std::vector<size_t> at(config.vary.size());
  size_t rest = index;
  for (size_t k = config.vary.size(); k-- > 0;) {  // the last key varies fastest
    if (FirstOfZip(config.vary, k) != k) continue;
    at[k] = rest % config.vary[k].values.size();
    rest /= config.vary[k].values.size();
  }
  for (size_t k = 0; k < config.vary.size(); ++k) {
    const SweepAxis& axis = config.vary[k];
    one.overrides[k] = {axis.key, axis.values[at[FirstOfZip(config.vary, k)]]};
  }
  one.id = Formatted("%04zu-", index + 1) + Sha256(OverrideText(one)).substr(0, 8);
  return one;
}

std::vector<SweepCase> SweepCases(const SweepConfig& config) {
  std::vector<SweepCase> cases(NumSweepCases(config));
  for (size_t i = 0; i < cases.size(); ++i) cases[i] = SweepCaseAt(config, i);
  return cases;
}

std::string OverrideText(const SweepCase& one) {
  std::string text;
  for (const YamlOverride& set : one.overrides) {
    text += (text.empty() ? "" : " ") + set.key + "=" + set.value;
  }
  return text;
}

SweepConfig LoadSweep(const std::string& path, const std::vector<YamlOverride>& overrides,
                      bool check, Toolbox tools) {
  const std::string file = FileOrShipped(path, "sweeps").string();
  return ParseSweep(file, ReadYamlFile(file), overrides, check, std::move(tools));
}

SweepConfig ParseSweep(const std::string& path, const std::string& text,
                       const std::vector<YamlOverride>& overrides, bool check, Toolbox tools) {
  const std::filesystem::path file(path);
  SweepConfig config;
  config.name = file.stem().string();
  config.tools = std::move(tools);
  ReadYamlText(text, path, file.parent_path().string(), overrides, [&](Fields& fields) {
    DeclareFields(fields, &config);
    config.directory = fields.directory();
    std::error_code ignored;
    const bool there = std::filesystem::is_regular_file(config.ConfigPath(), ignored);
    if (!there) {
      fields.Complain("config", "no such file: " + Quote(config.config) +
                                    " (valid: path of a config, relative to this file)");
    }
    std::string mistake = MistakeInAxes(config.vary);
    if (mistake.empty() && there && check) mistake = MistakeInCases(config);
    if (!mistake.empty()) {
      fields.Complain("vary", mistake);
    } else if (there) {
      config.parts = PartsOf(config);
    }
  });
  return config;
}

}  // namespace halfstep
