#include "smoothing/margins/own_margin.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "wpg/nth.h"

namespace halfstep {
namespace {

struct RegisteredMargins {
  std::vector<std::unique_ptr<const OwnStatement>> all;
  bool in_use = false;  // families were counted already
};

RegisteredMargins& TheOwnMargins() {
  static RegisteredMargins registered;
  return registered;
}

}  // namespace

void RegisterOwnMargin(std::unique_ptr<const OwnStatement> statement) {
  RegisteredMargins& registered = TheOwnMargins();
  if (registered.in_use) {
    throw std::logic_error("margin `" + statement->name() +
                           "` comes too late: register margins before anything else");
  }
  registered.all.push_back(std::move(statement));
}

const std::vector<std::unique_ptr<const OwnStatement>>& OwnMargins() {
  TheOwnMargins().in_use = true;
  return TheOwnMargins().all;
}

int OwnMargin::count() const { return static_cast<int>(OwnMargins().size()); }

std::string OwnMargin::Subject(const Margin& margin) const {
  const auto& all = OwnMargins();
  if (margin.subject >= 0) return Nth(all, margin.subject)->name();
  std::string names;  // where it is not known which one
  for (const auto& own : all) names += (names.empty() ? "" : ", ") + own->name();
  return names;
}

Margin OwnMargin::Least(Instant* at, double) const {
  Margin least = Of(kUnlimited, -1);
  const auto& all = OwnMargins();
  for (size_t i = 0; i < all.size(); ++i) {
    Lower(Of(all[i]->Value(at) / all[i]->scale(), static_cast<int>(i)), &least);
  }
  return least;
}

void OwnMargin::AddRows(Instant* at, SlackSink* rows) const {
  for (const auto& own : OwnMargins()) {
    const double value = own->Value(at) / own->scale();
    if (!(value <= rows->cutoff_margin()) || !std::isfinite(value)) continue;
    const std::vector<double> slopes = own->Slopes(at, rows->sensitivities);
    rows->Add(value, [&](size_t i) { return slopes[i] / own->scale(); });
  }
}

void OwnMargin::AddBounds(const MarginInterval& interval, TightestStatement* tightest) const {
  const auto& all = OwnMargins();
  for (size_t i = 0; i < all.size(); ++i) {
    const Margin margin = Of(all[i]->Value(&interval.mid) / all[i]->scale(), static_cast<int>(i));
    if (margin.value == kUnlimited) continue;
    tightest->Add(margin, all[i]->Change(interval) / all[i]->scale() + interval.mid.rounding());
  }
}

}  // namespace halfstep
