#pragma once

#include <string_view>

namespace halfstep {

/// Whether an enumeration has an enumerator of this value. GCC and Clang write its name into the
/// name of the function, or else a cast: "kValue = (E)14".
template <auto kValue>
constexpr bool IsEnumerator() {
  return std::string_view(__PRETTY_FUNCTION__).find("kValue = (") == std::string_view::npos;
}

/// How many enumerators `E` has from 0 on without a gap. So tables with a row for each of them fail
/// to compile when one is added.
template <typename E, int kFrom = 0>
constexpr int NumEnumerators() {
  if constexpr (IsEnumerator<static_cast<E>(kFrom)>()) {
    return NumEnumerators<E, kFrom + 1>();
  } else {
    return kFrom;
  }
}

}  // namespace halfstep
