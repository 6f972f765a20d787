#pragma once

#include <locale>
#include <sstream>

namespace halfstep::opt {

/// A stream that writes numbers with a decimal point and without groups of digits, whatever global
/// locale the program around us has set.
class PlainStream : public std::ostringstream {
 public:
  PlainStream() { imbue(std::locale::classic()); }
};

}  // namespace halfstep::opt
