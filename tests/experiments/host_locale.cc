// Preloaded into halfstep or Python: what a graphical program does before it calls a library. The
// user's locale is that of the C library, which printf and strtod obey, and of C++ streams.

#include <clocale>
#include <iostream>
#include <locale>

namespace {

struct HostLocale {
  HostLocale() {
    std::setlocale(LC_ALL, "");
    std::locale::global(std::locale(""));
  }
} host_locale;

}  // namespace
