#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace halfstep {

/// What a number may be. Reading refuses anything outside [min, max] and anything not finite.
struct NumberSpec {
  const char* meaning = "";
  const char* unit = "";  ///< "s", "m", "rad" …; "" for a pure number.
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool required = false;
};
struct TextSpec {
  const char* meaning = "";
  bool required = false;
  std::vector<std::string> choices;  ///< empty: any text.
};
struct GroupSpec {
  const char* meaning = "";
  bool required = false;
  size_t min_items = 0;       ///< lists only
  size_t max_items = 100000;  ///< lists only
};

/// One declaration of a group of keys serves reading, writing back and explaining: a struct's keys
/// are declared by a function `void DeclareFields(Fields& fields, X* x)` that names each key once.
/// The value that a pointer holds before reading is the key's default.
/// A key that ends in `_deg` is stored in radians: the visitor converts.
class Fields {
 public:
  virtual ~Fields() = default;
  virtual void Number(const char* key, double* value, const NumberSpec& spec) = 0;
  /// Absent or `none` means no value.
  virtual void OptionalNumber(const char* key, std::optional<double>* value,
                              const NumberSpec& spec) = 0;
  virtual void Integer(const char* key, int* value, const NumberSpec& spec) = 0;
  virtual void Boolean(const char* key, bool* value, const TextSpec& spec) = 0;
  virtual void Text(const char* key, std::string* value, const TextSpec& spec) = 0;
  virtual void Texts(const char* key, std::vector<std::string>* value, const TextSpec& spec) = 0;
  /// A list of exactly `count` numbers (count 0: any number of them).
  virtual void Numbers(const char* key, std::vector<double>* value, size_t count,
                       const NumberSpec& spec) = 0;
  /// A nested map. `declare` runs on it; when it is absent and not required, on an empty map.
  /// Returns whether the key was present.
  virtual bool Group(const char* key, const GroupSpec& spec,
                     const std::function<void(Fields&)>& declare) = 0;
  /// A list of maps: `resize(n)`, then `declare(fields, i)` for each item.
  virtual void List(const char* key, const GroupSpec& spec,
                    const std::function<void(size_t)>& resize,
                    const std::function<void(Fields&, size_t)>& declare) = 0;
  /// A complaint about the value of `key` of this group ("" for the group itself) that a range
  /// cannot express, reported at its place. Ignored by visitors that do not read.
  virtual void Complain(const char* key, const std::string& what) = 0;
  /// Directory of the file being read, for relative paths; "" otherwise.
  virtual std::string directory() const = 0;
};

}  // namespace halfstep
