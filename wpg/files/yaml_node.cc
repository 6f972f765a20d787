#include "wpg/files/yaml_node.h"

#include <algorithm>
#include <limits>

#include "wpg/files/input_error.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

// Overrides come after everything that has a line.
std::pair<int, int> Order(const YamlPlace& place) {
  if (!place.override_key.empty()) return {std::numeric_limits<int>::max(), 0};
  return {place.line, place.column};
}

}  // namespace

const YamlNode* YamlNode::Find(const std::string& wanted) const {
  const auto found = std::find_if(items.begin(), items.end(),
                                  [&wanted](const YamlNode& item) { return item.key == wanted; });
  return found == items.end() ? nullptr : &*found;
}

YamlNode* YamlNode::Find(const std::string& wanted) {
  return const_cast<YamlNode*>(std::as_const(*this).Find(wanted));
}

void YamlComplaints::Add(const YamlPlace& place, const std::string& key, const std::string& what) {
  complaints_.push_back({place, key, what});
}

bool YamlComplaints::About(const std::string& key) const {
  return std::any_of(complaints_.begin(), complaints_.end(), [&key](const Complaint& complaint) {
    if (!complaint.key.starts_with(key)) return false;
    if (complaint.key.size() == key.size()) return true;
    const char next = complaint.key[key.size()];
    return next == '.' || next == '[';
  });
}

void YamlComplaints::ThrowIfAny() const {
  constexpr size_t kMostLines = 100;
  std::vector<Complaint> sorted = complaints_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Complaint& a, const Complaint& b) {
    return Order(a.place) < Order(b.place);
  });
  Complaints complaints;
  for (size_t i = 0; i < std::min(sorted.size(), kMostLines); ++i) {
    const auto& [place, key, what] = sorted[i];
    if (place.override_key.empty()) {
      complaints.Add(name_, place.line, place.column, key, what);
    } else {
      const std::string source = "--set " + place.override_key;
      complaints.Add(source, 0, 0, key == place.override_key ? "" : key, what);
    }
  }
  if (sorted.size() > kMostLines) {
    complaints.Add(name_, 0, 0, "",
                   std::to_string(sorted.size() - kMostLines) + " more complaints left out");
  }
  complaints.ThrowIfAny();
}

void YamlComplaints::Fail(const YamlPlace& place, const std::string& key, const std::string& what) {
  Add(place, key, what);
  ThrowIfAny();
  throw InputError({what});  // not reached: there is a complaint
}

std::string Describe(const YamlNode& node) {
  switch (node.kind) {
    case YamlNode::Kind::kNull:
      return "nothing";
    case YamlNode::Kind::kList:
      return "a list";
    case YamlNode::Kind::kMap:
      return "a map";
    case YamlNode::Kind::kScalar:
      break;
  }
  return Quote(node.text);
}

std::string KeyPath(const std::string& parent, const std::string& key) {
  constexpr size_t kLongest = 60;
  const bool plain = key.size() <= kLongest && !HasControlCharacter(key);
  return (parent.empty() ? "" : parent + ".") + (plain ? key : Quote(key));
}

}  // namespace halfstep
