#include "wpg/files/plain_locale.h"

#include "wpg/check.h"

namespace halfstep {

PlainLocale::PlainLocale() {
  static const locale_t plain = newlocale(LC_ALL_MASK, "C", nullptr);
  HALFSTEP_CHECK(plain != nullptr, "the C locale is always there");
  before_ = uselocale(plain);
}

}  // namespace halfstep
