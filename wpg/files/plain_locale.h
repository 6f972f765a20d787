#pragma once

#include <locale.h>

#include <locale>
#include <sstream>

namespace halfstep {

/// While it lives, the C library reads and writes numbers of the calling thread with a decimal
/// point, whatever locale the program around us has set (Qt, GTK and others set the user's). For
/// calls of other libraries; where we read and write numbers ourselves, there is
/// wpg/files/number_text.h.
class PlainLocale {
 public:
  PlainLocale();
  ~PlainLocale() { uselocale(before_); }
  PlainLocale(const PlainLocale&) = delete;
  PlainLocale& operator=(const PlainLocale&) = delete;

 private:
  locale_t before_;
};

/// A stream that writes numbers with a decimal point and without groups of digits, whatever global
/// locale the program around us has set.
class PlainStream : public std::ostringstream {
 public:
  PlainStream() { imbue(std::locale::classic()); }
};

}  // namespace halfstep
