#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "experiments/config/experiment.h"
#include "experiments/export/frame_files.h"
#include "experiments/references/drawn_reference.h"
#include "experiments/tables/certificate_files.h"
#include "experiments/tables/csv_columns.h"
#include "smoothing/proof/certified_feasibility.h"

namespace halfstep {

/// What reference motions are asked for.
struct ReferenceRequest {
  std::string robot;                             ///< name or file, as the configs shall name it
  std::string method = "dichotomy";              ///< of smoothing
  std::vector<std::string> formats = {"mjlab"};  ///< names of FrameFormats(), or "csv"
  std::optional<int> fps;                        ///< [1/s]; none: that of each format, of csv 50
  std::vector<YamlOverride> overrides;           ///< of the config of every walk
  int count = 1000;                              ///< how many
  int seed = 1;                                  ///< of the draws
};

/// A file of a reference.
struct ReferenceFile {
  std::string path;   ///< from the folder of the set: "mjlab/ref_0001.npz"
  std::string bytes;  ///< all of it
};

/// A reference, or that none was found.
struct MadeReference {
  std::string row;                   ///< of index.csv, with its line break
  std::vector<ReferenceFile> files;  ///< motions and config; none: no draw was certified
  /// Draws before it that were not, by the family of margins that they missed; `undecided`; or
  /// `config` where a number that was drawn is out of its key's range.
  std::map<std::string, int> refused;
  bool certified = false;  ///< whether there is one
};

/// Draws, smooths, certifies and exports references. Each depends on the request and its number
/// alone. Const: threads may share one.
class ReferenceMaker {
 public:
  /// Loads the robot. `folder` is that of the set: the robot's path is relative to its `walks`.
  /// Throws InputError.
  ReferenceMaker(const ReferenceRequest& request, const std::filesystem::path& folder);

  /// "ref_0001": with as many digits as the count has.
  std::string NameOf(int number) const;
  /// Makes reference `number`, from 1: the first of kMostDraws draws that is certified. None when
  /// told to stop.
  std::optional<MadeReference> Make(int number, const std::stop_token& stop) const;

  /// Columns of index.csv, least proved margins of all families that are demanded among them.
  CsvColumns Columns() const;
  const Experiment& experiment() const { return *experiment_; }  ///< of a walk without footsteps
  const MarginLimits& limits() const { return test_->evaluator().limits(); }  ///< that are proved

  static constexpr int kMostDraws = 100;  ///< for one reference

 private:
  struct Walk;
  // None: certified, and `walk` is filled. Else what is missed.
  std::optional<std::string> Certify(const DrawnReference& drawn, const std::string& name,
                                     const std::stop_token& stop, Walk* walk) const;
  std::vector<ReferenceFile> FilesOf(const Walk& walk, const std::string& name, long* frames) const;
  std::string RowOf(const Walk& walk, const std::string& name, int refused, long frames) const;
  std::string RowWithout(const std::string& name) const;

  ReferenceRequest request_;
  std::filesystem::path folder_;
  BodyMotion bodies_;
  std::optional<Experiment> experiment_;
  std::shared_ptr<const CertifiedFeasibility> test_;
  std::vector<MarginFamily> families_;  // that are demanded
};

}  // namespace halfstep
