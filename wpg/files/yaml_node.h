#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace halfstep {

/// Where a value stands: line and column (in bytes) count from 1, 0 means unknown. A value given on
/// the command line has its override key instead.
struct YamlPlace {
  int line = 0;                ///< from 1
  int column = 0;              ///< from 1, in bytes
  std::string override_key{};  ///< of --set; "": the value is in the file
};

/// A YAML value as plain data, aliases expanded.
struct YamlNode {
  /// What a value is.
  enum class Kind { kNull, kScalar, kList, kMap };
  Kind kind = Kind::kNull;  ///< of this value
  std::string text{};       ///< of a scalar.
  bool quoted = false;      ///< scalar in quotes or a block scalar: text whatever it looks like.
  std::vector<YamlNode> items{};  ///< of a list, or the values of a map in the order of the text.
  std::string key{};              ///< of a map's value.
  YamlPlace key_place{};          ///< of the key in the text
  YamlPlace place{};  ///< of the value; of the key where the value begins on a later line.
  int height = 0;     ///< levels of nodes below.
  size_t weight = 1;  ///< what the subtree costs in the budget of nodes.

  /// The value of a map's key, or nullptr.
  const YamlNode* Find(const std::string& wanted) const;
  YamlNode* Find(const std::string& wanted);  ///< the same, to be changed
};

/// Complaints about one YAML text, gathered in any order, thrown in the order of the text.
class YamlComplaints {
 public:
  /// `name` is the file's, for complaints.
  explicit YamlComplaints(std::string name) : name_(std::move(name)) {}

  /// What is wrong with the value of a key.
  void Add(const YamlPlace& place, const std::string& key, const std::string& what);
  /// Whether `key` or anything below it has been complained about.
  bool About(const std::string& key) const;
  /// Throws InputError when there is any complaint (at most 100 lines, then their number).
  void ThrowIfAny() const;
  /// Adds the complaint and throws.
  [[noreturn]] void Fail(const YamlPlace& place, const std::string& key, const std::string& what);

 private:
  struct Complaint {
    YamlPlace place;
    std::string key;
    std::string what;
  };
  std::string name_;
  std::vector<Complaint> complaints_;
};

/// How much YAML may be: what is beyond would take memory and time out of proportion to its use.
struct YamlLimits {
  std::size_t bytes = std::size_t{4} << 20;  ///< of a file
  std::size_t values = 200'000;              ///< nodes, aliases expanded, long text by its length
  std::size_t aliased = 200'000;             ///< of these, what stands for aliases and anchors
};

/// Parses one YAML document. Duplicate keys, keys that are no plain text and tags are complaints.
/// Fails at once on what leaves no tree to read: broken YAML, more than one document, no document,
/// bytes that are not UTF-8, an alias inside its own value, nesting beyond 64 levels, more values
/// than the limit.
/// `override_key` is the place of every node when not empty; then no document is a null value.
YamlNode ParseYaml(const std::string& text, const std::string& override_key,
                   YamlComplaints* complaints, const YamlLimits& limits = {});

/// Replaces or inserts the value of a dotted key (list items by index); new maps are made where
/// parents are missing. An impossible key is a complaint.
void OverrideYaml(const std::string& dotted_key, const std::string& value_text, YamlNode* root,
                  YamlComplaints* complaints);

/// Removes a dotted key of maps, where it is there.
void RemoveYaml(const std::string& dotted_key, YamlNode* root);

/// "a map", "a list", "nothing" or the quoted text.
std::string Describe(const YamlNode& node);

/// Dotted path of a key of the group at `parent` ("" for the document), fit for a complaint.
std::string KeyPath(const std::string& parent, const std::string& key);

}  // namespace halfstep
