#include "experiments/folder_name.h"

#include <string_view>

#include "wpg/input/text.h"

namespace halfstep {

void CheckName(Fields& fields, const std::string& name) {
  constexpr size_t kLongest = 100;
  if (name.empty() || name.find('/') != std::string::npos || name.starts_with('.')) {
    fields.Complain("name", Quote(name) +
                                " cannot name a folder (valid: text without '/' that does not "
                                "begin with '.')");
  } else if (std::string_view("-=+@").find(name[0]) != std::string_view::npos) {
    fields.Complain("name", Quote(name) +
                                " would be taken for an option or a formula (valid: text that "
                                "does not begin with '-', '=', '+' or '@')");
  } else if (name.size() > kLongest) {
    fields.Complain("name", Quote(name) + " is too long (valid: at most " +
                                std::to_string(kLongest) + " bytes)");
  }
}

}  // namespace halfstep
