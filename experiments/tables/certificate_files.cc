#include "experiments/tables/certificate_files.h"

#include <nlohmann/json.hpp>

#include "experiments/tables/answer_words.h"
#include "experiments/tables/csv_writer.h"
#include "experiments/tables/not_covered_json.h"
#include "experiments/tables/tube_json.h"
#include "smoothing/margins/not_covered_by.h"
#include "wpg/files/sha256.h"

namespace halfstep {
namespace {

using nlohmann::ordered_json;

ordered_json OrNull(const std::optional<double>& value) {
  return value ? ordered_json(*value) : ordered_json(nullptr);
}

}  // namespace

CertifiedWalk CertifyWalk(const CertifiedFeasibility& test, const HalfStepSequence& sequence,
                          const HomotopyParameters& parameters, const std::stop_token& stop,
                          Workers* workers) {
  const SuperposedWalk walk(sequence, parameters);
  MarginEvaluator::Scratch scratch = test.evaluator().MakeScratch();
  scratch.workers = workers;
  CertifiedWalk certified;
  certified.duration = walk.duration();
  certified.answer = test.Certify(walk, &scratch, &certified.rows, stop);
  return certified;
}

std::string_view VerdictName(Verdict verdict) {
  switch (verdict) {
    case Verdict::kFeasible:
      return "certified";
    case Verdict::kViolated:
      return "violated";
    case Verdict::kUndecided:
      return "undecided";
  }
  return "";
}

CsvColumns CertificateColumns() {
  using enum CsvType;
  const std::string unit = "unit of the family";
  return {
      {"begin_s", kNumber, "s", "begin of the interval"},
      {"end_s", kNumber, "s", "its end"},
      {"family", kString, "", "of margins"},
      {"statements", kInteger, "", "of the family that hold on the whole interval by this row"},
      {"subject", kString, "", "of the statement with the least to spare"},
      {"margin", kNumber, unit, "its value at the midpoint"},
      {"bound", kNumber, unit, "by how much at most it changes from there within the interval"},
      {"demanded", kNumber, unit, "margin - bound is at least this"},
  };
}

CsvFile CertificateCsv(const MarginEvaluator& evaluator, const Certificate& rows) {
  CsvWriter csv(CertificateColumns());
  for (const CertificateRow& row : rows) {
    csv.Cell(row.begin).Cell(row.end).Cell(Name(row.family)).Cell(row.count);
    csv.Cell(evaluator.Subject(row.margin)).Cell(row.margin.value).Cell(row.bound);
    csv.Cell(evaluator.limits().demanded_of(row.family)).EndRow();
  }
  return csv.file();
}

std::string CertificateJson(const Experiment& experiment, const CertifiedFeasibility& test,
                            const CertifiedWalk& walk, const ExperimentConfig& named,
                            const std::filesystem::path& run_folder,
                            const std::string& trajectory_csv, const std::string& certificate_csv) {
  const MarginLimits& limits = test.evaluator().limits();
  ordered_json demanded, statements;
  for (const MarginFamily family : test.evaluator().families()) {
    const double least = limits.demanded_of(family);
    demanded[std::string(Name(family))] =
        OrNull(least == kNotDemanded ? std::nullopt : std::optional<double>(least));
    statements[std::string(Name(family))] = test.CountOf(family);
  }
  const RobotModel& robot = experiment.robot;
  ordered_json of_limits = {{"foot_speed_m_s", OrNull(limits.foot_speed)},
                            {"foot_yaw_rate_rad_s", OrNull(limits.foot_yaw_rate)},
                            {"joint_speed_scale", limits.joint_speed_scale}};
  if (robot.assumed_acceleration) {
    of_limits["joint_acceleration_rad_s2"] = robot.assumed_acceleration->limit;
  }
  if (limits.landing_speed) of_limits["landing_speed_m_s"] = *limits.landing_speed;
  const bool certified = walk.answer.verdict == Verdict::kFeasible;
  const auto scene = ScenePath(named);
  const bool has_tube = limits.tube != Tube{};
  ordered_json json = {
      {"format", 2},
      {"verdict", VerdictName(walk.answer.verdict)},
      {"message", certified ? "every demanded margin is kept at all times"
                            : AnswerWords(test.evaluator(), test.options(), walk.answer)},
      {"statement", CertificateStatement(robot, limits, *experiment.scene.ground)},
      {"duration_s", walk.duration},
      {"resolution_s", test.options().resolution},
      {"demanded", demanded},
      {"limits", of_limits},
      {"statements", statements},
      {"not_covered", NotCoveredJson(NotCoveredBy(robot, experiment.scene, limits))},
      {"robot", std::filesystem::proximate(RobotPath(named), run_folder).string()},
      {"scene", scene ? std::filesystem::proximate(*scene, run_folder).string() : "none"},
      {"sha256",
       {{"trajectory.csv", Sha256(trajectory_csv)},
        {"certificate.csv", Sha256(certificate_csv)},
        {"robot", CombinedSha256(experiment.robot.files)},
        {"scene", CombinedSha256(experiment.scene.files)}}}};
  if (has_tube) json["tube"] = TubeJson(test.evaluator());
  return json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

void WriteCertificate(const Experiment& experiment, const CertifiedFeasibility& test,
                      const CertifiedWalk& walk, const ExperimentConfig& named,
                      const std::string& trajectory_csv, const std::string& place,
                      RunFolder* folder) {
  const CsvFile csv = CertificateCsv(test.evaluator(), walk.rows);
  WriteCsv(place + "certificate", csv, folder);
  folder->Write(
      place + "certificate.json",
      CertificateJson(experiment, test, walk, named, folder->path(), trajectory_csv, csv.text));
}

}  // namespace halfstep
