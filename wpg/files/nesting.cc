#include "wpg/files/nesting.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <regex>
#include <string>

namespace halfstep {
namespace {

// Moves `at` behind the next `mark`, or to the end.
void SkipPast(std::string_view text, std::string_view mark, size_t* at) {
  const size_t found = text.find(mark, *at);
  *at = found == std::string_view::npos ? text.size() : found + mark.size();
}

// Moves `at` from inside a start tag behind its '>'; whether the element ends there ("/>").
bool SkipStartTag(std::string_view text, size_t* at) {
  while (*at < text.size()) {
    const char c = text[*at];
    ++*at;
    if (c == '>') return text[*at - 2] == '/';
    if (c == '"' || c == '\'') SkipPast(text, std::string_view(&c, 1), at);
  }
  return false;
}

bool IsDeclaration(std::string_view rest) {
  std::string start(rest.substr(0, 5));
  std::transform(start.begin(), start.end(), start.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return start == "<?xml";
}

bool IsPlainDeclaration(std::string_view rest) {
  static const std::regex kPlain(
      R"(<\?xml(\s+(version|encoding|standalone)\s*=\s*("[\w.-]*"|'[\w.-]*'))*\s*\?)");
  const std::string whole(rest.substr(0, std::min<size_t>(rest.find('>'), 200)));
  return std::regex_match(whole, kPlain);
}

// TinyXML's: a letter, '_', or any byte that is not ASCII.
bool BeginsName(std::string_view rest) {
  if (rest.size() < 2) return false;
  const auto c = static_cast<unsigned char>(rest[1]);
  return c >= 127 || c == '_' || std::isalpha(c) != 0;
}

}  // namespace

int JsonDepth(std::string_view text) {
  int depth = 0, deepest = 0;
  bool quoted = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c == '\\') ++i;
      if (c == '"') quoted = false;
    } else if (c == '"') {
      quoted = true;
    } else if (c == '[' || c == '{') {
      deepest = std::max(deepest, ++depth);
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return deepest;
}

int XmlDepth(std::string_view text) {
  int depth = 0, deepest = 0;
  for (size_t at = text.find('<'); at < text.size(); at = text.find('<', at)) {
    const std::string_view rest = text.substr(at);
    if (rest.starts_with("<!--")) {
      at += 4;
      SkipPast(text, "-->", &at);
    } else if (rest.starts_with("<![CDATA[")) {
      SkipPast(text, "]]>", &at);
    } else if (rest.starts_with("</")) {
      depth = std::max(0, depth - 1);
      SkipPast(text, ">", &at);
    } else if (BeginsName(rest)) {
      deepest = std::max(deepest, depth + 1);
      ++at;
      if (!SkipStartTag(text, &at)) ++depth;
    } else {
      if (IsDeclaration(rest) && !IsPlainDeclaration(rest)) return std::numeric_limits<int>::max();
      SkipPast(text, ">", &at);
    }
  }
  return deepest;
}

}  // namespace halfstep
