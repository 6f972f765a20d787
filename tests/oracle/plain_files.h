#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

namespace halfstep::oracle {

/// Bytes of a file. All functions here throw std::runtime_error for what they cannot read.
std::string ReadPlainFile(const std::string& path);
/// All numbers in a text, whatever stands between them.
std::vector<double> NumbersIn(const std::string& text);
Eigen::Vector3d ThreeNumbers(const std::string& text);

/// One start tag of an XML file: its name, those of the elements around it, its attributes.
struct XmlTag {
  std::string name, within;  ///< within: "robot/link/collision"
  std::map<std::string, std::string> attributes;
  /// Throws when it is not there.
  const std::string& operator[](const std::string& key) const;
};
std::vector<XmlTag> XmlTags(const std::string& text);

/// A line "key: value" of a YAML file, without its comment.
struct YamlLine {
  int indent = 0;
  std::string key, value;  ///< key: empty for a list item, whose text is all in value
};
std::vector<YamlLine> YamlLines(const std::string& text);

/// The points of the lines "v x y z" of an OBJ file.
std::vector<Eigen::Vector3d> ObjPoints(const std::string& text);

}  // namespace halfstep::oracle
