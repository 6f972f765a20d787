#pragma once

#include <tinyxml.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wpg/files/input_error.h"

namespace halfstep {

/// The children of an element with a tag, in file order.
std::vector<TiXmlElement*> ChildrenOf(TiXmlElement& parent, const char* tag);

/// The text of an attribute; "" where there is none.
std::string AttributeOf(const TiXmlElement& element, const char* name);

/// The words of an attribute's text: what stands between XML's white space (blanks, tabs, line
/// breaks), and nothing else. Borrowed from the text.
std::vector<std::string_view> XmlWords(std::string_view text);

/// Reads attributes of a URDF's elements and complains at their places. Borrows both arguments.
class UrdfElements {
 public:
  /// `file` is for complaints.
  UrdfElements(const std::string& file, Complaints* complaints)
      : file_(file), complaints_(complaints) {}

  /// Says what is wrong with an attribute of an element.
  void Complain(const TiXmlElement& at, const std::string& key, const std::string& what) const;

  /// `count` finite numbers of an attribute; complains and returns none otherwise.
  std::optional<std::vector<double>> Numbers(const TiXmlElement& element, const char* attribute,
                                             size_t count) const;

  /// The same, for numbers that must not be negative, or 0 unless that is allowed.
  std::optional<std::vector<double>> Bounded(const TiXmlElement& element, const char* attribute,
                                             size_t count, bool zero_allowed) const;

  /// The child with a tag; complains and returns null where there is none.
  TiXmlElement* Required(TiXmlElement& parent, const char* tag) const;

  /// Complains about numbers of an `<origin>` that are not finite.
  void CheckOrigin(TiXmlElement& parent) const;

 private:
  const std::string& file_;
  Complaints* complaints_;
};

}  // namespace halfstep
