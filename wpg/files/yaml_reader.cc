#include "wpg/files/yaml_reader.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "wpg/check.h"
#include "wpg/files/input_error.h"
#include "wpg/files/number_text.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

using NodeKind = YamlNode::Kind;

std::string WithUnit(std::string text, const NumberSpec& spec) {
  return spec.unit[0] == '\0' ? text : std::move(text) + " " + spec.unit;
}

// "(valid: …)" of a number, an integer, a text.
std::string ValidNumbers(const NumberSpec& spec, const std::string& any = "a finite number") {
  const bool has_min = std::isfinite(spec.min), has_max = std::isfinite(spec.max);
  if (!has_min && !has_max) {
    return spec.unit[0] == '\0' ? any : any + " [" + spec.unit + "]";
  }
  if (!has_max) return WithUnit("≥ " + ShortestText(spec.min), spec);
  if (!has_min) return WithUnit("≤ " + ShortestText(spec.max), spec);
  return WithUnit(ShortestText(spec.min) + " … " + ShortestText(spec.max), spec);
}

std::string ValidText(const TextSpec& spec) {
  return spec.choices.empty() ? "text" : Joined(spec.choices);
}

// What is wrong with a text as a number, "" if nothing.
std::string Mistake(const YamlNode& node, const NumberText& number) {
  if (node.kind != NodeKind::kScalar) return "not a number: " + Describe(node);
  if (node.quoted) return "not a number but text in quotes: " + Describe(node);
  switch (number.kind) {
    case NumberText::Kind::kNotANumber:
      return "not a number: " + Describe(node);
    case NumberText::Kind::kNotFinite:
      return "not a finite number: " + Describe(node);
    case NumberText::Kind::kLeadingZero:
      return "not a decimal number (leading zero): " + Describe(node);
    case NumberText::Kind::kNumber:
      break;
  }
  return "";
}

// " (valid: …)" behind a mistake of a number, with a word on a decimal comma.
std::string ValidWith(const YamlNode& node, const std::string& valid) {
  const std::string hint = node.kind == NodeKind::kScalar ? PointNeeded(node.text) : "";
  return " (" + (hint.empty() ? "" : hint + " ") + "valid: " + valid + ")";
}

}  // namespace

YamlReader::YamlReader(const YamlNode* map, std::string path, std::string directory,
                       YamlComplaints* complaints)
    : map_(map),
      path_(std::move(path)),
      directory_(std::move(directory)),
      complaints_(complaints) {}

void YamlReader::Run(const std::function<void(Fields&)>& declare) {
  declare(*this);
  if (map_ == nullptr) return;
  for (const YamlNode& item : map_->items) {
    if (std::find(known_.begin(), known_.end(), item.key) != known_.end()) continue;
    // "x_m: 0,25" in a map in braces is the key "25".
    const bool is_number = item.key.find_first_not_of("0123456789") == std::string::npos;
    complaints_->Add(
        item.key_place, KeyPath(path_, item.key),
        "unknown key" + (is_number ? " (behind a decimal comma? valid: a decimal point)"
                                   : Suggestion(item.key, known_)));
  }
}

void YamlReader::Renamed(const char* old_key, const char* new_key) {
  Misplaced(old_key, std::string("has another name now (valid: ") + new_key + ")");
}

void YamlReader::Misplaced(const char* key, const std::string& what) {
  const YamlNode* const node = map_ == nullptr ? nullptr : map_->Find(key);
  if (node == nullptr) return;
  known_.emplace_back(key);
  complaints_->Add(node->key_place, KeyPath(path_, key), what);
}

std::vector<std::string> YamlReader::Keys() const {
  std::vector<std::string> keys;
  if (map_ == nullptr) return keys;
  for (const YamlNode& item : map_->items) keys.push_back(item.key);
  return keys;
}

const YamlNode* YamlReader::Take(const char* key, bool required, const std::string& valid) {
  HALFSTEP_CHECK(std::find(known_.begin(), known_.end(), key) == known_.end(),
                 "key '" << key << "' of '" << path_ << "' is declared twice");
  known_.emplace_back(key);
  if (map_ == nullptr) return nullptr;
  const YamlNode* const node = map_->Find(key);
  if (node == nullptr && required) {
    complaints_->Add(map_->place, KeyPath(path_, key),
                     "a required key is missing (valid: " + valid + ")");
  }
  return node;
}

std::optional<double> YamlReader::ToNumber(const YamlNode& node, const std::string& path,
                                           const NumberSpec& spec, bool degrees) {
  const NumberText number = ParseNumber(node.text);
  std::string mistake = Mistake(node, number);
  if (mistake.empty() && !(number.value >= spec.min && number.value <= spec.max)) {
    mistake = node.text + " is out of range";
  }
  if (!mistake.empty()) {
    complaints_->Add(node.place, path, mistake + ValidWith(node, ValidNumbers(spec)));
    return std::nullopt;
  }
  return degrees ? DegreesToRadians(number.extended) : number.value;
}

std::optional<std::string> YamlReader::ToText(const YamlNode& node, const std::string& path,
                                              const TextSpec& spec) {
  std::string mistake;
  if (node.kind != NodeKind::kScalar) {
    mistake = "not text: " + Describe(node) + " (valid: " + ValidText(spec) + ")";
  } else if (HasControlCharacter(node.text)) {
    mistake = "a control character in " + Describe(node) + " (valid: text of one line)";
  } else if (!spec.choices.empty() &&
             std::find(spec.choices.begin(), spec.choices.end(), node.text) == spec.choices.end()) {
    mistake = "none of the choices: " + Describe(node) + Suggestion(node.text, spec.choices);
  }
  if (mistake.empty()) return node.text;
  complaints_->Add(node.place, path, mistake);
  return std::nullopt;
}

void YamlReader::Number(const char* key, double* value, const NumberSpec& spec) {
  const YamlNode* const node = Take(key, spec.required, ValidNumbers(spec));
  if (node == nullptr) return;
  *value = ToNumber(*node, KeyPath(path_, key), spec, IsDegrees(key)).value_or(*value);
}

void YamlReader::OptionalNumber(const char* key, std::optional<double>* value,
                                const NumberSpec& spec) {
  const YamlNode* const node = Take(key, spec.required, ValidNumbers(spec) + ", or none");
  if (node == nullptr) return;
  if (node->kind == NodeKind::kNull || (!node->quoted && node->text == "none")) {
    value->reset();
  } else if (const auto number = ToNumber(*node, KeyPath(path_, key), spec, IsDegrees(key))) {
    *value = number;
  }
}

void YamlReader::Integer(const char* key, int* value, const NumberSpec& spec) {
  constexpr double kMin = std::numeric_limits<int>::min(), kMax = std::numeric_limits<int>::max();
  NumberSpec bounded = spec;
  bounded.min = std::max(spec.min, kMin);
  bounded.max = std::min(spec.max, kMax);
  const bool unbounded = bounded.min == kMin && bounded.max == kMax;
  const std::string valid = unbounded ? "an integer" : "an integer, " + ValidNumbers(bounded);
  const YamlNode* const node = Take(key, spec.required, valid);
  if (node == nullptr) return;
  const NumberText number = ParseNumber(node->text);
  std::string mistake = Mistake(*node, number);
  if (mistake.empty() && node->text.find_first_of(".eE") != std::string::npos) {
    mistake = "not an integer: " + Describe(*node);
  } else if (mistake.empty() && !(number.value >= bounded.min && number.value <= bounded.max)) {
    mistake = node->text + " is out of range";
  }
  if (mistake.empty()) {
    *value = static_cast<int>(number.value);
  } else {
    complaints_->Add(node->place, KeyPath(path_, key), mistake + " (valid: " + valid + ")");
  }
}

void YamlReader::Boolean(const char* key, bool* value, const TextSpec& spec) {
  const YamlNode* const node = Take(key, spec.required, "true, false");
  if (node == nullptr) return;
  const bool plain = node->kind == NodeKind::kScalar && !node->quoted;
  if (plain && (node->text == "true" || node->text == "false")) {
    *value = node->text == "true";
  } else {
    complaints_->Add(node->place, KeyPath(path_, key),
                     "neither true nor false: " + Describe(*node) + " (valid: true, false)");
  }
}

void YamlReader::Text(const char* key, std::string* value, const TextSpec& spec) {
  const YamlNode* const node = Take(key, spec.required, ValidText(spec));
  if (node == nullptr) return;
  *value = ToText(*node, KeyPath(path_, key), spec).value_or(*value);
}

}  // namespace halfstep
