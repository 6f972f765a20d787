#include "wpg/files/xml_document.h"

#include <tinyxml.h>

#include "wpg/files/input_error.h"
#include "wpg/files/nesting.h"
#include "wpg/files/text.h"

namespace halfstep {

void ParseXml(const std::string& path, const std::string& text, TiXmlDocument* document) {
  const auto refuse = [&](int row, int column, const std::string& what) {
    Complaints complaints;
    complaints.Add(path, row, column, "", what);
    throw InputError(complaints.lines());
  };
  if (XmlDepth(text) > kMostXmlLevels) {
    refuse(0, 0,
           Formatted("nests too deeply, or its XML declaration is not plain (valid: at most "
                     "%d levels)",
                     kMostXmlLevels));
  }
  document->Parse(text.c_str(), nullptr, TIXML_ENCODING_UTF8);
  if (document->Error()) refuse(document->ErrorRow(), document->ErrorCol(), document->ErrorDesc());
  if (document->RootElement() == nullptr) refuse(1, 1, "there is no element in the file");
}

}  // namespace halfstep
