#include "planner/search/step_set.h"

#include <algorithm>
#include <cmath>

#include "wpg/check.h"
#include "wpg/nth.h"

namespace halfstep {

Foothold StepSet::Placement(int i, Side support) const {
  const Foothold& X_SF = Nth(placements, i);
  return support == Side::kLeft ? X_SF : X_SF.Mirrored();
}

HalfStep StepSet::PrototypeOf(int form) const {
  HalfStep one = prototype;
  if (forms.empty()) return one;
  one.shape.crouch = Nth(forms, form).crouch;
  one.via_height = Nth(forms, form).via_height;
  return one;
}

HalfStep StepSet::Down(int i, Side support) const {
  HalfStep down = PrototypeOf(ChangeOf(i).from);
  down.support = support;
  down.kind = HalfStepKind::kDown;
  down.X_SF = Placement(i, support);
  return down;
}

HalfStep StepSet::Up(int i, Side support) const {
  const auto [from, to] = ChangeOf(i);
  HalfStep up = PrototypeOf(to);
  if (from != to) up.standing_crouch = Nth(forms, from).crouch;
  up.support = Opposite(support);
  up.kind = HalfStepKind::kUp;
  up.X_SF = Placement(i, support).Inverse();
  return up;
}

bool HasLevels(const Ground& ground) { return !ground.OnlyLevel() || !ground.Solids().empty(); }

std::vector<double> RisesBetween(const std::vector<double>& heights, double most) {
  constexpr double kSame = 1e-9;
  std::vector<double> all;
  for (const double from : heights) {
    for (const double to : heights) {
      if (std::abs(to - from) > kSame && std::abs(to - from) <= most) all.push_back(to - from);
    }
  }
  std::ranges::sort(all);
  std::vector<double> rises = {0.0};
  for (const double rise : all) {
    if (rises.size() == 1 || rise - rises.back() > kSame) rises.push_back(rise);
  }
  return rises;
}

namespace {

// Adds the places of the grid at a height; false: stopped.
bool AddPlaces(const StepGrid& grid, double height,
               const std::function<bool(const HalfStep&)>& keeps,
               const std::function<bool(double)>& progress, StepSet* set) {
  HALFSTEP_CHECK(grid.spacing > 0.0 && grid.x_min <= grid.x_max && grid.y_min <= grid.y_max,
                 "spacing = " << grid.spacing);
  const auto count = [&grid](double from, double to) {
    return static_cast<int>(std::floor((to - from) / grid.spacing + 1e-9)) + 1;
  };
  const int nx = count(grid.x_min, grid.x_max), ny = count(grid.y_min, grid.y_max);
  for (int ix = 0; ix < nx; ++ix) {
    for (int iy = 0; iy < ny; ++iy) {
      for (double yaw : grid.yaws) {
        set->placements.push_back(
            {{grid.x_min + ix * grid.spacing, grid.y_min + iy * grid.spacing, yaw}, height});
        const int last = set->size() - 1;
        if (!keeps(set->Down(last, Side::kLeft)) || !keeps(set->Up(last, Side::kLeft))) {
          set->placements.pop_back();
        }
      }
    }
    if (progress && !progress((ix + 1.0) / nx)) return false;
  }
  return true;
}

}  // namespace

StepSet MakeStepSet(const StepGrid& grid, const HalfStep& prototype,
                    const std::function<bool(const HalfStep&)>& keeps,
                    const std::function<bool(double)>& progress) {
  StepSet set{.prototype = prototype, .placements = {}};
  if (!AddPlaces(grid, 0.0, keeps, progress, &set)) set.placements.clear();
  return set;
}

StepSet MakeStepSet(const StepGrid& grid, const HalfStep& prototype,
                    const std::vector<double>& rises,
                    const std::function<bool(const HalfStep&)>& keeps,
                    const std::function<bool(double)>& progress) {
  StepSet set{.prototype = prototype, .placements = {}, .on_levels = true};
  for (size_t r = 0; r < rises.size(); ++r) {
    if (std::abs(rises[r]) >= prototype.via_height) continue;
    const auto part = [&](double done) {
      return !progress ||
             progress((static_cast<double>(r) + done) / static_cast<double>(rises.size()));
    };
    if (AddPlaces(grid, rises[r], keeps, part, &set)) continue;
    set.placements.clear();
    break;
  }
  return set;
}

}  // namespace halfstep
