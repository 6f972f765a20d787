#include "wpg/robot/urdf_elements.h"

#include <algorithm>

#include "wpg/files/number_text.h"

namespace halfstep {

std::vector<TiXmlElement*> ChildrenOf(TiXmlElement& parent, const char* tag) {
  std::vector<TiXmlElement*> children;
  for (auto* e = parent.FirstChildElement(tag); e != nullptr; e = e->NextSiblingElement(tag)) {
    children.push_back(e);
  }
  return children;
}

std::string AttributeOf(const TiXmlElement& element, const char* name) {
  const char* value = element.Attribute(name);
  return value == nullptr ? "" : value;
}

std::vector<std::string_view> XmlWords(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  std::vector<std::string_view> words;
  for (size_t at = text.find_first_not_of(kSpace); at != std::string_view::npos;) {
    const size_t end = std::min(text.find_first_of(kSpace, at), text.size());
    words.push_back(text.substr(at, end - at));
    at = text.find_first_not_of(kSpace, end);
  }
  return words;
}

void UrdfElements::Complain(const TiXmlElement& at, const std::string& key,
                            const std::string& what) const {
  complaints_->Add(file_, at.Row(), at.Column(), key, what);
}

std::optional<std::vector<double>> UrdfElements::Numbers(const TiXmlElement& element,
                                                         const char* attribute,
                                                         size_t count) const {
  const std::string key = element.ValueStr() + " " + attribute;
  if (element.Attribute(attribute) == nullptr) {
    Complain(element, key, "is missing");
    return std::nullopt;
  }
  const std::string text = AttributeOf(element, attribute);
  std::vector<double> values;
  for (const std::string_view word : XmlWords(text)) {
    const NumberText number = ParseNumber(word);
    if (number.kind != NumberText::Kind::kNumber) {
      Complain(element, key, NumberMistake(word));
      return std::nullopt;
    }
    values.push_back(number.value);
  }
  if (values.size() != count) {
    Complain(
        element, key,
        "has " + std::to_string(values.size()) + " numbers (valid: " + std::to_string(count) + ")");
    return std::nullopt;
  }
  return values;
}

std::optional<std::vector<double>> UrdfElements::Bounded(const TiXmlElement& element,
                                                         const char* attribute, size_t count,
                                                         bool zero_allowed) const {
  const auto values = Numbers(element, attribute, count);
  if (!values) return std::nullopt;
  const double least = *std::min_element(values->begin(), values->end());
  if (least > 0 || (least == 0 && zero_allowed)) return values;
  Complain(element, element.ValueStr() + " " + attribute,
           AttributeOf(element, attribute) +
               " is out of range (valid: " + (zero_allowed ? "≥ 0" : "> 0") + ")");
  return std::nullopt;
}

TiXmlElement* UrdfElements::Required(TiXmlElement& parent, const char* tag) const {
  TiXmlElement* child = parent.FirstChildElement(tag);
  if (child == nullptr) {
    std::string what = "has no <";
    what += tag;
    what += '>';
    Complain(parent, parent.ValueStr(), what);
  }
  return child;
}

void UrdfElements::CheckOrigin(TiXmlElement& parent) const {
  for (const TiXmlElement* origin : ChildrenOf(parent, "origin")) {
    for (const char* attribute : {"xyz", "rpy"}) {
      if (origin->Attribute(attribute) != nullptr) Numbers(*origin, attribute, 3);
    }
  }
}

}  // namespace halfstep
