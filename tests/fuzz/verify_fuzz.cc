// What `verify` reads (`export` and `replay` read the trajectory too), and the arithmetic of its
// certificate, manifest, overlaps and summary: the robot is loaded once, and distances are not
// asked.

#include "experiments/tables/trajectory_file.h"
#include "experiments/verify/check_certificate.h"
#include "experiments/verify/check_overlaps.h"
#include "experiments/verify/check_summary.h"
#include "experiments/verify/played_motion.h"
#include "tests/fuzz/files.h"
#include "tests/fuzz/fuzz.h"
#include "tests/places.h"

using namespace halfstep;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const RobotModel robot = LoadRobot(InSources("wpg/robots/hrp2.yaml"));
  auto files = fuzz::Files(fuzz::Text(data, size));
  const std::string& trajectory = files["trajectory.csv"];
  fuzz::Reads("trajectory.csv", [&] {
    const std::vector<TrajectoryRow> rows = ParseTrajectory("trajectory.csv", trajectory, robot);
    fuzz::Require(rows.size() > 1 && rows[0].t < rows[1].t, "no motion", trajectory);
  });
  verify::CertificateText certificate;
  std::vector<verify::ClaimRow> claims;
  std::vector<verify::PlayedRow> rows;
  const bool all = fuzz::Reads("", [&] {
    certificate = verify::ReadCertificateJson("certificate.json", files["certificate.json"]);
    claims = verify::ReadCertificateCsv("certificate.csv", files["certificate.csv"]);
    rows = verify::ReadTrajectory("trajectory.csv", trajectory, robot);
  });
  verify::Findings findings;
  verify::RunManifest manifest;
  const bool has_manifest = fuzz::Reads(
      "", [&] { manifest = verify::ReadManifest("manifest.json", files["manifest.json"]); });
  fuzz::Reads("", [&] {
    const auto half_steps = verify::ReadHalfSteps("half_steps.csv", files["half_steps.csv"]);
    const auto overlaps = verify::ReadOverlaps("overlaps.csv", files["overlaps.csv"]);
    (void)verify::CheckOverlaps(half_steps, overlaps, {}, &findings);
  });
  fuzz::Reads("", [&] {
    const auto footsteps = verify::ReadFootsteps("footsteps.csv", files["footsteps.csv"]);
    verify::CheckFootsteps(footsteps, {}, &findings);
  });
  fuzz::Reads("", [&] {
    const auto summary = verify::ReadSummary("summary.csv", files["summary.csv"]);
    if (all && has_manifest && manifest.HasFolder("dichotomy")) {
      verify::CheckSummary(summary, manifest, "dichotomy", certificate, 1, &findings);
    }
  });
  if (!all) return 0;
  verify::CheckAgainstConfig(certificate, robot, {}, &findings);
  verify::CheckArithmetic(certificate, claims, robot, Scene{}, rows.empty() ? 0 : rows.back().t,
                          &findings);
  return 0;
}
