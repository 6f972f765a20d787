#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <unordered_map>

#include "wpg/files/text.h"
#include "wpg/files/yaml_node.h"

namespace halfstep {
namespace {

constexpr int kMostLevels = 64;
constexpr size_t kBytesOfANode = 256;  // longer text counts as several nodes

// Builds the tree from yaml-cpp's events: its own Node drops duplicate keys and lets aliases loop.
class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(const std::string& override_key, const YamlLimits& limits, YamlComplaints* complaints)
      : override_key_(override_key), limits_(limits), complaints_(complaints) {}

  bool has_document() const { return has_document_; }
  YamlNode TakeRoot() { return std::move(root_); }

  YamlPlace PlaceOf(const YAML::Mark& mark) const {
    if (!override_key_.empty()) return {0, 0, override_key_};
    return mark.is_null() ? YamlPlace{} : YamlPlace{mark.line + 1, mark.column + 1, ""};
  }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (has_document_) {
      complaints_->Fail(PlaceOf(mark), "", "a second document begins here (valid: one document)");
    }
    has_document_ = true;
  }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    Complete({.kind = YamlNode::Kind::kNull, .place = PlaceOf(mark)}, anchor);
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& text) override {
    YamlNode node{.kind = YamlNode::Kind::kScalar, .text = text, .place = PlaceOf(mark)};
    node.quoted = tag == "!";
    node.weight = 1 + text.size() / kBytesOfANode;
    Charge(node, node.weight);
    if (!node.quoted) RefuseTag(tag, node);
    Complete(std::move(node), anchor);
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = anchored_.find(anchor);
    if (found == anchored_.end()) {
      complaints_->Fail(PlaceOf(mark), Path(), "an alias inside the value that it stands for");
    }
    ChargeCopy({.place = PlaceOf(mark)}, found->second.weight);
    YamlNode node = found->second;
    node.place = PlaceOf(mark);
    Complete(std::move(node), 0);
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value style) override {
    Open(YamlNode::Kind::kList, mark, tag, anchor, style);
  }
  void OnSequenceEnd() override { Close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value style) override {
    Open(YamlNode::Kind::kMap, mark, tag, anchor, style);
  }
  void OnMapEnd() override { Close(); }

 private:
  // A list or map whose end has not been seen.
  struct Level {
    YamlNode node;
    YAML::anchor_t anchor = 0;
    bool on_later_line = false;                // the value of a key, in block style
    bool has_key = false, drop_value = false;  // maps: a key waits for its value
    std::string key;
    YamlPlace key_place;
    std::unordered_map<std::string, int> key_lines;  // of keys seen
  };

  void Open(YamlNode::Kind kind, const YAML::Mark& mark, const std::string& tag,
            YAML::anchor_t anchor, YAML::EmitterStyle::value style) {
    Level level;
    level.node = {.kind = kind, .place = PlaceOf(mark)};
    level.anchor = anchor;
    level.on_later_line = style == YAML::EmitterStyle::Block;
    Charge(level.node, 1);
    CheckHeight(level.node, static_cast<int>(open_.size()) + 1);
    RefuseTag(tag, level.node);
    open_.push_back(std::move(level));
  }

  void Close() {
    Level level = std::move(open_.back());
    open_.pop_back();
    if (level.on_later_line && !open_.empty() && open_.back().has_key) {
      level.node.place = open_.back().key_place;
    }
    for (const YamlNode& item : level.node.items) {
      level.node.height = std::max(level.node.height, item.height + 1);
      level.node.weight += item.weight;
    }
    Complete(std::move(level.node), level.anchor);
  }

  // Hands a complete value to the list or map that it belongs to.
  void Complete(YamlNode node, YAML::anchor_t anchor) {
    if (anchor != 0) {
      ChargeCopy(node, node.weight);
      anchored_[anchor] = node;
    }
    if (open_.empty()) {
      root_ = std::move(node);
      return;
    }
    CheckHeight(node, static_cast<int>(open_.size()) + node.height);
    Level& parent = open_.back();
    if (parent.node.kind == YamlNode::Kind::kList) {
      parent.node.items.push_back(std::move(node));
    } else if (!parent.has_key) {
      TakeKey(node, &parent);
    } else {
      if (node.kind == YamlNode::Kind::kNull) node.place = parent.key_place;
      parent.has_key = false;
      if (parent.drop_value) return;
      node.key = std::move(parent.key);
      node.key_place = parent.key_place;
      parent.node.items.push_back(std::move(node));
    }
  }

  void TakeKey(const YamlNode& node, Level* map) {
    const bool usable = node.kind == YamlNode::Kind::kScalar && !node.text.empty();
    if (!usable)
      complaints_->Add(node.place, Path(), "a key must be a word, not " + Describe(node));
    map->has_key = true;
    map->key = node.text;
    map->key_place = node.place;
    const auto [first, is_new] = map->key_lines.emplace(node.text, node.place.line);
    map->drop_value = !usable || !is_new;
    if (!usable || is_new) return;
    std::string what = "duplicate key";
    if (first->second > 0) what += " (first given in line " + std::to_string(first->second) + ")";
    complaints_->Add(node.place, Path(), what);
  }

  void RefuseTag(const std::string& tag, const YamlNode& node) {
    if (tag.empty() || tag == "?") return;
    complaints_->Add(node.place, Path(), "a tag: " + Quote(tag) + " (valid: no tags)");
  }

  void Charge(const YamlNode& node, size_t weight) {
    nodes_ += weight;
    if (nodes_ > limits_.values) FailAt(node, limits_.values);
  }

  [[noreturn]] void FailAt(const YamlNode& node, size_t most) const {
    complaints_->Fail(
        node.place, Path(),
        "too much content, aliases expanded (valid: at most " + std::to_string(most) + " values)");
  }

  void ChargeCopy(const YamlNode& node, size_t weight) {
    copied_ += weight;
    if (copied_ > limits_.aliased) FailAt(node, limits_.aliased);
    Charge(node, weight);
  }

  void CheckHeight(const YamlNode& node, int levels) {
    if (levels <= kMostLevels) return;
    complaints_->Fail(
        node.place, "",
        "nested too deeply (valid: at most " + std::to_string(kMostLevels) + " levels)");
  }

  // Dotted path of the value (or key) that comes next.
  std::string Path() const {
    std::string path;
    for (const Level& level : open_) {
      if (level.node.kind == YamlNode::Kind::kList) {
        path += "[" + std::to_string(level.node.items.size()) + "]";
      } else if (level.has_key) {
        path = KeyPath(path, level.key);
      }
    }
    return path;
  }

  const std::string override_key_;
  const YamlLimits limits_;
  YamlComplaints* const complaints_;
  bool has_document_ = false;
  YamlNode root_;
  std::vector<Level> open_;
  std::map<YAML::anchor_t, YamlNode> anchored_;
  size_t nodes_ = 0, copied_ = 0;
};

YamlPlace PlaceOfByte(const std::string& text, size_t offset, const std::string& override_key) {
  if (!override_key.empty()) return {0, 0, override_key};
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(offset);
  const size_t line_start = offset == 0 ? std::string::npos : text.rfind('\n', offset - 1);
  const size_t column = line_start == std::string::npos ? offset : offset - line_start - 1;
  return {static_cast<int>(std::count(text.begin(), end, '\n')) + 1, static_cast<int>(column) + 1,
          ""};
}

// What yaml-cpp must not see: bytes that it guesses about, and so many open brackets that its
// queue of undecided tokens would fill the memory (about 240 bytes each, before the first event).
void CheckBytes(const std::string& text, const std::string& override_key,
                YamlComplaints* complaints) {
  constexpr int kMostOpenBrackets = 1000;
  const size_t invalid = FindInvalidUtf8(text);
  if (invalid != std::string::npos) {
    complaints->Fail(PlaceOfByte(text, invalid, override_key), "",
                     "not UTF-8 text: byte " + Quote(text.substr(invalid, 1)));
  }
  int open_brackets = 0;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\0') {
      complaints->Fail(PlaceOfByte(text, i, override_key), "", "not text: a NUL byte");
    }
    if (c == '[' || c == '{') ++open_brackets;
    if ((c == ']' || c == '}') && open_brackets > 0) --open_brackets;
    if (open_brackets > kMostOpenBrackets) {
      complaints->Fail(
          PlaceOfByte(text, i, override_key), "",
          "nested too deeply (valid: at most " + std::to_string(kMostLevels) + " levels)");
    }
  }
}

// Whether a line, from 0, begins with white space that has a tab.
bool IsIndentedByTab(const std::string& text, int line) {
  size_t begin = 0;
  for (; line > 0 && begin != std::string::npos; --line) {
    begin = text.find('\n', begin);
    if (begin != std::string::npos) ++begin;
  }
  if (begin == std::string::npos) return false;
  return text.substr(begin, text.find_first_not_of(" \t", begin) - begin).find('\t') !=
         std::string::npos;
}

}  // namespace

YamlNode ParseYaml(const std::string& text, const std::string& override_key,
                   YamlComplaints* complaints, const YamlLimits& limits) {
  CheckBytes(text, override_key, complaints);
  TreeBuilder builder(override_key, limits, complaints);
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const YAML::Exception& error) {
    complaints->Fail(builder.PlaceOf(error.mark), "",
                     "broken YAML: " + error.msg +
                         (IsIndentedByTab(text, error.mark.line) ? " (a tab; valid: spaces)" : ""));
  }
  if (!builder.has_document() && override_key.empty()) {
    complaints->Fail({1, 1, ""}, "", "the document is empty (valid: a map of keys)");
  }
  return builder.TakeRoot();
}

}  // namespace halfstep
