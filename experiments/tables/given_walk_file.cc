#include "experiments/tables/given_walk_file.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "experiments/tables/given_table.h"
#include "experiments/tables/parameter_tables.h"
#include "experiments/tables/result_tables.h"
#include "wpg/files/input_error.h"
#include "wpg/files/number_text.h"
#include "wpg/files/text.h"

namespace halfstep {
namespace {

constexpr double kSameAsWalk = 1e-9;  // columns that tell what the walk has anyway

/// Reads the two tables into the parameters of a sequence.
class GivenWalkReader {
 public:
  /// Of a run's tables: `whole`, none of the columns that every run writes may be left out.
  /// `before`: half-steps of the walk that are before the sequence.
  GivenWalkReader(const HalfStepSequence& sequence, const std::vector<FixedParameter>& fixed,
                  bool whole, int before = 0)
      : sequence_(sequence),
        fixed_(fixed),
        whole_(whole),
        before_(static_cast<size_t>(before)),
        walk_(ParameterTable(sequence, fixed).Start()) {}

  HomotopyParameters Read(const GivenWalkFiles& files) {
    if (!files.overlaps.empty()) {
      overlaps_.emplace(files.overlaps, OverlapsColumns(),
                        static_cast<size_t>(sequence_.num_junctions()), "junctions", &complaints_,
                        before_ > 0 ? 1 : 0);
      CheckRowNames(&*overlaps_, "junction", [](size_t i) {
        return KindOfJunction(static_cast<int>(i)) == JunctionKind::kUpDown ? "up_down" : "down_up";
      });
    }
    if (!files.half_steps.empty()) {
      half_steps_.emplace(files.half_steps, HalfStepsColumns(HalfStepsExtent::kHeights),
                          sequence_.half_steps.size(), "half-steps", &complaints_);
      CheckRowNames(&*half_steps_, "half_step", [this](size_t i) {
        return sequence_.half_steps[i].half_step.kind == HalfStepKind::kUp ? "up" : "down";
      });
      CheckTexts(&*half_steps_, "support", [this](size_t i) {
        return std::string(Name(sequence_.half_steps[i].half_step.support));
      });
    }
    for (const ParameterFamily family : AllParameterFamilies()) ReadFamily(family);
    complaints_.ThrowIfAny();
    CheckNaturalBounds();
    if (overlaps_) CheckWhatOverlapsTell();
    complaints_.ThrowIfAny();
    return walk_;
  }

 private:
  GivenTable* TableOf(ParameterFamily family) {
    std::optional<GivenTable>& table = Traits(family).joins() ? overlaps_ : half_steps_;
    return table ? &*table : nullptr;
  }
  // Whether a table says the values of a family.
  bool IsGiven(ParameterFamily family) {
    const GivenTable* const table = TableOf(family);
    return table != nullptr && table->Find(std::string(Traits(family).column));
  }

  template <typename Expected>
  void CheckTexts(GivenTable* table, const std::string& name, const Expected& expected) {
    const std::optional<size_t> column = table->Find(name);
    if (!column) return;
    for (size_t row = 0; row < table->num_rows(); ++row) {
      const std::string valid = expected(row);
      if (table->Cell(row, *column) == valid) continue;
      table->Complain(row + 1, *column,
                      Quote(table->Cell(row, *column)) +
                          " is not what the footsteps make of it (valid: " + valid + ")");
    }
  }
  template <typename Kind>
  void CheckRowNames(GivenTable* table, const std::string& index, const Kind& kind) {
    CheckTexts(table, index, [this](size_t row) { return std::to_string(before_ + row + 1); });
    CheckTexts(table, "kind", [&kind](size_t row) { return std::string(kind(row)); });
  }

  void ReadFamily(ParameterFamily family) {
    const ParameterFamilyTraits& traits = Traits(family);
    if (!IsGiven(family)) {
      GivenTable* const left_out = whole_ && !traits.of_form ? TableOf(family) : nullptr;
      if (left_out != nullptr) left_out->ComplainOfMissing(std::string(traits.column));
      return;
    }
    GivenTable& table = *TableOf(family);
    const size_t column = *table.Find(std::string(traits.column));
    int before = -1;
    for (size_t row = 0; row < table.num_rows(); ++row) {
      const std::optional<double> value = table.Number(row, column);
      if (!value) continue;
      const HomotopyParameter parameter{family, traits.index_at(static_cast<int>(row))};
      const std::string mistake = parameter.index == before && *value != parameter.in(walk_)
                                      ? "differs from the row before, of the same step (valid: " +
                                            ShortestText(parameter.in(walk_)) + ")"
                                      : MistakeOf(parameter, *value);
      if (!mistake.empty()) {
        table.Complain(row + 1, column, ShortestText(*value) + " " + mistake);
        continue;
      }
      parameter.in(walk_) = *value;
      before = parameter.index;
    }
  }

  std::string MistakeOf(const HomotopyParameter& parameter, double value) const {
    const ParameterFamilyTraits& traits = Traits(parameter.family);
    const bool too_small = value < traits.least || (value == traits.least && !traits.least_itself);
    if (too_small || value > traits.most) {
      std::string valid = (traits.least_itself ? "from " : "above ") + ShortestText(traits.least);
      if (std::isfinite(traits.most)) valid += " up to " + ShortestText(traits.most);
      return std::string(too_small ? "is too small" : "is too large") + " (valid: " + valid + ")";
    }
    for (const FixedParameter& fixed : fixed_) {
      if (!(fixed.parameter == parameter) || parameter.in(walk_) == value) continue;
      return "is not where smoothing.fixed has it (valid: " + ShortestText(parameter.in(walk_)) +
             ")";
    }
    return "";
  }

  // An overlap that is too long for the durations beside it, told where it is said, or else where
  // the duration before it is.
  void CheckNaturalBounds() {
    for (int i = 0; i < sequence_.num_junctions(); ++i) {
      const size_t row = static_cast<size_t>(i);
      const double overlap = walk_.overlaps[row];
      const double bound = NaturalOverlapBound(walk_, i);
      if (overlap <= bound + kOverlapTolerance) continue;
      const ParameterFamily told = IsGiven(ParameterFamily::kOverlap) ? ParameterFamily::kOverlap
                                                                      : ParameterFamily::kDuration;
      GivenTable& table = *TableOf(told);
      table.Complain(row + 1, *table.Find(std::string(Traits(told).column)),
                     "overlap " + std::to_string(i + 1) + " is " + ShortestText(overlap) +
                         " s, above its natural bound (valid: up to " + ShortestText(bound) +
                         " s with these durations)");
    }
  }

  // overlaps.csv tells durations and height scales besides, which must be those of the walk where
  // no half_steps.csv says them: else the file is of a walk that was not given whole.
  void CheckWhatOverlapsTell() {
    const auto check = [this](const std::string& name, ParameterFamily family, size_t offset) {
      const std::optional<size_t> column = overlaps_->Find(name);
      if (!column || IsGiven(family)) return;
      for (size_t row = 0; row < overlaps_->num_rows(); ++row) {
        const std::optional<double> told = overlaps_->Number(row, *column);
        const HomotopyParameter parameter{family,
                                          Traits(family).index_at(static_cast<int>(row + offset))};
        if (!told || std::abs(*told - parameter.in(walk_)) <= kSameAsWalk) continue;
        overlaps_->Complain(row + 1, *column,
                            ShortestText(*told) + " is not that of the walk, " +
                                ShortestText(parameter.in(walk_)) +
                                " (valid: the walk's, or half_steps.csv with " +
                                std::string(Traits(family).column) + " besides)");
      }
    };
    check("duration_before_s", ParameterFamily::kDuration, 0);
    check("duration_after_s", ParameterFamily::kDuration, 1);
    check("height_scale_before", ParameterFamily::kHeightScale, 0);
    check("height_scale_after", ParameterFamily::kHeightScale, 1);
  }

  const HalfStepSequence& sequence_;
  const std::vector<FixedParameter>& fixed_;
  const bool whole_;
  const size_t before_;
  HomotopyParameters walk_;
  Complaints complaints_;
  std::optional<GivenTable> overlaps_, half_steps_;
};

}  // namespace

HomotopyParameters ReadGivenWalk(const GivenWalkFiles& files, const HalfStepSequence& sequence,
                                 const std::vector<FixedParameter>& fixed) {
  return GivenWalkReader(sequence, fixed, /*whole=*/false).Read(files);
}

HomotopyParameters ReadParameters(const std::filesystem::path& folder,
                                  const HalfStepSequence& sequence, int before) {
  const auto found = [&folder](const char* table) {
    return std::filesystem::exists(folder / table) ? (folder / table).string() : "";
  };
  const std::vector<FixedParameter> none;
  return GivenWalkReader(sequence, none, /*whole=*/true, before)
      .Read({.overlaps = found("overlaps.csv"), .half_steps = found("half_steps.csv")});
}

GivenWalkFiles SortGivenFiles(const std::vector<std::string>& paths) {
  GivenWalkFiles files;
  Complaints complaints;
  for (const std::string& path : paths) {
    const std::vector<std::string> header = ParseCsv(PlainCsvText(path), path).header;
    // Most of a file's columns are those of its table.
    const auto is_like = [&header](const CsvColumns& columns) {
      const auto known = std::ranges::count_if(columns, [&header](const CsvColumn& column) {
        return column.name != "kind" && std::ranges::find(header, column.name) != header.end();
      });
      return 2 * known >= std::ssize(header);
    };
    const bool of_overlaps = is_like(OverlapsColumns());
    if (!of_overlaps && !is_like(HalfStepsColumns(HalfStepsExtent::kHeights))) {
      complaints.Add(path, 1, 1, "--given",
                     "has neither overlaps nor half-steps (valid: columns of overlaps.csv, as "
                     "overlap_s, or of half_steps.csv, as duration_s)");
      continue;
    }
    std::string& file = of_overlaps ? files.overlaps : files.half_steps;
    if (!file.empty()) {
      complaints.Add(path, 1, 1, "--given",
                     std::string("is a second file of ") +
                         (of_overlaps ? "overlaps" : "half-steps") + " beside " + Quote(file) +
                         " (valid: one of each)");
    }
    file = path;
  }
  complaints.ThrowIfAny();
  return files;
}

}  // namespace halfstep
