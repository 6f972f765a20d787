#include "experiments/references/reference_maker.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/export/hrpsys_files.h"
#include "experiments/run/experiment_run.h"
#include "experiments/tables/csv_writer.h"
#include "experiments/tables/result_tables.h"
#include "smoothing/methods/run_smoother.h"
#include "wpg/files/input_error.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep {
namespace {

namespace fs = std::filesystem;
using enum CsvType;

constexpr int kCsvFps = 50;

// A config of one step on the spot, for what all walks of a set share.
ExperimentConfig AnyConfig(const fs::path& walks, const ReferenceRequest& request) {
  return ParseConfig((walks / "any.yaml").string(),
                     "robot: " + request.robot + "\nscene: none\nsmoothing: {methods: [" +
                         request.method + "]}\nfootsteps: [{foot: left, x_m: 0, y_m: 0.1}]\n",
                     request.overrides);
}

std::string Digits(int number, int most) {
  return Formatted("%0*d", static_cast<int>(std::to_string(most).size()), number);
}

/// Where the middle between the soles goes.
struct MiddlePath {
  double length = 0.0, ahead = 0.0, aside = 0.0;  // along the way, in the middle's own axes [m]
  double turn = 0.0;                              // [rad]
};

MiddlePath PathOf(const HalfStepSequence& sequence) {
  std::array<Pose2, 2> soles = {
      Pose2{sequence.start[0].x, sequence.start[0].y, sequence.start[0].yaw},
      Pose2{sequence.start[1].x, sequence.start[1].y, sequence.start[1].yaw}};
  const auto middle = [&soles] {
    return Pose2{0.5 * (soles[0].x + soles[1].x), 0.5 * (soles[0].y + soles[1].y),
                 0.5 * (soles[0].yaw + soles[1].yaw)};
  };
  MiddlePath path;
  Pose2 before = middle();
  for (int step = 0; step < sequence.num_steps(); ++step) {
    const PlacedHalfStep& down = Nth(sequence.half_steps, 2 * step + 1);
    const Foothold X_WF = down.X_WS * down.half_step.X_SF;
    Nth(soles, down.half_step.swing()) = {X_WF.x, X_WF.y, X_WF.yaw};
    const Pose2 now = middle(), moved = before.Inverse() * now;
    path.length += moved.position().norm();
    path.ahead += moved.x;
    path.aside += moved.y;
    path.turn += moved.yaw;
    before = now;
  }
  return path;
}

}  // namespace

struct ReferenceMaker::Walk {
  DrawnReference drawn;
  std::optional<HalfStepSequence> sequence;
  std::optional<SuperposedWalk> walk;
  Certificate certificate;

  double duration() const { return drawn.stands.value_or(walk->duration()); }
  // What is proved of a family's margin: of standing at the first instant, else for all time.
  double Proved(MarginFamily family) const {
    double least = std::numeric_limits<double>::infinity();
    for (const CertificateRow& row : certificate) {
      if (row.family != family || (drawn.stands && row.begin > 0.0)) continue;
      least = std::min(least, row.margin.value - row.bound);
    }
    return least;
  }
};

ReferenceMaker::ReferenceMaker(const ReferenceRequest& request, const fs::path& folder)
    : request_(request),
      folder_(folder),
      bodies_(RobotPath(AnyConfig(folder / "walks", request)).string()) {
  experiment_ = Prepare(AnyConfig(folder / "walks", request));
  const SmoothingConfig& smoothing = experiment_->config.smoothing;
  test_ = std::make_shared<CertifiedFeasibility>(
      MarginEvaluator(experiment_->robot, experiment_->scene, smoothing.limits),
      smoothing.certification);
  for (const MarginFamily family : test_->evaluator().families()) {
    if (limits().demanded_of(family) != kNotDemanded) families_.push_back(family);
  }
}

std::string ReferenceMaker::NameOf(int number) const {
  return "ref_" + Digits(number, request_.count);
}

std::optional<std::string> ReferenceMaker::Certify(const DrawnReference& drawn,
                                                   const std::string& name,
                                                   const std::stop_token& stop, Walk* walk) const {
  ExperimentConfig config;
  try {
    config = ParseConfig((folder_ / "walks" / (name + ".yaml")).string(), drawn.config,
                         request_.overrides);
  } catch (const InputError&) {  // what was drawn is out of the range of a key
    return "config";
  }
  walk->drawn = drawn;
  if (!request_.overrides.empty()) {
    walk->drawn.config = drawn.config.substr(0, drawn.config.find('\n') + 1) +
                         ResolvedConfig(folder_ / "walks", config);
  }
  walk->sequence = SequenceOf(config, experiment_->robot, *experiment_->scene.ground);
  const WalkProblem problem(*walk->sequence, test_);
  SmoothingMonitor monitor({.stop = stop, .stop_proof = stop});
  const SmoothingResult result = RunSmoother(config.smoothing.known.Find(request_.method), problem,
                                             config.smoothing.options, monitor);
  if (stop.stop_requested()) return "stopped";
  CertifiedWalk certified =
      CertifyWalk(*test_, *walk->sequence, result.parameters, stop, /*workers=*/nullptr);
  if (certified.answer.verdict == Verdict::kUndecided) return "undecided";
  if (certified.answer.verdict == Verdict::kViolated) {
    return std::string(Name(certified.answer.witness.family));
  }
  walk->walk.emplace(*walk->sequence, result.parameters);
  walk->certificate = std::move(certified.rows);
  return std::nullopt;
}

std::vector<ReferenceFile> ReferenceMaker::FilesOf(const Walk& walk, const std::string& name,
                                                   long* frames) const {
  std::vector<ReferenceFile> files;
  for (const std::string& format : request_.formats) {
    const FrameFormat* const known = FindFrameFormat(format);
    const int fps = request_.fps.value_or(known == nullptr ? kCsvFps : known->fps);
    std::vector<BodyFrame> motion;
    if (walk.drawn.stands) {
      const long last = std::lround(std::ceil(*walk.drawn.stands * fps - 1e-9));
      motion.assign(static_cast<size_t>(last) + 1, bodies_.At(*walk.walk, 0.0, name));
      for (long k = 0; k <= last; ++k) {
        Nth(motion, k).t = static_cast<double>(k) / static_cast<double>(fps);
      }
    } else {
      motion = FramesOf(bodies_, *walk.walk, fps, name);
    }
    if (files.empty()) *frames = static_cast<long>(motion.size());
    const std::string stem = format + "/" + name;
    if (known != nullptr) {
      const FrameFileOptions options{.fps = fps, .joints = OrderedJoints(bodies_.tree(), {})};
      files.push_back({stem + known->ending, FrameFile(*known, bodies_, motion, options, stem)});
      continue;
    }
    CsvWriter csv(MotionColumns(experiment_->robot));
    for (const BodyFrame& frame : motion) {
      const double t = walk.drawn.stands ? 0.0 : std::min(frame.t, walk.walk->duration());
      std::vector<MotionCell> cells = MotionRow(experiment_->robot, *walk.walk, t);
      cells.front() = frame.t;
      for (const MotionCell& cell : cells) {
        std::visit([&csv](const auto& value) { csv.Cell(value); }, cell);
      }
      csv.EndRow();
    }
    files.push_back({stem + ".csv", csv.text()});
    files.push_back({stem + ".schema.json", SchemaJson(csv.file().columns)});
  }
  files.push_back({"walks/" + name + ".yaml", walk.drawn.config});
  return files;
}

CsvColumns ReferenceMaker::Columns() const {
  CsvColumns columns = {
      {"reference", kString, "", "its name"},
      {"file", kString, "", "its motion, from this folder; none: no draw was certified"},
      {"kind", kString, "", "of motion that was drawn"},
      {"verdict", kString, "", "certified, or refused: no draw was"},
      {"refused", kInteger, "", "draws before it that were not certified"},
      {"frames", kInteger, "", "of the file"},
      {"duration_s", kNumber, "s", "of the motion"},
      {"mean_speed_m_s", kNumber, "m/s", "way of the middle between the soles over the duration"},
      {"mean_ahead_m_s", kNumber, "m/s", "of that along the middle's x"},
      {"mean_aside_m_s", kNumber, "m/s", "of that along its y, to the left"},
      {"mean_yaw_rate_rad_s", kNumber, "rad/s", "turn of the middle over the duration"},
      {"left_steps", kInteger, "", "of the left foot"},
      {"right_steps", kInteger, "", "of the right foot"},
  };
  for (const MarginFamily family : families_) {
    columns.push_back({"least_" + std::string(Name(family)), kNumber, std::string(Unit(family)),
                       "margin of " + std::string(Name(family)) + " that is proved for all time"});
  }
  return columns;
}

std::string ReferenceMaker::RowOf(const Walk& walk, const std::string& name, int refused,
                                  long frames) const {
  CsvWriter csv(Columns());
  const size_t header = csv.text().size();
  const double duration = walk.duration();
  const MiddlePath path = walk.drawn.stands ? MiddlePath{} : PathOf(*walk.sequence);
  std::array<int, 2> steps{};
  for (int step = 0; !walk.drawn.stands && step < walk.sequence->num_steps(); ++step) {
    ++Nth(steps, Nth(walk.sequence->half_steps, 2 * step).half_step.swing());
  }
  const std::string& format = request_.formats.front();
  const FrameFormat* const known = FindFrameFormat(format);
  csv.Cell(name).Cell(format + "/" + name + (known == nullptr ? ".csv" : known->ending));
  csv.Cell(walk.drawn.kind).Cell("certified").Cell(refused).Cell(frames).Cell(duration);
  csv.Cell(path.length / duration).Cell(path.ahead / duration).Cell(path.aside / duration);
  csv.Cell(path.turn / duration).Cell(steps[0]).Cell(steps[1]);
  for (const MarginFamily family : families_) csv.Cell(walk.Proved(family));
  csv.EndRow();
  return csv.text().substr(header);
}

std::string ReferenceMaker::RowWithout(const std::string& name) const {
  CsvWriter csv(Columns());
  const size_t header = csv.text().size();
  csv.Cell(name).Cell("none").Cell("none").Cell("refused").Cell(kMostDraws).Cell(0);
  for (int k = 0; k < 5; ++k) csv.Empty();
  csv.Cell(0).Cell(0);
  for (size_t k = 0; k < families_.size(); ++k) csv.Empty();
  csv.EndRow();
  return csv.text().substr(header);
}

std::optional<MadeReference> ReferenceMaker::Make(int number, const std::stop_token& stop) const {
  const std::string name = NameOf(number);
  std::seed_seq seeds{request_.seed, number};
  std::mt19937_64 random(seeds);
  MadeReference made;
  for (int draw = 0; draw < kMostDraws; ++draw) {
    Walk walk;
    const DrawnReference drawn =
        DrawReference({name, request_.robot, request_.method}, number, experiment_->robot, random);
    const std::optional<std::string> missed = Certify(drawn, name, stop, &walk);
    if (stop.stop_requested()) return std::nullopt;
    if (missed) {
      ++made.refused[*missed];
      continue;
    }
    long frames = 0;
    made.files = FilesOf(walk, name, &frames);
    made.row = RowOf(walk, name, draw, frames);
    made.certified = true;
    return made;
  }
  made.row = RowWithout(name);
  return made;
}

}  // namespace halfstep
