#include "smoothing/walk/parameter_table.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "wpg/check.h"
#include "wpg/files/plain_locale.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

HomotopyParameters StartOf(const HalfStepSequence& sequence,
                           const std::vector<FixedParameter>& fixed) {
  HomotopyParameters start = PlannedMotion(sequence);
  for (const FixedParameter& one : fixed) {
    if (one.value) one.parameter.in(start) = *one.value;
  }
  return start;
}

}  // namespace

ParameterTable::ParameterTable(const HalfStepSequence& sequence,
                               const std::vector<FixedParameter>& fixed,
                               const ParameterChoice& choice) {
  const std::string complaint = ComplaintAbout(sequence, fixed);
  HALFSTEP_CHECK(complaint.empty(), complaint);
  for (const ParameterFamily family : AllParameterFamilies()) {
    const ParameterFamilyTraits& traits = Traits(family);
    first_[family] = static_cast<int>(rows_.size());
    for (int i = 0; i < traits.count(sequence); ++i) {
      const double planned = traits.planned(sequence, i);
      const bool chosen =
          choice.moves(family) && (traits.stays == nullptr || !traits.stays(sequence, i));
      auto [lower, upper] = chosen ? traits.range(choice, planned) : std::pair{planned, planned};
      if (family == ParameterFamily::kHeightScale) {
        lower = std::clamp(LeastHeightScale(sequence, i), lower, upper);
      }
      rows_.push_back({{family, i}, planned, lower, upper, !chosen});
    }
  }
  for (const FixedParameter& one : fixed) {
    ParameterRow& row = Nth(rows_, IndexOf(one.parameter));
    row.start = row.lower = row.upper = one.value.value_or(row.start);
    row.fixed = true;
  }
  const HomotopyParameters start = Start();
  for (const FixedParameter& one : fixed) {
    if (one.parameter.family == ParameterFamily::kOverlap) LeaveRoomFor(one.parameter.index, start);
  }
}

void ParameterTable::LeaveRoomFor(int junction, const HomotopyParameters& start) {
  const double overlap = Nth(start.overlaps, junction);
  if (overlap <= 0.0) return;
  const auto row_of = [this](ParameterFamily family, int half_step) -> ParameterRow& {
    return Nth(rows_, IndexOf({family, half_step}));
  };
  const auto [before, after] = NaturalBoundOf(start, junction);
  for (const auto& [half_step, fraction] : {std::pair{junction, before}, {junction + 1, after}}) {
    ParameterRow& T = row_of(ParameterFamily::kDuration, half_step);
    if (!T.fixed) T.lower = std::min(T.start, std::max(T.lower, overlap / fraction));
    ParameterRow& shift = row_of(ParameterFamily::kZmpShift, half_step);
    shift.upper = shift.start;
  }
}

HomotopyParameters ParameterTable::Start() const {
  HomotopyParameters start;
  for (const ParameterRow& row : rows_) start.of(row.parameter.family).push_back(row.start);
  return start;
}

std::string ComplaintAbout(const HalfStepSequence& sequence,
                           const std::vector<FixedParameter>& fixed) {
  PlainStream text;
  for (size_t k = 0; k < fixed.size(); ++k) {
    const HomotopyParameter& parameter = fixed[k].parameter;
    const ParameterFamilyTraits& traits = Traits(parameter.family);
    const int count = traits.count(sequence);
    text << traits.name << " " << parameter.index + 1 << ": ";
    if (parameter.index < 0 || parameter.index >= count) {
      text << "there are " << count << " (valid: 1 … " << count << ")";
      return text.str();
    }
    for (size_t other = 0; other < k; ++other) {
      if (!(fixed[other].parameter == parameter)) continue;
      text << "is fixed twice (valid: once)";
      return text.str();
    }
    const double value = fixed[k].value.value_or(traits.planned(sequence, parameter.index));
    if (!std::isfinite(value) || value < traits.least ||
        (value == traits.least && !traits.least_itself)) {
      text << value << " " << traits.unit
           << " is too small (valid: " << (traits.least_itself ? "from " : "above ") << traits.least
           << ")";
      return text.str();
    }
    if (parameter.family == ParameterFamily::kHeightScale &&
        value < LeastHeightScale(sequence, parameter.index)) {
      text << value << " is too small (valid: from " << LeastHeightScale(sequence, parameter.index)
           << ", where the foot passes no lower than it stands)";
      return text.str();
    }
    if (traits.of_form && value > traits.most) {
      text << value << " " << traits.unit << " is too large (valid: up to " << traits.most << ")";
      return text.str();
    }
    text.str("");
  }
  const HomotopyParameters start = StartOf(sequence, fixed);
  for (int i = 0; i < sequence.num_junctions(); ++i) {
    const double bound = NaturalOverlapBound(start, i);
    if (Nth(start.overlaps, i) <= bound + kOverlapTolerance) continue;
    text << "overlap " << i + 1 << ": " << Nth(start.overlaps, i)
         << " s is above its natural bound (valid: up to " << bound << " s)";
    return text.str();
  }
  return "";
}

}  // namespace halfstep
