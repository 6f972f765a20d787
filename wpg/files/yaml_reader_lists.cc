#include <limits>
#include <utility>

#include "wpg/files/number_text.h"
#include "wpg/files/yaml_reader.h"

namespace halfstep {
namespace {

using NodeKind = YamlNode::Kind;

constexpr size_t kAnyLength = std::numeric_limits<size_t>::max();

std::string Count(size_t count, const std::string& of) {
  return count == 1 ? "1 " + of : std::to_string(count) + " " + of + "s";
}

std::string ItemPath(const std::string& path, size_t i) {
  return path + "[" + std::to_string(i) + "]";
}

}  // namespace

bool YamlReader::IsList(const YamlNode& node, const std::string& path, size_t lo, size_t hi,
                        const std::string& of) {
  const std::string valid = lo == hi           ? Count(lo, of)
                            : hi == kAnyLength ? "a list of " + of + "s"
                                               : std::to_string(lo) + " … " + Count(hi, of);
  if (node.kind != NodeKind::kList) {
    const bool is_item = node.kind == NodeKind::kScalar && hi == kAnyLength && of == "text";
    complaints_->Add(node.place, path,
                     "not a list: " + Describe(node) + " (valid: " + valid +
                         (is_item ? ", [" + node.text + "]" : "") + ")");
    return false;
  }
  if (node.items.size() >= lo && node.items.size() <= hi) return true;
  complaints_->Add(node.place, path, Count(node.items.size(), of) + " (valid: " + valid + ")");
  return false;
}

void YamlReader::Texts(const char* key, std::vector<std::string>* value, const TextSpec& spec) {
  const YamlNode* const node = Take(key, spec.required, "a list of texts");
  const std::string path = KeyPath(path_, key);
  if (node == nullptr || !IsList(*node, path, 0, kAnyLength, "text")) return;
  std::vector<std::string> texts;
  for (size_t i = 0; i < node->items.size(); ++i) {
    const auto text = ToText(node->items[i], ItemPath(path, i), spec);
    if (text) texts.push_back(*text);
  }
  if (texts.size() == node->items.size()) *value = std::move(texts);
}

void YamlReader::Numbers(const char* key, std::vector<double>* value, size_t count,
                         const NumberSpec& spec) {
  const std::string valid = count == 0 ? "a list of numbers" : Count(count, "number");
  const YamlNode* const node = Take(key, spec.required, valid);
  const std::string path = KeyPath(path_, key);
  if (node == nullptr) return;
  const size_t lo = count, hi = count == 0 ? kAnyLength : count;
  bool good = IsList(*node, path, lo, hi, "number");
  std::vector<double> numbers;
  for (size_t i = 0; node->kind == NodeKind::kList && i < node->items.size(); ++i) {
    const auto number = ToNumber(node->items[i], ItemPath(path, i), spec, IsDegrees(key));
    numbers.push_back(number.value_or(0.0));
    good = good && number;
  }
  if (good) *value = std::move(numbers);
}

void YamlReader::Points(const char* key, Eigen::Matrix2Xd* value, const GroupSpec& list,
                        const NumberSpec& number) {
  const YamlNode* const node = Take(key, list.required, "a list of points [x, y]");
  const std::string path = KeyPath(path_, key);
  if (node == nullptr || !IsList(*node, path, list.min_items, list.max_items, "point")) return;
  Eigen::Matrix2Xd points(2, static_cast<Eigen::Index>(node->items.size()));
  bool good = true;
  for (size_t i = 0; i < node->items.size(); ++i) {
    const YamlNode& point = node->items[i];
    if (!IsList(point, ItemPath(path, i), 2, 2, "number")) {
      good = false;
      continue;
    }
    for (size_t axis = 0; axis < 2; ++axis) {
      const std::string axis_path = ItemPath(ItemPath(path, i), axis);
      const auto coordinate = ToNumber(point.items[axis], axis_path, number, IsDegrees(key));
      points(static_cast<Eigen::Index>(axis), static_cast<Eigen::Index>(i)) =
          coordinate.value_or(0.0);
      good = good && coordinate;
    }
  }
  if (good) *value = std::move(points);
}

bool YamlReader::Group(const char* key, const GroupSpec& spec,
                       const std::function<void(Fields&)>& declare) {
  const YamlNode* const node = Take(key, spec.required, "a map");
  const bool is_map = node != nullptr && node->kind == NodeKind::kMap;
  if (node != nullptr && !is_map) {
    complaints_->Add(node->place, KeyPath(path_, key),
                     "not a map: " + Describe(*node) + " (valid: a map)");
  }
  YamlReader(is_map ? node : nullptr, KeyPath(path_, key), directory_, complaints_).Run(declare);
  return node != nullptr;
}

void YamlReader::Items(const char* key, const GroupSpec& spec, size_t /*size*/,
                       const std::function<void(size_t)>& resize,
                       const std::function<void(Fields&, size_t)>& declare) {
  const YamlNode* const node = Take(key, spec.required, "a list of maps");
  const std::string path = KeyPath(path_, key);
  if (node == nullptr || !IsList(*node, path, spec.min_items, spec.max_items, "item")) return;
  resize(node->items.size());
  for (size_t i = 0; i < node->items.size(); ++i) {
    const YamlNode& item = node->items[i];
    const bool is_map = item.kind == NodeKind::kMap;
    if (!is_map) {
      complaints_->Add(item.place, ItemPath(path, i),
                       "not a map: " + Describe(item) + " (valid: a map)");
    }
    YamlReader(is_map ? &item : nullptr, ItemPath(path, i), directory_, complaints_)
        .Run([&declare, i](Fields& fields) { declare(fields, i); });
  }
}

void YamlReader::Complain(const char* key, const std::string& what) {
  if (map_ == nullptr) return;
  if (key[0] == '\0') {
    complaints_->Add(map_->place, path_, what);
    return;
  }
  const std::string path = KeyPath(path_, key);
  if (complaints_->About(path)) return;
  const YamlNode* const node = map_->Find(key);
  complaints_->Add(node == nullptr ? map_->place : node->place, path, what);
}

}  // namespace halfstep
