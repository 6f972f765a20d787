// Names of methods, planners and programs for the readers of configs, without what they name.

#include "planner/search/planners.h"
#include "smoothing/methods/dichotomy.h"
#include "smoothing/methods/horizon.h"
#include "smoothing/methods/methods.h"
#include "smoothing/methods/solver_method_options.h"

namespace halfstep {

namespace {

using Groups = std::vector<DeclaredGroup>;

class NoMethod : public Smoother {
 public:
  NoMethod(std::string name, Groups groups) : name_(std::move(name)), groups_(std::move(groups)) {}
  std::string name() const override { return name_; }
  std::string meaning() const override { return ""; }
  Groups groups() const override { return groups_; }
  SmoothingResult Smooth(const WalkProblem&, const MethodOptions&,
                         SmoothingMonitor&) const override {
    return {};
  }

 private:
  std::string name_;
  Groups groups_;
};

}  // namespace

Methods Methods::Standard() {
  return Methods(
      {std::make_shared<NoMethod>("dichotomy", Groups{DichotomyGroup()}),
       std::make_shared<NoMethod>("dichotomy/published", Groups{}),
       std::make_shared<NoMethod>("halfstep/sqp", Groups{OptimizerGroup()}),
       std::make_shared<NoMethod>("halfstep/barrier", Groups{OptimizerGroup()}),
       std::make_shared<NoMethod>("halfstep/horizon", Groups{HorizonGroup(), OptimizerGroup()})});
}

Planners Planners::Standard() {
  return Planners({{"rrt", "", {}}, {"astar", "", {}}, {"bounding_box", "", {}}});
}

std::string_view Name(ProgramKind kind) {
  return kind == ProgramKind::kFastest  ? "fastest"
         : kind == ProgramKind::kSmooth ? "smooth"
                                        : "safest";
}

}  // namespace halfstep
