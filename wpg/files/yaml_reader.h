#pragma once

#include <optional>
#include <string>
#include <vector>

#include "wpg/files/fields.h"
#include "wpg/files/yaml_node.h"

namespace halfstep {

/// Reads one map of a YAML tree through a declaration of its keys; groups within it by readers of
/// their own. Complaints are gathered, never thrown.
class YamlReader : public Fields {
 public:
  /// `map` is a map or nullptr: an absent group, in which nothing is required nor complained about.
  YamlReader(const YamlNode* map, std::string path, std::string directory,
             YamlComplaints* complaints);

  /// Runs the declaration, then complains about the keys that it did not name.
  void Run(const std::function<void(Fields&)>& declare);

  void Number(const char* key, double* value, const NumberSpec& spec) override;
  void OptionalNumber(const char* key, std::optional<double>* value,
                      const NumberSpec& spec) override;
  void Integer(const char* key, int* value, const NumberSpec& spec) override;
  void Boolean(const char* key, bool* value, const TextSpec& spec) override;
  void Text(const char* key, std::string* value, const TextSpec& spec) override;
  void Texts(const char* key, std::vector<std::string>* value, const TextSpec& spec) override;
  void Numbers(const char* key, std::vector<double>* value, size_t count,
               const NumberSpec& spec) override;
  void Points(const char* key, Eigen::Matrix2Xd* value, const GroupSpec& list,
              const NumberSpec& number) override;
  bool Group(const char* key, const GroupSpec& spec,
             const std::function<void(Fields&)>& declare) override;
  void OptionalGroup(const char* key, bool* present, const GroupSpec& spec,
                     const std::function<void(Fields&)>& declare) override {
    *present = Group(key, spec, declare);
  }
  void Items(const char* key, const GroupSpec& spec, size_t size,
             const std::function<void(size_t)>& resize,
             const std::function<void(Fields&, size_t)>& declare) override;
  void Complain(const char* key, const std::string& what) override;
  void Renamed(const char* old_key, const char* new_key) override;
  void Misplaced(const char* key, const std::string& what) override;
  std::vector<std::string> Keys() const override;
  std::string directory() const override { return directory_; }

 private:
  /// The value of a key, which is known from now on; nullptr when absent (a complaint if required).
  const YamlNode* Take(const char* key, bool required, const std::string& valid);
  /// Whether the node is a list of lo … hi items; a complaint if not.
  bool IsList(const YamlNode& node, const std::string& path, size_t lo, size_t hi,
              const std::string& of);

  std::optional<double> ToNumber(const YamlNode& node, const std::string& path,
                                 const NumberSpec& spec, bool degrees);
  std::optional<std::string> ToText(const YamlNode& node, const std::string& path,
                                    const TextSpec& spec);

  const YamlNode* const map_;
  const std::string path_;
  const std::string directory_;
  YamlComplaints* const complaints_;
  std::vector<std::string> known_;
};

}  // namespace halfstep
