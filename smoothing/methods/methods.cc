#include "smoothing/methods/methods.h"

#include <algorithm>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "wpg/check.h"

namespace halfstep {
namespace {

const DeclaredGroup* Known(const std::vector<DeclaredGroup>& groups, const std::string& key) {
  const auto found = std::ranges::find(groups, key, &DeclaredGroup::key);
  return found == groups.end() ? nullptr : &*found;
}

// Each group of these methods once, but for those of `others`.
std::vector<DeclaredGroup> GroupsOf(std::span<const std::shared_ptr<const Smoother>> methods,
                                    const std::vector<DeclaredGroup>& others) {
  std::vector<DeclaredGroup> groups;
  for (const auto& method : methods) {
    for (DeclaredGroup& group : method->groups()) {
      if (Known(others, group.key) || Known(groups, group.key)) continue;
      groups.push_back(std::move(group));
    }
  }
  return groups;
}

bool IsName(const std::string& key) {
  constexpr std::string_view kValid =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-/";
  return !key.empty() && key.find_first_not_of(kValid) == std::string::npos;
}

}  // namespace

Methods::Methods(std::vector<std::shared_ptr<const Smoother>> built_in)
    : all_(std::move(built_in)), built_in_(all_.size()) {}

void Methods::Add(std::shared_ptr<const Smoother> smoother) {
  const std::string name = smoother->name();
  const auto same = std::ranges::find_if(all_, [&](const auto& m) { return m->name() == name; });
  const size_t place = static_cast<size_t>(same - all_.begin());
  if (place < built_in_) throw std::invalid_argument("method `" + name + "` is built in");
  std::vector<std::shared_ptr<const Smoother>> others = all_;
  if (same != all_.end()) others.erase(others.begin() + (same - all_.begin()));
  const std::vector<DeclaredGroup> known = GroupsOf(others, {});
  for (const DeclaredGroup& group : smoother->groups()) {
    if (!IsName(group.key)) {
      throw std::invalid_argument("options `" + group.key + "` of method `" + name +
                                  "` (valid: a key of letters, digits, `_`, `-` and `/`)");
    }
    const DeclaredGroup* const one = Known(known, group.key);
    if (one != nullptr && *one->type != *group.type) {
      throw std::invalid_argument("options `" + group.key + "` of method `" + name +
                                  "` are those of another method, of another type");
    }
  }
  if (same != all_.end()) {
    *same = std::move(smoother);
  } else {
    all_.push_back(std::move(smoother));
  }
}

void Methods::AddMargin(std::shared_ptr<const OwnStatement> margin) {
  margins_.push_back(std::move(margin));
}

void Methods::AddCost(std::shared_ptr<const WalkCost> cost) {
  const auto same = std::ranges::find_if(
      costs_, [&](const WeightedWalkCost& known) { return known.cost->name() == cost->name(); });
  (same == costs_.end() ? costs_.emplace_back() : *same).cost = std::move(cost);
}

std::vector<std::string> Methods::Names() const {
  std::vector<std::string> names;
  for (const auto& smoother : all_) names.push_back(smoother->name());
  return names;
}

const Smoother& Methods::Find(const std::string& name) const {
  const auto found = std::ranges::find_if(all_, [&](const auto& m) { return m->name() == name; });
  HALFSTEP_CHECK(found != all_.end(), "no method '" << name << "'");
  return **found;
}

std::vector<DeclaredGroup> Methods::BuiltInGroups() const {
  return GroupsOf(std::span(all_).first(built_in_), {});
}

std::vector<DeclaredGroup> Methods::OwnGroups() const {
  return GroupsOf(std::span(all_).subspan(built_in_), BuiltInGroups());
}

}  // namespace halfstep
