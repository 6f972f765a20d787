#include "experiments/scenery/scenery_xml.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/scenery/scenery_shapes.h"
#include "wpg/files/input_error.h"
#include "wpg/files/mesh_text.h"
#include "wpg/files/number_text.h"
#include "wpg/files/text.h"
#include "wpg/files/xml_document.h"
#include "wpg/nth.h"
#include "wpg/robot/urdf_elements.h"

namespace halfstep {

void ParseSceneryXml(const std::string& path, const std::string& text, TiXmlDocument* document) {
  if (const size_t entity = text.find("<!ENTITY"); entity != std::string::npos) {
    const std::string_view before = std::string_view(text).substr(0, entity);
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
    Complaints complaints;
    complaints.Add(path, static_cast<int>(line), 0, "",
                   "declares entities, which nothing here expands");
    throw InputError(complaints.lines());
  }
  ParseXml(path, text, document);
}

void SceneryElements::Fail(const TiXmlElement& at, const std::string& what) const {
  Complaints complaints;
  complaints.Add(path_, at.Row(), at.Column(), at.ValueStr(), what);
  throw InputError(complaints.lines());
}

bool SceneryElements::TakeSolid(const TiXmlElement& shape, const TextOfSize& text_of,
                                SceneryThing* thing) const {
  const auto size = [&](const char* name) { return Size(shape, text_of(name)); };
  const std::string& kind = shape.ValueStr();
  if (kind == "box") {
    thing->shape = Box{Sizes(shape, text_of("size"))};
  } else if (kind == "sphere") {
    thing->shape = Sphere{size("radius")};
  } else if (kind == "cylinder") {
    thing->shape = Cylinder{size("radius"), size("length")};
  } else if (kind == "capsule") {
    thing->shape = Capsule{size("radius"), size("length")};
  } else {
    return false;
  }
  return true;
}

Eigen::VectorXd SceneryElements::Numbers(const TiXmlElement& at, const std::string& text,
                                         int count) const {
  const std::vector<std::string_view> words = XmlWords(text);
  if (std::ssize(words) != count) {
    Fail(at,
         "has " + std::to_string(words.size()) + " numbers (valid: " + std::to_string(count) + ")");
  }
  Eigen::VectorXd numbers(count);
  for (int i = 0; i < count; ++i) {
    const NumberText number = ParseNumber(Nth(words, i));
    if (number.kind != NumberText::Kind::kNumber) Fail(at, NumberMistake(Nth(words, i)));
    if (!(std::abs(number.value) <= kMaxMeshCoordinate)) {
      Fail(at, Quote(Nth(words, i)) + " is too large (valid: at most 1e9)");
    }
    numbers[i] = number.value;
  }
  return numbers;
}

Eigen::VectorXd SceneryElements::Attribute(const TiXmlElement& at, const char* name,
                                           const Eigen::VectorXd& otherwise) const {
  const char* const text = at.Attribute(name);
  return text == nullptr ? otherwise : Numbers(at, text, static_cast<int>(otherwise.size()));
}

double SceneryElements::Size(const TiXmlElement& at, const std::string& text) const {
  const double size = Numbers(at, text, 1)[0];
  if (!(size >= kLeastSize && size <= kMostSize)) Fail(at, SizeMistake(size));
  return size;
}

Eigen::Vector3d SceneryElements::Sizes(const TiXmlElement& at, const std::string& text) const {
  const Eigen::Vector3d sizes = Numbers(at, text, 3);
  for (const double size : sizes) {
    if (!(size >= kLeastSize && size <= kMostSize)) Fail(at, SizeMistake(size));
  }
  return sizes;
}

void SceneryElements::TakeMesh(const TiXmlElement& at, const std::string& uri,
                               const Eigen::Vector3d& scale, const SceneryPlaces& places,
                               SceneryThing* thing) const {
  std::filesystem::path file;
  try {
    file = places.Find(uri, path_);
  } catch (const std::runtime_error& error) {
    Fail(at, error.what());
  }
  if ((scale.array() == 0.0).any()) Fail(at, "a scale of 0");
  thing->shape = MeshReference{file, scale};
}

std::string SceneryElements::TextOf(const TiXmlElement& parent, const char* child) {
  const TiXmlElement* const element = parent.FirstChildElement(child);
  const char* const text = element == nullptr ? nullptr : element->GetText();
  if (text == nullptr) return "";
  const std::string whole = text;
  const size_t begin = whole.find_first_not_of(" \t\r\n");
  if (begin == std::string::npos) return "";
  return whole.substr(begin, whole.find_last_not_of(" \t\r\n") + 1 - begin);
}

std::string SceneryElements::AttributeText(const TiXmlElement& at, const char* name) {
  const char* const value = at.Attribute(name);
  return value == nullptr ? "" : value;
}

}  // namespace halfstep
