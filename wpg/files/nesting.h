#pragma once

#include <string_view>

namespace halfstep {

/// How deep a text nests, to be checked before a recursive parser or printer, which might overflow
/// the stack, is given it. Exact for valid texts; for others at least the depth before the first
/// mistake.

/// Depth of nested arrays and objects; 0 without any.
int JsonDepth(std::string_view text);
inline constexpr int kMostJsonLevels = 64;  ///< that readers take

/// Depth of nested elements, as TinyXML finds them; comments, declarations, CDATA and quoted
/// attributes hold none. The largest int when an XML declaration is not plain (version, encoding,
/// standalone): TinyXML has a notion of its own of where it ends.
int XmlDepth(std::string_view text);
inline constexpr int kMostXmlLevels = 64;  ///< that readers take

}  // namespace halfstep
