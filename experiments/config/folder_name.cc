#include "experiments/config/folder_name.h"

#include <algorithm>

#include "wpg/files/text.h"

namespace halfstep {

void CheckName(Fields& fields, const std::string& name) {
  if (name.empty() || name.find('/') != std::string::npos || name.starts_with('.')) {
    fields.Complain("name", Quote(name) +
                                " cannot name a folder (valid: text without '/' that does not "
                                "begin with '.')");
  }
  if (const std::string mistake = NameMistake(name); !mistake.empty()) {
    fields.Complain("name", mistake);
  }
}

std::string MethodFolder(std::string method) {
  std::replace(method.begin(), method.end(), '/', '_');
  return method;
}

}  // namespace halfstep
