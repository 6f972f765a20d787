#include "smoothing/methods/named_options.h"

namespace halfstep {
namespace {

/// Declares the value of an option, whatever type it has.
struct Declaration {
  Fields& fields;
  const NamedOption& option;

  NumberSpec Range() const {
    return {.meaning = option.meaning.c_str(),
            .unit = option.unit.c_str(),
            .min = option.min,
            .max = option.max};
  }
  const char* key() const { return option.name.c_str(); }

  void operator()(bool& value) const {
    fields.Boolean(key(), &value, {.meaning = option.meaning.c_str()});
  }
  void operator()(int& value) const { fields.Integer(key(), &value, Range()); }
  void operator()(double& value) const { fields.Number(key(), &value, Range()); }
  void operator()(std::string& value) const {
    fields.Text(key(), &value, {.meaning = option.meaning.c_str(), .choices = option.choices});
  }
};

}  // namespace

void DeclareFields(Fields& fields, NamedOptions* options) {
  for (NamedOption& option : *options) std::visit(Declaration{fields, option}, option.value);
}

}  // namespace halfstep
