#pragma once

#include <tinyxml.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <string>

#include "experiments/scenery/scenery.h"
#include "experiments/scenery/scenery_places.h"

namespace halfstep {

/// XML as the readers of URDF and SDF take it. Throws InputError: broken, or deeper than 64 levels.
/// Entities of a document type are not expanded.
void ParseSceneryXml(const std::string& path, const std::string& text, TiXmlDocument* document);

/// Reads elements of one file and complains at their places (InputError).
class SceneryElements {
 public:
  /// Borrows the path.
  explicit SceneryElements(const std::string& path) : path_(path) {}

  const std::string& path() const { return path_; }  ///< of the file
  /// Throws InputError about an element.
  [[noreturn]] void Fail(const TiXmlElement& at, const std::string& what) const;
  /// `count` finite numbers of a text, which is that of `at`.
  Eigen::VectorXd Numbers(const TiXmlElement& at, const std::string& text, int count) const;
  /// Those of an attribute; `otherwise` when it is not there.
  Eigen::VectorXd Attribute(const TiXmlElement& at, const char* name,
                            const Eigen::VectorXd& otherwise) const;
  /// A size of an attribute, or of the text of a child.
  double Size(const TiXmlElement& at, const std::string& text) const;
  /// The same of three edges.
  Eigen::Vector3d Sizes(const TiXmlElement& at, const std::string& text) const;
  /// The text of a size by its name, in the form of the file's language.
  using TextOfSize = std::function<std::string(const char*)>;
  /// Takes a box, a sphere, a cylinder or a capsule; false: it is none of them.
  bool TakeSolid(const TiXmlElement& shape, const TextOfSize& text_of, SceneryThing* thing) const;
  /// A mesh file that `uri` names, scaled along its axes.
  void TakeMesh(const TiXmlElement& at, const std::string& uri, const Eigen::Vector3d& scale,
                const SceneryPlaces& places, SceneryThing* thing) const;
  /// The text of a child, trimmed; "" when there is none.
  static std::string TextOf(const TiXmlElement& parent, const char* child);
  /// The value of an attribute; "" when there is none.
  static std::string AttributeText(const TiXmlElement& at, const char* name);

 private:
  const std::string& path_;
};

}  // namespace halfstep
