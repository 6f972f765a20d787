#include "experiments/verify/check_summary.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "experiments/config/known_names.h"

namespace halfstep::verify {
namespace {

// The families of kMarginColumns.
constexpr std::array<Family, kNumMarginColumns> kFamilyOfColumn = {
    kZmp,           kJoint,    kJointSpeed, kFootSpeed, kClearance,
    kSelfClearance, kZmpRobot, kTorque,     kFriction,  kJointAcceleration};

constexpr double kRatioRounding = 1e-12;  // of ratios that are computed twice

}  // namespace

void CheckWorstMargin(const std::vector<SummaryRow>& summary, const std::string& folder,
                      const std::vector<PlayedRow>& rows, const RobotModel& robot,
                      const CertificateText& certificate, const MarginLimits& config,
                      Findings* findings) {
  const auto row = std::ranges::find_if(
      summary, [&](const SummaryRow& one) { return FolderOfMethod(one.method) == folder; });
  if (row == summary.end() || rows.empty()) return;  // CheckSummary says so
  double nearest = std::numeric_limits<double>::infinity(), named = nearest;
  std::string name;
  std::optional<double> least_named;
  for (const auto& [of, demanded, scale] : NamedDemands(config)) {
    const auto column =
        std::ranges::find(kFamilyOfColumn, of, [](Family one) { return kFamilyNames[one]; });
    const bool has_column =
        column != kFamilyOfColumn.end() &&
        static_cast<size_t>(column - kFamilyOfColumn.begin()) < NumMarginColumns(robot);
    if (of == row->worst_family) {
      named = (row->worst_margin - demanded) / scale;
    }
    if (!has_column || certificate.demanded[*column] == kNotDemanded) continue;
    const auto k = static_cast<size_t>(column - kFamilyOfColumn.begin());
    double least = std::numeric_limits<double>::infinity();
    for (const PlayedRow& played : rows) least = std::min(least, played.margins[k]);
    if (of == row->worst_family) least_named = least;
    const double slack = (least - demanded) / scale;
    if (slack < nearest) {
      nearest = slack;
      name = of;
    }
  }
  if (least_named && *least_named != row->worst_margin) {
    findings->Disagree("summary.csv: " + row->method + ": worst_margin " +
                       Formatted("is %.9g, but the least %s of trajectory.csv %.9g",
                                 row->worst_margin, row->worst_family.c_str(), *least_named));
  }
  // The formula of a margin that another program registered is not known here.
  const bool is_own = row->worst_family == kFamilyNames[kOwn];
  if (!is_own && !(named <= nearest + kRatioRounding)) {
    findings->Disagree("summary.csv: " + row->method + ": worst_margin_name is " +
                       Quote(row->worst_family) + ", but " + name + " is nearer to its limit");
  }
}

void CheckSummary(const std::vector<SummaryRow>& rows, const RunManifest& manifest,
                  const std::string& folder, const CertificateText& certificate, long iterations,
                  Findings* findings) {
  findings->Say("summary.csv: " + Count(std::ssize(rows)) + " methods");
  bool same = rows.size() == manifest.methods.size();
  for (size_t i = 0; same && i < rows.size(); ++i) {
    same = rows[i].method == manifest.methods[i].name;
  }
  if (!same || rows.empty()) {
    findings->Disagree("summary.csv: its methods are not those of manifest.json");
    return;
  }
  const SummaryRow *row = nullptr, *reference = nullptr;
  for (const SummaryRow& one : rows) {
    if (FolderOfMethod(one.method) == folder) row = &one;
    if (one.method == "reference") reference = &one;
  }
  if (row == nullptr) return;  // CheckRun says so
  const auto disagree = [&](const char* column, const std::string& why) {
    findings->Disagree("summary.csv: " + row->method + ": " + column + " " + why);
  };
  const auto close = [](double a, double b) {
    return std::abs(a - b) <= kRatioRounding * std::max(1.0, std::abs(b));
  };
  if (row->status != manifest.MethodOf(folder)->status) {
    disagree("status", "is not that of manifest.json");
  }
  if (row->certified != (certificate.verdict == "certified")) {
    disagree("certified", "is not the certificate's verdict");
  }
  if (row->duration != certificate.duration) {
    disagree("duration_s",
             Formatted("is %.9g, the certificate has %.9g", row->duration, certificate.duration));
  }
  if (!close(row->speedup, rows.front().duration / row->duration)) {
    disagree("speedup", "is not the duration of raw divided by this one's");
  }
  if (manifest.objective == "fastest" && !close(row->cost, row->duration)) {
    disagree("cost", "is not the duration");
  }
  if (row->iterations != iterations) {
    disagree("iterations",
             Formatted("is %ld, iterates.csv has %ld rows", row->iterations, iterations));
  }
  if (row->gap_to_reference.has_value() != (reference != nullptr) ||
      (reference != nullptr &&
       !close(*row->gap_to_reference, row->duration / reference->duration - 1))) {
    disagree("gap_to_reference", "is not the duration divided by that of `reference`, less 1");
  }
  // The bound itself is not proved again, but there is one for all methods.
  for (const SummaryRow& one : rows) {
    if (!row->gap_lipm || !one.gap_lipm) continue;
    const double bound = row->duration / (1 + *row->gap_lipm);
    if (!(bound > 0) || !close(one.duration / (1 + *one.gap_lipm) / bound, 1)) {
      disagree("gap_lipm", "is above another bound than that of " + one.method);
      break;
    }
  }
}

}  // namespace halfstep::verify
