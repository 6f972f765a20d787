#pragma once

#include <utility>
#include <vector>

namespace halfstep {

/// What each row of a half-step and family keeps in reserve [of a slack's scale], > 0, for what
/// lies between the instants that are watched and for what no proof can decide. It grows where a
/// candidate needed more of it, and shrinks after candidates that were proved, so that one place
/// that is hard to prove costs no time elsewhere. Source: smoothing/README.md, "The search".
class RowReserves {
 public:
  /// What a candidate shows, by half-step and family (half-step·families + family).
  struct Seen {
    std::vector<double> rows;     ///< the least of the rows, which have the reserve taken off
    std::vector<double> samples;  ///< the least slack between the instants, too
  };
  using Place = std::pair<int, int>;  ///< half-step, and family by the order of its rows

  /// For `families` rows in each of `half_steps`; all keep `reserve`.
  RowReserves(int half_steps, int families, double reserve);

  /// Of the rows of a half-step and family [of a slack's scale].
  double of(int half_step, int family) const { return reserves_[Index({half_step, family})]; }
  void SetAll(double reserve);  ///< everywhere the same; what was refused is forgotten

  /// Adapts the reserves to a candidate. A proof refused it at the places `refused`, at most one a
  /// half-step; none: it was proved. If it was not `tried`, it was only sampled.
  ///   - A reserve grows where a proof refused the candidate or a sample is violated. The other
  ///     families of a refused half-step that are near their limits get more, too, since a proof
  ///     ends at the first family that it cannot prove.
  ///   - It stays where the solver did not keep the row as it is: more would not help there.
  ///   - All shrink after a candidate that was proved, but not down to what was refused before.
  void Learn(const Seen& seen, const std::vector<Place>& refused, bool tried);

 private:
  size_t Index(Place place) const {
    return static_cast<size_t>(place.first * families_ + place.second);
  }

  int families_;
  std::vector<double> reserves_;
  std::vector<double> least_;  // that a reserve shrinks to
};

}  // namespace halfstep
