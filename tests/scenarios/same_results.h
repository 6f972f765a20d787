#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <tuple>

#include "smoothing/methods/smoothing_result.h"

namespace halfstep {

/// What a margin says, its value by its bits: undecided margins are not a number.
inline auto Content(const Margin& m) {
  return std::tuple(m.family, std::bit_cast<std::uint64_t>(m.value), m.subject, m.other, m.t,
                    m.at.half_step, m.at.tau);
}

/// All but times by the clock, to the bit.
inline void ExpectSame(const SmoothingResult& a, const SmoothingResult& b) {
  EXPECT_EQ(a.parameters, b.parameters);
  EXPECT_EQ(a.cost, b.cost);
  EXPECT_EQ(a.ending, b.ending);
  EXPECT_EQ(a.message, b.message);
  EXPECT_EQ(a.work, b.work);
  EXPECT_EQ(a.collision_queries, b.collision_queries);
  EXPECT_EQ(a.raw_infeasible, b.raw_infeasible);
  ASSERT_EQ(a.iterates.size(), b.iterates.size());
  for (size_t i = 0; i < a.iterates.size(); ++i) {
    const auto content = [](const SmoothingIterate& it) {
      return std::tuple(it.instants, it.effort, it.candidate_duration, it.candidate_worst_margin,
                        it.accepted, it.lambda, it.incumbent_duration, it.incumbent_slack,
                        it.incumbent_cost);
    };
    EXPECT_EQ(content(a.iterates[i]), content(b.iterates[i])) << i;
  }
  ASSERT_EQ(a.junctions.size(), b.junctions.size());
  for (size_t i = 0; i < a.junctions.size(); ++i) {
    ASSERT_EQ(a.junctions[i].limited_by.has_value(), b.junctions[i].limited_by.has_value());
    if (a.junctions[i].limited_by) {
      EXPECT_EQ(Content(*a.junctions[i].limited_by), Content(*b.junctions[i].limited_by));
    }
    EXPECT_EQ(a.junctions[i].multiplier, b.junctions[i].multiplier);
  }
}

}  // namespace halfstep
