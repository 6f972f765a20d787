#pragma once

#include "tests/problems/auto_blocks.h"
#include "tests/problems/hock_schittkowski.h"
#include "tests/problems/problem_card.h"

namespace halfstep::testing {

/// Seven variables, powers up to six.
inline ProblemCard Hs100() {
  return {"HS100", kHockSchittkowski,
          ProblemBuilder(Vector({1, 2, 0, 4, 0, 1, 1}))
              .Minimize([](const auto& x) {
                return Power(x[0] - 10.0, 2) + 5.0 * Power(x[1] - 12.0, 2) + Power(x[2], 4) +
                       3.0 * Power(x[3] - 11.0, 2) + 10.0 * Power(x[4], 6) + 7.0 * Power(x[5], 2) +
                       Power(x[6], 4) - 4.0 * x[5] * x[6] - 10.0 * x[5] - 8.0 * x[6];
              })
              .NonNegative("a",
                           [](const auto& x) {
                             return 127.0 - 2.0 * Power(x[0], 2) - 3.0 * Power(x[1], 4) - x[2] -
                                    4.0 * Power(x[3], 2) - 5.0 * x[4];
                           })
              .NonNegative("b",
                           [](const auto& x) {
                             return 282.0 - 7.0 * x[0] - 3.0 * x[1] - 10.0 * Power(x[2], 2) - x[3] +
                                    x[4];
                           })
              .NonNegative("c",
                           [](const auto& x) {
                             return 196.0 - 23.0 * x[0] - Power(x[1], 2) - 6.0 * Power(x[5], 2) +
                                    8.0 * x[6];
                           })
              .NonNegative("d",
                           [](const auto& x) {
                             return -4.0 * Power(x[0], 2) - Power(x[1], 2) + 3.0 * x[0] * x[1] -
                                    2.0 * Power(x[2], 2) - 5.0 * x[5] + 11.0 * x[6];
                           })
              .Build(),
          680.6300573};
}

/// Ten variables, eight constraints.
inline ProblemCard Hs113() {
  return {
      "HS113", kHockSchittkowski,
      ProblemBuilder(Vector({2, 3, 5, 5, 1, 2, 7, 3, 6, 10}))
          .Minimize([](const auto& x) {
            return x[0] * x[0] + x[1] * x[1] + x[0] * x[1] - 14.0 * x[0] - 16.0 * x[1] +
                   Power(x[2] - 10.0, 2) + 4.0 * Power(x[3] - 5.0, 2) + Power(x[4] - 3.0, 2) +
                   2.0 * Power(x[5] - 1.0, 2) + 5.0 * x[6] * x[6] + 7.0 * Power(x[7] - 11.0, 2) +
                   2.0 * Power(x[8] - 10.0, 2) + Power(x[9] - 7.0, 2) + 45.0;
          })
          .NonNegative("a",
                       [](const auto& x) {
                         return 105.0 - 4.0 * x[0] - 5.0 * x[1] + 3.0 * x[6] - 9.0 * x[7];
                       })
          .NonNegative(
              "b",
              [](const auto& x) { return -10.0 * x[0] + 8.0 * x[1] + 17.0 * x[6] - 2.0 * x[7]; })
          .NonNegative("c",
                       [](const auto& x) {
                         return 8.0 * x[0] - 2.0 * x[1] - 5.0 * x[8] + 2.0 * x[9] + 12.0;
                       })
          .NonNegative("d",
                       [](const auto& x) {
                         return -3.0 * Power(x[0] - 2.0, 2) - 4.0 * Power(x[1] - 3.0, 2) -
                                2.0 * x[2] * x[2] + 7.0 * x[3] + 120.0;
                       })
          .NonNegative("e",
                       [](const auto& x) {
                         return -5.0 * x[0] * x[0] - 8.0 * x[1] - Power(x[2] - 6.0, 2) +
                                2.0 * x[3] + 40.0;
                       })
          .NonNegative("f",
                       [](const auto& x) {
                         return -0.5 * Power(x[0] - 8.0, 2) - 2.0 * Power(x[1] - 4.0, 2) -
                                3.0 * x[4] * x[4] + x[5] + 30.0;
                       })
          .NonNegative("g",
                       [](const auto& x) {
                         return -x[0] * x[0] - 2.0 * Power(x[1] - 2.0, 2) + 2.0 * x[0] * x[1] -
                                14.0 * x[4] + 6.0 * x[5];
                       })
          .NonNegative("h",
                       [](const auto& x) {
                         return 3.0 * x[0] - 6.0 * x[1] - 12.0 * Power(x[8] - 8.0, 2) + 7.0 * x[9];
                       })
          .Build(),
      24.3062091};
}

}  // namespace halfstep::testing
