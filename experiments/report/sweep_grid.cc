#include "experiments/report/sweep_grid.h"

#include <algorithm>
#include <unordered_map>

namespace halfstep {
namespace {

// The axis of one key: values in the order in which they appear.
SweptKeys AxisOf(const std::string& key, const std::vector<std::string>& cells,
                 const SweepGrid& grid) {
  SweptKeys axis{.keys = {key}, .values = {}, .at = std::vector<int>(grid.ids.size())};
  std::unordered_map<std::string, int> known;
  for (size_t row = 0; row < cells.size(); ++row) {
    const auto [found, is_new] = known.try_emplace(cells[row], static_cast<int>(known.size()));
    if (is_new) axis.values.push_back({cells[row]});
    axis.at[grid.case_of_row[row]] = found->second;
  }
  return axis;
}

size_t ShownValues(const SweptKeys& axis, int stride) {
  return (axis.values.size() - 1) / static_cast<size_t>(stride) + 1;
}

}  // namespace

SweepGrid GridOf(const CsvTable& runs, const std::vector<std::string>& keys) {
  SweepGrid grid;
  for (const std::string& id : runs.Texts("case")) {
    if (grid.ids.empty() || grid.ids.back() != id) grid.ids.push_back(id);
    grid.case_of_row.push_back(grid.ids.size() - 1);
  }
  for (const std::string& key : keys) {
    SweptKeys axis = AxisOf(key, runs.Texts(key), grid);
    if (axis.values.size() < 2) {
      grid.constants.emplace_back(key, axis.values.empty() ? "" : axis.values[0][0]);
      continue;
    }
    // Zipped keys have their n-th value in the same cases.
    const auto same = std::find_if(grid.axes.begin(), grid.axes.end(),
                                   [&](const SweptKeys& other) { return other.at == axis.at; });
    if (same == grid.axes.end()) {
      grid.axes.push_back(std::move(axis));
      continue;
    }
    same->keys.push_back(key);
    for (size_t i = 0; i < axis.values.size(); ++i) same->values[i].push_back(axis.values[i][0]);
  }
  return grid;
}

Thinning ThinnedTo(const SweepGrid& grid, size_t most) {
  Thinning thinning{.stride = std::vector<int>(grid.axes.size(), 1), .kept = {}};
  while (true) {
    thinning.kept.clear();
    for (size_t i = 0; i < grid.ids.size(); ++i) {
      bool keep = true;
      for (size_t k = 0; k < grid.axes.size(); ++k) {
        keep = keep && grid.axes[k].at[i] % thinning.stride[k] == 0;
      }
      if (keep) thinning.kept.push_back(i);
    }
    if (thinning.kept.size() <= most) return thinning;
    size_t longest = 0;
    for (size_t k = 1; k < grid.axes.size(); ++k) {
      if (ShownValues(grid.axes[k], thinning.stride[k]) >
          ShownValues(grid.axes[longest], thinning.stride[longest])) {
        longest = k;
      }
    }
    thinning.stride[longest] *= 2;
  }
}

}  // namespace halfstep
