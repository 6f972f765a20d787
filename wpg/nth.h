#pragma once

#include <cstddef>
#include <type_traits>

namespace halfstep {

/// Element `i` of a container, where indices are signed or enumerators. Precondition: as of the
/// container's own [].
template <typename Container, typename Index>
requires(std::is_integral_v<Index> || std::is_enum_v<Index>) constexpr decltype(auto)
    Nth(Container&& container, Index i) {
  return container[static_cast<size_t>(i)];
}

}  // namespace halfstep
