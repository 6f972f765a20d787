#include "experiments/config/key_tables.h"

#include <limits>

#include "wpg/files/number_text.h"
#include "wpg/files/suggestion.h"

namespace halfstep {
namespace {

using Kind = KeyDescription::Kind;

std::string BoundText(double bound) {
  if (bound < std::numeric_limits<double>::lowest()) return "−∞";
  if (bound > std::numeric_limits<double>::max()) return "∞";
  const bool whole = bound == static_cast<double>(static_cast<long>(bound));
  return whole ? std::to_string(static_cast<long>(bound)) : ShortestText(bound);
}

std::string InCode(const std::string& text) { return text.empty() ? "" : "`" + text + "`"; }

// A cell of a Markdown table.
std::string Escaped(const std::string& text) {
  std::string escaped;
  for (const char c : text) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
  return escaped;
}

void AddScreen(const std::vector<KeyDescription>& keys, std::string* text) {
  for (const KeyDescription& key : keys) {
    const std::string range = RangeText(key);
    *text += key.path + ": " + TypeText(key);
    if (key.required) {
      *text += ", required";
    } else if (!key.otherwise.empty()) {
      *text += ", else " + key.otherwise;
    } else if (!key.default_text.empty()) {
      *text += ", default " + key.default_text;
    }
    if (!range.empty()) *text += ", valid: " + range;
    *text += "\n";
    if (!key.meaning.empty()) *text += "    " + key.meaning + "\n";
    AddScreen(key.keys, text);
  }
}

void AddMarkdown(const std::vector<KeyDescription>& keys, std::string* text) {
  for (const KeyDescription& key : keys) {
    *text += KeyRow(key) + "\n";
    AddMarkdown(key.keys, text);
  }
}

}  // namespace

std::string TypeText(const KeyDescription& key) {
  const std::string unit = key.unit.empty() ? "" : " [" + key.unit + "]";
  const std::string count =
      key.min_items == key.max_items ? std::to_string(key.min_items) + " " : std::string();
  switch (key.kind) {
    case Kind::kNumber:
      return "number" + unit;
    case Kind::kOptionalNumber:
      return "number" + unit + " or none";
    case Kind::kInteger:
      return "integer" + unit;
    case Kind::kBoolean:
      return "true or false";
    case Kind::kText:
      return "text";
    case Kind::kTexts:
      return "list of texts";
    case Kind::kNumbers:
      return "list of " + count + "numbers" + unit;
    case Kind::kPoints:
      return "list of points" + unit;
    case Kind::kGroup:
      return "map";
    case Kind::kList:
      return "list of maps";
  }
  return "";
}

std::string RangeText(const KeyDescription& key) {
  switch (key.kind) {
    case Kind::kText:
    case Kind::kTexts:
      return key.listed_by.empty() ? Joined(key.choices) : InCode(key.listed_by);
    case Kind::kList:
      return BoundText(static_cast<double>(key.min_items)) + " … " +
             BoundText(static_cast<double>(key.max_items)) + " items";
    case Kind::kBoolean:
    case Kind::kGroup:
      return "";
    case Kind::kNumber:
    case Kind::kOptionalNumber:
    case Kind::kInteger:
    case Kind::kNumbers:
    case Kind::kPoints:
      break;
  }
  if (BoundText(key.min) == "−∞" && BoundText(key.max) == "∞") return "";
  return BoundText(key.min) + " … " + BoundText(key.max);
}

std::string KeyScreen(const std::vector<KeyDescription>& keys) {
  std::string text;
  AddScreen(keys, &text);
  return text;
}

std::string KeyRow(const KeyDescription& key) {
  const std::string range = key.choices.empty() || !key.listed_by.empty()
                                ? RangeText(key)
                                : "`" + Joined(key.choices) + "`";
  const std::string otherwise = key.required            ? "**required**"
                                : key.otherwise.empty() ? InCode(key.default_text)
                                                        : key.otherwise;
  return "| `" + key.path + "` | " + TypeText(key) + " | " + otherwise + " | " + Escaped(range) +
         " | " + Escaped(key.meaning) + " |";
}

std::string KeyMarkdown(const std::vector<KeyDescription>& keys) {
  std::string text = "| key | type [unit] | default | valid | meaning |\n|---|---|---|---|---|\n";
  AddMarkdown(keys, &text);
  return text;
}

}  // namespace halfstep
