#include "opt/adapters/ipopt_solver.h"

#include <IpIpoptApplication.hpp>
#include <IpIpoptCalculatedQuantities.hpp>
#include <IpIpoptData.hpp>
#include <IpOrigIpoptNLP.hpp>
#include <IpTNLP.hpp>
#include <IpTNLPAdapter.hpp>
#include <chrono>
#include <cmath>
#include <mutex>
#include <utility>

#include "opt/problem/plain_stream.h"
#include "opt/solvers/option_text.h"
#include "opt/solvers/solve_monitor.h"

namespace halfstep::opt {
namespace {

// Of each Jacobian: Ipopt factorizes, once an iteration, a symmetric matrix that holds it and
// fills.
constexpr int kIpoptPasses = 350;
constexpr double kIpoptInfinity = 2e19;  // beyond nlp_upper_bound_inf = 1e19

/// MUMPS is not thread-safe: one solve at a time in the whole process.
std::timed_mutex& OneSolve() {
  static std::timed_mutex mutex;
  return mutex;
}

/// Translates, and adds nothing. Returning false from an evaluation makes Ipopt shorten the step.
class Adapter : public Ipopt::TNLP {
 public:
  Adapter(SolveMonitor* monitor, const Eigen::VectorXd& start)
      : monitor_(*monitor), problem_(monitor->problem()), start_(start), final_(start) {}

  const Eigen::VectorXd& final_x() const { return final_; }

  bool get_nlp_info(int& n, int& m, int& nnz_jac_g, int& nnz_h_lag,
                    IndexStyleEnum& style) override {
    n = problem_.num_variables();
    m = problem_.num_constraints();
    nnz_jac_g = static_cast<int>(problem_.pattern().rows.size());
    nnz_h_lag = 0;
    style = C_STYLE;
    return true;
  }

  bool get_bounds_info(int n, double* x_l, double* x_u, int m, double* g_l, double* g_u) override {
    const auto copy = [](const Eigen::VectorXd& from, int size, double* to) {
      Eigen::Map<Eigen::VectorXd>(to, size) =
          from.cwiseMax(-kIpoptInfinity).cwiseMin(kIpoptInfinity);
    };
    copy(problem_.lower(), n, x_l);
    copy(problem_.upper(), n, x_u);
    copy(problem_.constraint_lower(), m, g_l);
    copy(problem_.constraint_upper(), m, g_u);
    return true;
  }

  bool get_starting_point(int n, bool init_x, double* x, bool init_z, double*, double*, int,
                          bool init_lambda, double*) override {
    if (init_x) Eigen::Map<Eigen::VectorXd>(x, n) = start_;
    return !init_z && !init_lambda;
  }

  bool eval_f(int n, const double* x, bool, double& value) override {
    return monitor_.Cost(At(n, x), &value);
  }

  bool eval_grad_f(int n, const double* x, bool, double* gradient) override {
    Eigen::VectorXd value;
    if (!monitor_.Gradient(At(n, x), &value)) return false;
    Eigen::Map<Eigen::VectorXd>(gradient, n) = value;
    return true;
  }

  bool eval_g(int n, const double* x, bool, int m, double* g) override {
    Eigen::VectorXd values;
    if (!monitor_.Constraints(At(n, x), &values)) return false;
    Eigen::Map<Eigen::VectorXd>(g, m) = values;
    return true;
  }

  bool eval_jac_g(int n, const double* x, bool, int, int, int* rows, int* cols,
                  double* values) override {
    if (values == nullptr) {
      std::copy(problem_.pattern().rows.begin(), problem_.pattern().rows.end(), rows);
      std::copy(problem_.pattern().cols.begin(), problem_.pattern().cols.end(), cols);
      return true;
    }
    std::vector<double> nonzeros;
    if (!monitor_.Jacobian(At(n, x), &nonzeros)) return false;
    std::copy(nonzeros.begin(), nonzeros.end(), values);
    return true;
  }

  bool intermediate_callback(Ipopt::AlgorithmMode, int iteration, double, double, double, double,
                             double, double, double, double, int, const Ipopt::IpoptData* data,
                             Ipopt::IpoptCalculatedQuantities* quantities) override {
    if (iteration == 0 || data == nullptr || quantities == nullptr) return monitor_.MayGoOn();
    // x of the iterate is not an argument: it is fetched from the depths. In the restoration phase
    // the casts fail, and there is no iterate of ours.
    auto* original = dynamic_cast<Ipopt::OrigIpoptNLP*>(GetRawPtr(quantities->GetIpoptNLP()));
    auto* adapter = original == nullptr
                        ? nullptr
                        : dynamic_cast<Ipopt::TNLPAdapter*>(GetRawPtr(original->nlp()));
    if (adapter == nullptr) return monitor_.MayGoOn();
    Eigen::VectorXd x(problem_.num_variables());
    adapter->ResortX(*data->curr()->x(), x.data());
    return monitor_.ReportIterate(x);
  }

  void finalize_solution(Ipopt::SolverReturn, int n, const double* x, const double*, const double*,
                         int, const double*, const double*, double, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {
    final_ = At(n, x);
  }

 private:
  static Eigen::VectorXd At(int n, const double* x) {
    return Eigen::Map<const Eigen::VectorXd>(x, n);
  }

  SolveMonitor& monitor_;
  const Problem& problem_;
  const Eigen::VectorXd& start_;
  Eigen::VectorXd final_;
};

std::string Digits(double value) {
  PlainStream text;
  text.precision(17);
  text << value;
  return text.str();
}

/// Ours first, then the user's on top; "" or why one is refused.
std::string SetOptions(SolveMonitor& monitor, Ipopt::IpoptApplication& ipopt) {
  const SolverOptions& options = monitor.options();
  std::map<std::string, std::string> values = {
      {"print_level", "0"},
      {"sb", "yes"},
      {"bound_relax_factor", "0"},
      {"hessian_approximation", "limited-memory"},
      {"tol", Digits(options.optimality_tolerance)},
      {"constr_viol_tol", Digits(0.5 * options.feasibility_tolerance)},
      {"max_iter", std::to_string(options.max_iterations)},
  };
  for (const auto& [name, value] : options.solver_options) {
    if (name == "print_level" || name == "sb" || name == "output_file") {
      return RefusedOption("ipopt", name, value, "the library does not print");
    }
    if (name == "hessian_approximation" && value != "limited-memory") {
      return RefusedOption("ipopt", name, value, "problems have no second derivatives");
    }
    values[name] = value;
  }
  for (const auto& [name, value] : values) {
    const auto registered = ipopt.RegOptions()->GetOption(name);
    if (!IsValid(registered)) {
      std::vector<std::string> valid;
      for (const auto& [known, option] : ipopt.RegOptions()->RegisteredOptionsList()) {
        valid.push_back(known);
      }
      return UnknownOption("ipopt", name, valid);
    }
    bool taken = false;
    if (registered->Type() == Ipopt::OT_Number) {
      const auto parsed = ParseNumber(value);
      taken = parsed && ipopt.Options()->SetNumericValue(name, *parsed);
    } else if (registered->Type() == Ipopt::OT_Integer) {
      const auto parsed = ParseInteger(value);
      taken = parsed && ipopt.Options()->SetIntegerValue(name, *parsed);
    } else {
      taken = ipopt.Options()->SetStringValue(name, value);
    }
    if (!taken) return RefusedOption("ipopt", name, value, registered->ShortDescription());
    monitor.Use(name, value);
  }
  return "";
}

SolverEnd Translate(Ipopt::ApplicationReturnStatus status, Eigen::VectorXd x) {
  using S = Ending;
  switch (status) {
    case Ipopt::Solve_Succeeded:
      return {S::kConverged, "Ipopt: solved.", std::move(x)};
    case Ipopt::Solved_To_Acceptable_Level:
      return {S::kFailed, "Ipopt: solved to its acceptable level.", std::move(x)};
    case Ipopt::Feasible_Point_Found:
      return {S::kFailed, "Ipopt: feasible point of a square problem found.", std::move(x)};
    case Ipopt::Search_Direction_Becomes_Too_Small:
      return {S::kFailed, "Ipopt: the search direction became too small.", std::move(x)};
    case Ipopt::Infeasible_Problem_Detected:
      return {S::kFailed, "Ipopt: the violation has a local minimum.", std::move(x)};
    case Ipopt::Diverging_Iterates:
      return {S::kFailed, "Ipopt: the iterates diverge; the cost may be unbounded.", std::move(x)};
    case Ipopt::Maximum_Iterations_Exceeded:
      return {S::kLimit, "Ipopt: max_iter reached.", std::move(x)};
    case Ipopt::Maximum_CpuTime_Exceeded:
      return {S::kDeadline, "Ipopt: max_cpu_time reached.", std::move(x)};
    case Ipopt::Not_Enough_Degrees_Of_Freedom:
      return {S::kFailed, "Ipopt: fewer free variables than equalities.", std::move(x)};
    case Ipopt::Invalid_Option:
      return {S::kInvalidInput, "Ipopt: an option's value cannot be used here.", std::move(x)};
    case Ipopt::Invalid_Number_Detected:
      return {S::kFailed, "Ipopt: a value or derivative is not finite.", std::move(x)};
    case Ipopt::Restoration_Failed:
      return {S::kFailed, "Ipopt: the restoration phase failed.", std::move(x)};
    default:
      return {S::kFailed, "Ipopt: failed with status " + std::to_string(status) + ".",
              std::move(x)};
  }
}

SolverEnd RunIpopt(SolveMonitor& monitor, const Eigen::VectorXd& start) {
  monitor.EstimateAlgebra(kIpoptPasses);
  std::unique_lock lock(OneSolve(), std::defer_lock);
  while (!lock.try_lock_for(std::chrono::milliseconds(5))) {
    if (!monitor.MayGoOn()) return {Ending::kInterrupted, "Stopped in the queue.", start};
  }
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> ipopt =
      new Ipopt::IpoptApplication(false);  // owned by the SmartPtr; no console
  if (std::string why = SetOptions(monitor, *ipopt); !why.empty()) {
    return {Ending::kInvalidInput, std::move(why), {}};
  }
  if (ipopt->Initialize("") != Ipopt::Solve_Succeeded) {  // "": no option file is read
    return {Ending::kInvalidInput, "Ipopt: the options cannot be used together.", {}};
  }
  const Ipopt::SmartPtr<Adapter> adapter = new Adapter(&monitor, start);
  const Ipopt::ApplicationReturnStatus status =
      ipopt->OptimizeTNLP(Ipopt::SmartPtr<Ipopt::TNLP>(GetRawPtr(adapter)));
  return Translate(status, adapter->final_x());
}

class IpoptSolver : public Solver {
 public:
  std::string name() const override { return "ipopt"; }
  bool available() const override { return true; }
  std::string WhyUnavailable() const override { return ""; }
  std::string WhyUnsupported(const Problem&) const override { return ""; }
  Solution Solve(const Problem& problem, const Eigen::VectorXd& x0,
                 const SolverOptions& options) const override {
    return MonitoredSolve(*this, problem, x0, options, SolveMonitor::Iterations::kTold, RunIpopt);
  }
};

}  // namespace

std::unique_ptr<Solver> MakeIpoptSolver() { return std::make_unique<IpoptSolver>(); }

}  // namespace halfstep::opt
