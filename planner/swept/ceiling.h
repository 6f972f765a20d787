#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <vector>

#include "planner/swept/four_floats.h"

namespace halfstep {

/// What planes leave of z from above, over columns (i, j): the least of `highest` and at + per_x·i
/// + per_y·j of each. Of the planes over a rectangle of columns only few are the lowest anywhere:
/// one that another one is below at all four corners, by more than rounding, is left out there,
/// which changes no result.
class Ceiling {
 public:
  /// Room for `planes` of them.
  Ceiling(float highest, size_t planes) : highest_(highest) {
    blocks_.reserve((planes + 3) / 4);
    lowest_.reserve(planes);
  }

  /// Adds the half-space z ≤ at + per_x·x + per_y·y, in cells.
  void Add(double at, double per_x, double per_y) {
    const size_t lane = count_++ % 4;
    if (lane == 0) blocks_.emplace_back();
    blocks_.back().at[lane] = static_cast<float>(at);
    blocks_.back().per_x[lane] = static_cast<float>(per_x);
    blocks_.back().per_y[lane] = static_cast<float>(per_y);
  }

  /// Keeps the planes that matter in columns 0 … `last` of the rows `from` … `to`.
  void EnterRows(float from, float to, float last) {
    lowest_.clear();
    std::array<Corners, kRivals> rivals;
    for (size_t r = 0; r < rivals.size(); ++r) {
      rivals[r] = RivalOf(rivals_[r] < count_ ? rivals_[r] : 0, from, to, last);
    }
    std::array<float, kRivals> least;
    least.fill(kNowhere);
    for (const Block& block : blocks_) {
      const Four at = Four::Load(block.at.data()), per_y = Four::Load(block.per_y.data());
      const Four across = Four::Load(block.per_x.data()) * Four(last);
      const Four a = at + Four(from) * per_y, b = at + Four(to) * per_y;
      const Four c = a + across, d = b + across;
      const Four room = Four(kRoom) * (Four(1.0f) + a.Abs() + b.Abs() + c.Abs() + d.Abs());
      int left_out = (Four(highest_) + room).Within(Min(Min(a, b), Min(c, d)));
      for (const Corners& rival : rivals) {
        left_out |= (Four(rival[0]) + room).Within(a) & (Four(rival[1]) + room).Within(b) &
                    (Four(rival[2]) + room).Within(c) & (Four(rival[3]) + room).Within(d);
      }
      if (left_out == 15) continue;
      float heights[kRivals][4];
      (a + b).Store(heights[0]);
      (c + d).Store(heights[1]);
      (a + d).Store(heights[2]);
      for (unsigned kept = ~static_cast<unsigned>(left_out) & 15u; kept != 0; kept &= kept - 1) {
        const auto lane = static_cast<size_t>(std::countr_zero(kept));
        lowest_.push_back({block.at[lane], block.per_x[lane], block.per_y[lane]});
        for (size_t r = 0; r < kRivals; ++r) {
          if (heights[r][lane] >= least[r]) continue;
          least[r] = heights[r][lane];
          rivals_[r] = 4 * static_cast<size_t>(&block - blocks_.data()) + lane;
        }
      }
    }
  }

  /// The least in the columns 0 … 8·blocks − 1 of one of these rows.
  void Row(float j, size_t blocks, float* least) {
    for (Plane& plane : lowest_) plane.begin = plane.at + j * plane.per_y;
    constexpr float kFirst[4] = {0, 1, 2, 3};
    Four left = Four::Load(kFirst);
    for (size_t i = 0; i < blocks; ++i, left = left + Four(8.0f)) {
      const Four right = left + Four(4.0f);
      Four a(highest_), b(highest_);
      for (const Plane& plane : lowest_) {
        const Four begin(plane.begin), per_x(plane.per_x);
        a = Min(a, begin + per_x * left);
        b = Min(b, begin + per_x * right);
      }
      a.Store(least + 8 * i);
      b.Store(least + 8 * i + 4);
    }
  }

 private:
  static constexpr float kNowhere = 1e30f;
  static constexpr float kRoom = 1e-5f;  // of the heights; they are rounded to 1e-7
  static constexpr size_t kRivals = 3;

  struct Block {
    std::array<float, 4> at{kNowhere, kNowhere, kNowhere, kNowhere}, per_x{}, per_y{};
  };
  struct Plane {
    float at, per_x, per_y;
    float begin = 0.0f;  // in column 0 of a row
  };
  using Corners = std::array<float, 4>;

  // The heights of a plane at the corners, and its own room: what others are compared with.
  Corners RivalOf(size_t plane, float from, float to, float last) const {
    if (count_ == 0) return {kNowhere, kNowhere, kNowhere, kNowhere};
    const Block& block = blocks_[plane / 4];
    const size_t lane = plane % 4;
    const float a = block.at[lane] + from * block.per_y[lane];
    const float b = block.at[lane] + to * block.per_y[lane];
    const float across = block.per_x[lane] * last;
    Corners corners = {a, b, a + across, b + across};
    float size = 0.0f;
    for (const float height : corners) size += std::abs(height);
    for (float& height : corners) height += kRoom * size;
    return corners;
  }

  float highest_;
  size_t count_ = 0;
  std::vector<Block> blocks_;
  std::vector<Plane> lowest_;                    // of the rectangle
  std::array<size_t, kRivals> rivals_{0, 1, 2};  // the lowest planes before, somewhere
};

}  // namespace halfstep
