#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace halfstep {

/// The valid values of a number. Reading refuses anything outside [min, max] and anything not
/// finite.
/// unit, min and max are those of the text: of a key in `_deg` they are in degrees.
struct NumberSpec {
  const char* meaning = "";  ///< one line, for `halfstep explain-config`
  const char* unit = "";     ///< "s", "m", "rad", "deg" …; "" for a pure number.
  double min = -std::numeric_limits<double>::infinity();  ///< smallest valid value
  double max = std::numeric_limits<double>::infinity();   ///< largest valid value
  bool required = false;                                  ///< whether the key may not be left out
  /// Of a number that few files need: writing leaves the key out at this value.
  std::optional<double> left_out = std::nullopt;
  /// The same of an optional number that has none.
  bool none_left_out = false;
};
/// The valid values of a text or a truth value.
struct TextSpec {
  const char* meaning = "";            ///< as in NumberSpec
  bool required = false;               ///< as in NumberSpec
  std::vector<std::string> choices{};  ///< empty: any text.
  const char* listed_by = "";          ///< the command that lists choices that depend on the build
  const char* otherwise = "";  ///< what holds without the key, where no default value says it
  /// Of a text that few files need: writing leaves the key out where it is empty.
  bool left_out_empty = false;
};
/// What is said about a group of keys, or about a list of them.
struct GroupSpec {
  const char* meaning = "";    ///< as in NumberSpec
  bool required = false;       ///< as in NumberSpec
  size_t min_items = 0;        ///< lists only
  size_t max_items = 100000;   ///< lists only
  const char* otherwise = "";  ///< as in TextSpec
};

/// One declaration of a group of keys serves reading, writing back and explaining: a struct's keys
/// are declared by a function `void DeclareFields(Fields& fields, X* x)` that names each key once.
/// The value that a pointer holds before reading is the key's default; an absent or refused value
/// leaves it as it is. A key that ends in `_deg` is stored in radians: the visitor converts.
/// Declaring one key twice in a group is a broken precondition (std::logic_error).
class Fields {
 public:
  virtual ~Fields() = default;
  /// A number within the bounds of `spec`; `value` keeps what it has when the key is absent.
  virtual void Number(const char* key, double* value, const NumberSpec& spec) = 0;
  /// Absent or `none` means no value.
  virtual void OptionalNumber(const char* key, std::optional<double>* value,
                              const NumberSpec& spec) = 0;
  /// As Number, without a fraction.
  virtual void Integer(const char* key, int* value, const NumberSpec& spec) = 0;
  /// `true` or `false`.
  virtual void Boolean(const char* key, bool* value, const TextSpec& spec) = 0;
  /// One of spec.choices, or any text.
  virtual void Text(const char* key, std::string* value, const TextSpec& spec) = 0;
  /// A list of such texts.
  virtual void Texts(const char* key, std::vector<std::string>* value, const TextSpec& spec) = 0;
  /// A list of exactly `count` numbers (count 0: any number of them).
  virtual void Numbers(const char* key, std::vector<double>* value, size_t count,
                       const NumberSpec& spec) = 0;
  /// A list of points in the plane, `[[x, y], …]` as the columns of a 2×n matrix; `list` bounds n,
  /// `number` every coordinate.
  virtual void Points(const char* key, Eigen::Matrix2Xd* value, const GroupSpec& list,
                      const NumberSpec& number) = 0;
  /// A nested map. `declare` runs on it; when it is absent and not required, on an empty map where
  /// no key is required. Returns whether the key was present. Writing always writes the group.
  virtual bool Group(const char* key, const GroupSpec& spec,
                     const std::function<void(Fields&)>& declare) = 0;
  /// A nested map that may be absent: reading sets `present`, writing leaves the group out unless
  /// `present`. So "exactly one of" is a row of optional groups and a Complain().
  virtual void OptionalGroup(const char* key, bool* present, const GroupSpec& spec,
                             const std::function<void(Fields&)>& declare) {
    if (*present) Group(key, spec, declare);
  }
  /// A list of maps, `declare(fields, &item)` for each; items read replace those held before.
  template <typename Item>
  void List(const char* key, const GroupSpec& spec, std::vector<Item>* items,
            const std::type_identity_t<std::function<void(Fields&, Item*)>>& declare) {
    Items(
        key, spec, items->size(), [items](size_t n) { *items = std::vector<Item>(n); },
        [items, &declare](Fields& fields, size_t i) { declare(fields, &(*items)[i]); });
  }
  /// Implements List(): `size` items are held now, `resize(n)` replaces them by n fresh ones.
  virtual void Items(const char* key, const GroupSpec& spec, size_t size,
                     const std::function<void(size_t)>& resize,
                     const std::function<void(Fields&, size_t)>& declare) = 0;
  /// A complaint about the value of `key` of this group ("" for the group itself) that a range
  /// cannot express, reported at its place. Ignored by visitors that do not read, in an absent
  /// group, and where `key` has been complained about already.
  virtual void Complain(const char* /*key*/, const std::string& /*what*/) {}
  /// Complains about `old_key`, the former name of `new_key`, where the file still has it. Ignored
  /// by visitors that do not read.
  virtual void Renamed(const char* /*old_key*/, const char* /*new_key*/) {}
  /// Complains about `key`, which other files or older versions have and not this one, where it is
  /// there. Ignored by visitors that do not read.
  virtual void Misplaced(const char* /*key*/, const std::string& /*what*/) {}
  /// The keys that this group has in the file being read, known or not, in its order; none for
  /// visitors that do not read. For maps whose keys are names that the user chooses.
  virtual std::vector<std::string> Keys() const { return {}; }
  /// Directory of the file being read, for relative paths; "" otherwise.
  virtual std::string directory() const { return ""; }
};

}  // namespace halfstep
