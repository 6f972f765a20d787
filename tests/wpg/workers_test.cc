// Threads that share work: every index before the end once, whatever the number of threads.

#include "wpg/workers.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace halfstep {
namespace {

class WorkersTest : public testing::TestWithParam<int> {
 protected:
  Workers workers_{GetParam()};
};

TEST_P(WorkersTest, EveryIndexIsDoneOnceByAThreadOfTheirs) {
  EXPECT_EQ(workers_.threads(), GetParam());
  for (int count = 0; count < 300; ++count) {
    std::vector<std::atomic<int>> done(static_cast<size_t>(count));
    std::atomic<bool> known = true;
    EXPECT_EQ(workers_.Run(count,
                           [&](int index, int thread) {
                             ++done[static_cast<size_t>(index)];
                             if (thread < 0 || thread >= GetParam()) known = false;
                             return true;
                           }),
              count);
    for (const std::atomic<int>& times : done) ASSERT_EQ(times, 1);
    EXPECT_TRUE(known);
  }
}

TEST_P(WorkersTest, TheFirstIndexThatEndsItIsToldAndAllBeforeItAreDone) {
  constexpr int kCount = 100;
  for (int first = 0; first < kCount; ++first) {
    std::vector<std::atomic<int>> done(kCount);
    // Another one that would end it comes later.
    const int met = workers_.Run(kCount, [&](int index, int) {
      ++done[static_cast<size_t>(index)];
      return index != first && index != first + 7;
    });
    EXPECT_EQ(met, first);
    for (int i = 0; i <= first; ++i) ASSERT_EQ(done[static_cast<size_t>(i)], 1);
    for (const std::atomic<int>& times : done) ASSERT_LE(times, 1);
  }
}

TEST_P(WorkersTest, WhatTheSmallestIndexThrowsIsThrown) {
  for (int first = 0; first < 50; ++first) {
    try {
      workers_.Run(100, [&](int index, int) -> bool {
        if (index >= first) throw std::runtime_error(std::to_string(index));
        return true;
      });
      FAIL();
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(error.what(), std::to_string(first));
    }
  }
  EXPECT_EQ(workers_.Run(5, [](int, int) { return true; }), 5);  // and they go on
}

INSTANTIATE_TEST_SUITE_P(Threads, WorkersTest, testing::Values(1, 2, 3, 8));

TEST(Workers, NoneIsTheCallerAloneAndFewerThanOneAreRefused) {
  EXPECT_EQ(NumThreads(nullptr), 1);
  EXPECT_EQ(RunWith(nullptr, 9, [](int index, int thread) { return thread == 0 && index < 4; }), 4);
  EXPECT_THROW(Workers(0), std::logic_error);
}

}  // namespace
}  // namespace halfstep
