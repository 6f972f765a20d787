#pragma once

#include <map>
#include <string>
#include <vector>

namespace halfstep {

/// Logs in the format of OMPL's benchmarks, one text for each scenario of the runs, by the
/// scenario's name. An experiment is a scenario, a planner is a method (or "plan/NAME", the
/// footstep planner of runs that planned), a run is what it did in one run folder: repetitions
/// differ in seed. Progress is the incumbent's duration over time. Reads run folders as ReadRun;
/// throws InputError. Source: [OmplBenchmark], the log file's grammar.
std::map<std::string, std::string> OmplLogs(const std::vector<std::string>& runs);

}  // namespace halfstep
