#pragma once

#include <string>

class TiXmlDocument;

namespace halfstep {

/// Parses an XML text, which is that of the file `path` in complaints. Throws InputError where it
/// is broken, has no element, or is deeper than kMostXmlLevels.
void ParseXml(const std::string& path, const std::string& text, TiXmlDocument* document);

}  // namespace halfstep
