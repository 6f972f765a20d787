#pragma once

#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

#include "experiments/config/experiment.h"
#include "experiments/tables/certificate_statement.h"
#include "experiments/tables/csv_columns.h"
#include "experiments/tables/run_folder.h"
#include "smoothing/proof/certified_feasibility.h"
#include "wpg/workers.h"

namespace halfstep {

/// The proof about one method's walk, and its verdict.
struct CertifiedWalk {
  Feasibility answer;     ///< whether every demanded margin is proved
  Certificate rows;       ///< by interval and family
  double duration = 0.0;  ///< [s]
};

/// Certifies the walk of `parameters` over all its time; undecided when stopped before. `workers`,
/// which may be null, share the work.
CertifiedWalk CertifyWalk(const CertifiedFeasibility& test, const HalfStepSequence& sequence,
                          const HomotopyParameters& parameters, const std::stop_token& stop,
                          Workers* workers = nullptr);

/// "certified", "violated" or "undecided".
std::string_view VerdictName(Verdict verdict);

/// Columns of certificate.csv: experiments/files.md.
CsvColumns CertificateColumns();
/// certificate.csv.
CsvFile CertificateCsv(const MarginEvaluator& evaluator, const Certificate& rows);

/// Text of certificate.json: verdict, the statement, what was demanded, counts of statements, what
/// is not covered (NotCoveredBy), and SHA-256 of everything that the certificate is about, as it
/// was parsed. The files of robot and scene lie where `named`, the run's own config, says; paths
/// are relative to `run_folder`.
std::string CertificateJson(const Experiment& experiment, const CertifiedFeasibility& test,
                            const CertifiedWalk& walk, const ExperimentConfig& named,
                            const std::filesystem::path& run_folder,
                            const std::string& trajectory_csv, const std::string& certificate_csv);

/// Writes certificate.csv, its schema and certificate.json into a method's folder, `place`
/// ("dichotomy/"), of a run whose own config is `named`.
void WriteCertificate(const Experiment& experiment, const CertifiedFeasibility& test,
                      const CertifiedWalk& walk, const ExperimentConfig& named,
                      const std::string& trajectory_csv, const std::string& place,
                      RunFolder* folder);

}  // namespace halfstep
