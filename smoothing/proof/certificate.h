#pragma once

#include <vector>

#include "smoothing/margins/margin.h"

namespace halfstep {

/// One line of a certificate: for all t in [begin, end], `count` statements of one family hold. The
/// one with the least to spare has margin `margin.value` at the midpoint and changes by at most
/// `bound` from there: margin.value − bound ≥ demanded.
struct CertificateRow {
  double begin = 0.0;                        ///< [s]
  double end = 0.0;                          ///< [s]
  MarginFamily family = MarginFamily::kZmp;  ///< of which statements are proved on [begin, end]
  int count = 0;                             ///< how many statements those are
  Margin margin;                             ///< at the midpoint, in the family's unit
  double bound = 0.0;                        ///< in the family's unit
};

/// A proof that a walk keeps every demanded margin at all times: for each family, the counts of the
/// rows that cover an instant add up to the family's number of statements.
using Certificate = std::vector<CertificateRow>;

/// When the adaptive certification gives up, and how it begins.
struct CertificationOptions {
  double resolution = 1e-4;  ///< shorter intervals are left undecided, not bisected [s] > 0
  double longest = 0.07;     ///< the first intervals are at most this long [s] ≥ resolution
};

}  // namespace halfstep
