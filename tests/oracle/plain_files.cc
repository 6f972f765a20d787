#include "tests/oracle/plain_files.h"

#include <cctype>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace halfstep::oracle {

std::string ReadPlainFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("oracle: cannot open " + path);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<double> NumbersIn(const std::string& text) {
  std::vector<double> numbers;
  for (const char* at = text.c_str(); *at != '\0';) {
    char* end = nullptr;
    const double number = std::strtod(at, &end);
    if (end == at) {
      ++at;
      continue;
    }
    numbers.push_back(number);
    at = end;
  }
  return numbers;
}

Eigen::Vector3d ThreeNumbers(const std::string& text) {
  const std::vector<double> numbers = NumbersIn(text);
  if (numbers.size() != 3) throw std::runtime_error("oracle: not three numbers: " + text);
  return {numbers[0], numbers[1], numbers[2]};
}

const std::string& XmlTag::operator[](const std::string& key) const {
  const auto found = attributes.find(key);
  if (found == attributes.end()) throw std::runtime_error("oracle: <" + name + "> has no " + key);
  return found->second;
}

std::vector<XmlTag> XmlTags(const std::string& text) {
  std::vector<XmlTag> tags;
  std::vector<std::string> open;
  size_t at = 0;
  while ((at = text.find('<', at)) != std::string::npos) {
    if (text.compare(at, 4, "<!--") == 0) {
      at = text.find("-->", at);
      continue;
    }
    const size_t end = text.find('>', at);
    if (end == std::string::npos) throw std::runtime_error("oracle: XML ends inside a tag");
    std::string inside = text.substr(at + 1, end - at - 1);
    at = end;
    if (inside.starts_with('?')) continue;
    if (inside.starts_with('/')) {
      open.pop_back();
      continue;
    }
    const bool closed = inside.ends_with('/');
    if (closed) inside.pop_back();
    XmlTag tag;
    tag.name = inside.substr(0, inside.find_first_of(" \t\n"));
    for (const std::string& name : open) tag.within += (tag.within.empty() ? "" : "/") + name;
    for (size_t equals = 0; (equals = inside.find('=', equals)) != std::string::npos;) {
      const size_t key = inside.find_last_of(" \t\n", equals) + 1;
      const size_t from = inside.find('"', equals) + 1, to = inside.find('"', from);
      tag.attributes[inside.substr(key, equals - key)] = inside.substr(from, to - from);
      equals = to;
    }
    if (!closed) open.push_back(tag.name);
    tags.push_back(std::move(tag));
  }
  return tags;
}

std::vector<YamlLine> YamlLines(const std::string& text) {
  std::vector<YamlLine> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (const size_t hash = line.find('#'); hash != std::string::npos) line.resize(hash);
    const size_t first = line.find_first_not_of(' ');
    if (first == std::string::npos) continue;
    YamlLine entry{.indent = static_cast<int>(first), .key = {}, .value = line.substr(first)};
    if (line[first] != '-') {
      const size_t colon = line.find(':', first);
      if (colon == std::string::npos) throw std::runtime_error("oracle: no key: " + line);
      entry.key = line.substr(first, colon - first);
      const size_t value = line.find_first_not_of(' ', colon + 1);
      entry.value = value == std::string::npos ? "" : line.substr(value);
    }
    lines.push_back(std::move(entry));
  }
  return lines;
}

std::vector<Eigen::Vector3d> ObjPoints(const std::string& text) {
  std::vector<Eigen::Vector3d> points;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("v ")) points.push_back(ThreeNumbers(line.substr(2)));
  }
  return points;
}

}  // namespace halfstep::oracle
