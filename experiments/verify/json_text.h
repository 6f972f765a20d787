#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace halfstep::verify {

/// A JSON document. Throws InputError "path:line: is not JSON", or that it nests too deeply.
nlohmann::json ParseJson(const std::string& path, const std::string& text);

/// Reads the members of one object. A member that is missing or of another type throws an
/// InputError that names it: "path: sha256.robot: is missing". Borrows path and object.
class JsonMember {
 public:
  /// `name` is the object's, for complaints.
  JsonMember(const std::string& path, const nlohmann::json& object, std::string name);

  /// A required object.
  JsonMember Object(const std::string& key) const { return {path_, Of(key), Name(key)}; }
  const nlohmann::json& List(const std::string& key) const;  ///< a required list
  /// Items of a list of objects.
  std::vector<JsonMember> Items(const std::string& key) const;
  std::string String(const std::string& key) const;                  ///< a required text
  double Number(const std::string& key) const;                       ///< a required finite number
  std::optional<double> NumberOrNull(const std::string& key) const;  ///< a required number or null
  long Whole(const std::string& key) const;                          ///< a required integer
  const nlohmann::json& object() const { return object_; }           ///< the object itself
  [[noreturn]] void Fail(const std::string& what) const;  ///< throws InputError that names it

 private:
  std::string Name(const std::string& key) const { return name_.empty() ? key : name_ + "." + key; }
  const nlohmann::json& Of(const std::string& key) const;
  [[noreturn]] void FailAt(const std::string& key, const std::string& what) const;

  const std::string& path_;
  const nlohmann::json& object_;
  std::string name_;
};

}  // namespace halfstep::verify
