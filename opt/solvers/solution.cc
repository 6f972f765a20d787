#include "opt/solvers/solution.h"

#include "opt/problem/plain_stream.h"

namespace halfstep::opt {

std::string Solution::BriefReport() const {
  PlainStream out;
  out << (solver.empty() ? "no solver" : solver) << ": " << Name(ending);
  if (x.size() > 0) {
    out << ", cost " << cost;
    if (feasible) {
      out << ", feasible";
    } else {
      out << ", violated by " << max_violation << " in " << worst_row;
    }
    out << ", " << iterations << " iterations, " << wall << " s";
  }
  out << ". " << message;
  return out.str();
}

std::string Solution::FullReport() const {
  PlainStream out;
  out << BriefReport() << '\n'
      << "cost evaluations        " << cost_evaluations << '\n'
      << "gradient evaluations    " << gradient_evaluations << '\n'
      << "constraint evaluations  " << constraint_evaluations << '\n'
      << "Jacobian evaluations    " << jacobian_evaluations << '\n'
      << "linear algebra          " << linear_algebra << '\n'
      << "largest violation       " << max_violation
      << (worst_row.empty() ? std::string() : " in " + worst_row) << '\n'
      << "where the solver ended  cost " << final_cost << ", violation " << final_violation << '\n';
  for (const auto& [name, value] : requested_options) {
    out << "requested  " << name << " = " << value << '\n';
  }
  for (const auto& [name, value] : used_options)
    out << "used       " << name << " = " << value << '\n';
  return out.str();
}

}  // namespace halfstep::opt
