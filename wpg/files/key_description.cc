#include "wpg/files/key_description.h"

#include <algorithm>
#include <utility>

#include "wpg/check.h"
#include "wpg/files/yaml_fields.h"

namespace halfstep {
namespace {

using Kind = KeyDescription::Kind;

constexpr size_t kAnyNumber = std::numeric_limits<size_t>::max();

// The value that a resolved file would have for the one key that `declare` declares.
std::string DefaultText(const std::function<void(Fields&)>& declare) {
  const std::string line = WriteYaml(declare);  // "key: value\n"
  const size_t begin = line.find(": ") + 2;
  return line.substr(begin, line.size() - begin - 1);
}

// The default is told, too, where files leave it out.
NumberSpec Told(NumberSpec spec) {
  spec.left_out.reset();
  spec.none_left_out = false;
  return spec;
}

TextSpec Told(TextSpec spec) {
  spec.left_out_empty = false;
  return spec;
}

class Describer : public Fields {
 public:
  explicit Describer(std::string path) : path_(std::move(path)) {}

  std::vector<KeyDescription> Take() { return std::move(keys_); }

  void Number(const char* key, double* value, const NumberSpec& spec) override {
    AddValue(Kind::kNumber, key, spec, [&](Fields& f) { f.Number(key, value, Told(spec)); });
  }
  void OptionalNumber(const char* key, std::optional<double>* value,
                      const NumberSpec& spec) override {
    AddValue(Kind::kOptionalNumber, key, spec,
             [&](Fields& f) { f.OptionalNumber(key, value, Told(spec)); });
  }
  void Integer(const char* key, int* value, const NumberSpec& spec) override {
    KeyDescription& added =
        AddValue(Kind::kInteger, key, spec, [&](Fields& f) { f.Integer(key, value, spec); });
    added.min = std::max<double>(spec.min, std::numeric_limits<int>::min());
    added.max = std::min<double>(spec.max, std::numeric_limits<int>::max());
  }
  void Boolean(const char* key, bool* value, const TextSpec& spec) override {
    AddValue(Kind::kBoolean, key, spec, [&](Fields& f) { f.Boolean(key, value, spec); });
  }
  void Text(const char* key, std::string* value, const TextSpec& spec) override {
    AddValue(Kind::kText, key, spec, [&](Fields& f) { f.Text(key, value, Told(spec)); });
  }
  void Texts(const char* key, std::vector<std::string>* value, const TextSpec& spec) override {
    KeyDescription& added =
        AddValue(Kind::kTexts, key, spec, [&](Fields& f) { f.Texts(key, value, spec); });
    added.max_items = kAnyNumber;
  }
  void Numbers(const char* key, std::vector<double>* value, size_t count,
               const NumberSpec& spec) override {
    KeyDescription& added =
        AddValue(Kind::kNumbers, key, spec, [&](Fields& f) { f.Numbers(key, value, count, spec); });
    added.min_items = count;
    added.max_items = count == 0 ? kAnyNumber : count;
  }
  void Points(const char* key, Eigen::Matrix2Xd* value, const GroupSpec& list,
              const NumberSpec& number) override {
    KeyDescription& added = AddValue(Kind::kPoints, key, number,
                                     [&](Fields& f) { f.Points(key, value, list, number); });
    AddItems(list, &added);
  }
  bool Group(const char* key, const GroupSpec& spec,
             const std::function<void(Fields&)>& declare) override {
    KeyDescription& added = Add(Kind::kGroup, key, spec.meaning, spec.required);
    added.otherwise = spec.otherwise;
    Describer describer(added.path);
    declare(describer);
    added.keys = describer.Take();
    return false;
  }
  void OptionalGroup(const char* key, bool* /*present*/, const GroupSpec& spec,
                     const std::function<void(Fields&)>& declare) override {
    Group(key, spec, declare);
  }
  void Items(const char* key, const GroupSpec& spec, size_t size,
             const std::function<void(size_t)>& resize,
             const std::function<void(Fields&, size_t)>& declare) override {
    HALFSTEP_CHECK(size == 0, "'" << key << "' holds " << size << " items");
    KeyDescription& added = Add(Kind::kList, key, spec.meaning, spec.required);
    AddItems(spec, &added);
    if (!spec.required) added.default_text = "[]";
    Describer describer(added.path + ".N");
    resize(1);
    declare(describer, 0);
    resize(0);
    added.keys = describer.Take();
  }

 private:
  KeyDescription& Add(Kind kind, const std::string& key, const char* meaning, bool required) {
    keys_.push_back({.kind = kind,
                     .path = path_.empty() ? key : path_ + "." + key,
                     .meaning = meaning,
                     .unit = "",
                     .required = required,
                     .default_text = "",
                     .otherwise = "",
                     .listed_by = ""});
    return keys_.back();
  }
  // With its default value.
  template <typename Spec>
  KeyDescription& AddValue(Kind kind, const char* key, const Spec& spec,
                           const std::function<void(Fields&)>& declare) {
    KeyDescription& added = Add(kind, key, spec.meaning, spec.required);
    if (!spec.required) added.default_text = DefaultText(declare);
    Describe(spec, &added);
    return added;
  }
  static void Describe(const NumberSpec& spec, KeyDescription* added) {
    added->unit = spec.unit;
    added->min = spec.min;
    added->max = spec.max;
  }
  static void Describe(const TextSpec& spec, KeyDescription* added) {
    added->choices = spec.choices;
    added->listed_by = spec.listed_by;
    added->otherwise = spec.otherwise;
  }
  static void AddItems(const GroupSpec& spec, KeyDescription* added) {
    added->required = spec.required;
    added->min_items = spec.min_items;
    added->max_items = spec.max_items;
  }

  const std::string path_;
  std::vector<KeyDescription> keys_;
};

}  // namespace

std::string KeyDescription::key() const { return path.substr(path.rfind('.') + 1); }

std::vector<KeyDescription> DescribeKeys(const std::function<void(Fields&)>& declare) {
  Describer describer("");
  declare(describer);
  return describer.Take();
}

}  // namespace halfstep
