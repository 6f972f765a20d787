#pragma once

#include <string_view>

namespace halfstep {

/// How deep a text nests, before a parser or a printer that calls itself at each level sees it.
/// Exact for valid texts; of others never less than what comes before the first mistake.

/// Arrays and objects inside one another; 0 without any.
int JsonDepth(std::string_view text);
inline constexpr int kMostJsonLevels = 64;  ///< that readers take

/// Elements inside one another, as TinyXML finds them; comments, declarations, CDATA and quoted
/// attributes hold none. The largest int when an XML declaration is not plain (version, encoding,
/// standalone): TinyXML has a notion of its own of where it ends.
int XmlDepth(std::string_view text);
inline constexpr int kMostXmlLevels = 64;  ///< that readers take

}  // namespace halfstep
