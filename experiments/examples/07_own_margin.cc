// 07: a margin of one's own: no speed of the CoM above 0.3 m/s, at any time.
#include <halfstep/experiments/halfstep.h>

#include <cstdio>

using namespace halfstep;

class ComSpeed : public OwnStatement {
 public:
  std::string name() const override { return "CoM's speed"; }
  double scale() const override { return 0.1; }  // [m/s]
  double Value(Instant* at) const override { return 0.3 - Velocity(at->jet()).norm(); }
  // The speed changes no more than the largest acceleration times half of the interval, and what
  // rounding did to it at the midpoint.
  double Change(const MarginInterval& interval) const override {
    const IntervalMotion& motion = interval.motion;
    return motion.half_width * motion.second.segment<2>(kComX).norm() + Velocity(motion.off).norm();
  }
  std::vector<double> Slopes(Instant* at,
                             const std::vector<WalkSensitivity>& along) const override {
    const Eigen::Vector2d v = Velocity(at->jet());
    std::vector<double> slopes;
    for (const WalkSensitivity& s : along) {
      slopes.push_back(-v.dot(Velocity(s.jet)) / std::max(v.norm(), 1e-9));
    }
    return slopes;
  }

 private:
  static Eigen::Vector2d Velocity(const WalkJet& jet) { return jet.first.segment<2>(kComX); }
};

int main(int argc, char** argv) {
  const bool limited = argc < 2 || std::string(argv[1]) != "without";
  Methods methods = Methods::Standard();
  if (limited) methods.AddMargin(std::make_shared<ComSpeed>());
  if (argc > 2) return RunExperiment(argc, argv, {methods});  // `run CONFIG` keeps it, too
  const ExperimentConfig config =
      LoadConfig((DataFolder() / "configs/bar_8cm.yaml").string(),
                 {{"smoothing.optimizer.all_families", "false"}}, {methods});
  const WalkProblem problem = ProblemOf(Prepare(config));
  SmoothingMonitor monitor;
  const SmoothingResult result =
      methods.Find("halfstep/sqp").Smooth(problem, config.smoothing.options, monitor);
  const SuperposedWalk walk(problem.sequence(), result.parameters);
  double fastest = 0.0;
  for (double t = 0.0; t < walk.duration(); t += 0.001) {
    fastest = std::max(fastest, walk.At(t).first.segment<2>(kComX).norm());
  }
  std::printf("%.3f s, CoM at most %.4f m/s at samples\n", walk.duration(), fastest);
  for (const JunctionResult& junction : result.junctions) {
    if (!junction.limited_by) continue;
    std::printf("an overlap is limited by %s\n",
                problem.evaluator().Describe(*junction.limited_by).c_str());
  }
}
