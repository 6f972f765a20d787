#pragma once

#include <filesystem>
#include <string>

namespace halfstep {

/// report.html of a sweep whose cases are all collected: one page that shows runs.csv over the keys
/// that vary, and needs no other file and no network. It holds no times of runs, so the same
/// runs.csv gives the same bytes. Where the rows would make a page of more than 5 MB, it has every
/// n-th value of the longest keys, and says so; what it counts is of all rows. `page`: where the
/// page will be, for its links to the reports of cases. Reads manifest.json and runs.csv only;
/// throws InputError for files that are missing or damaged. Precondition: HasReport().
std::string SweepReport(const std::filesystem::path& folder, const std::filesystem::path& page);

}  // namespace halfstep
