#pragma once

#include <any>
#include <functional>
#include <map>
#include <string>
#include <typeinfo>

#include "wpg/check.h"
#include "wpg/files/fields.h"

namespace halfstep {

class MethodOptions;

/// A group of options without its type, as those take it who read or write every method's.
struct DeclaredGroup {
  std::string key;             ///< the group's name in YAML
  std::string meaning;         ///< one line, for `halfstep explain-config`
  const std::type_info* type;  ///< of what the keys fill
  std::function<void(Fields&, MethodOptions*)> declare;  ///< the keys, with their values
};

/// Names a group of options: keys of YAML, and the copyable type that they fill. It has default
/// values, and its keys are declared once by `void DeclareFields(Fields&, Options*)`, in the
/// namespace of the type or of what it holds. Methods that name the same group share its values.
template <typename Options>
struct OptionGroup {
  std::string key;      ///< in YAML; a method's own group has the name of the method
  std::string meaning;  ///< one line, for `halfstep explain-config`
  Options defaults{};   ///< the values where no config says others

  /// The same for those who do not know the type.
  operator DeclaredGroup() const;
};

/// The options of methods: a value for each group. One that was not set has its defaults.
class MethodOptions {
 public:
  /// The values of a group. Throws std::logic_error when another type has its key.
  template <typename Options>
  Options Get(const OptionGroup<Options>& group) const {
    const auto found = values_.find(group.key);
    return found == values_.end() ? group.defaults : *As<Options>(&found->second, group.key);
  }
  /// The same, to be changed; as long as these options live.
  template <typename Options>
  Options& Edit(const OptionGroup<Options>& group) {
    std::any& value = values_[group.key];
    if (!value.has_value()) value = group.defaults;
    return *As<Options>(&value, group.key);
  }

 private:
  template <typename Options, typename Any>
  static auto As(Any* value, const std::string& key) {
    const auto options = std::any_cast<Options>(value);
    HALFSTEP_CHECK(options != nullptr, "options of `" << key << "` are of another type");
    return options;
  }

  std::map<std::string, std::any> values_;
};

template <typename Options>
OptionGroup<Options>::operator DeclaredGroup() const {
  return {key, meaning, &typeid(Options), [group = *this](Fields& fields, MethodOptions* options) {
            DeclareFields(fields, &options->Edit(group));
          }};
}

}  // namespace halfstep
