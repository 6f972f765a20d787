#pragma once

#include <span>
#include <string>
#include <string_view>

namespace halfstep::verify {

/// Not to be mixed up with NotCovered, which is what a certificate does not speak of: what
/// `halfstep verify` does not look at of a run or an episode, beyond that the file is the one
/// that the manifest lists. Whatever is in a folder and not named here is computed again, or
/// compared with what is.
struct NotExamined {
  std::string_view file;  ///< in the folder; METHOD, NAME and NNN stand for any
  std::string_view name;  ///< column, or key as in "methods.message"; "*": all of the file
  std::string_view why;   ///< what is not examined of it, and why no statement rests on it
};

/// That of a run.
std::span<const NotExamined> NotExaminedOfRun();
/// That of an episode.
std::span<const NotExamined> NotExaminedOfEpisode();

/// The entry of a file in the folder ("raw/overlaps.csv") and a column or key of it; null: none.
const NotExamined* FindNotExamined(std::span<const NotExamined> list, std::string_view file,
                                   std::string_view name);

/// One line for each entry, "file: name: why".
std::string NotExaminedText(std::span<const NotExamined> list);

}  // namespace halfstep::verify
