#pragma once

#include <string>
#include <vector>

namespace halfstep {

/// "did you mean 'x'? " for the choice that differs from a word in capitals only, or is WORD.yaml
/// or ends with "/WORD"; else for the one that is nearest (NearestWord); "" when none is.
std::string DidYouMean(const std::string& word, const std::vector<std::string>& choices);

/// "did you mean 'runs/x'? " for the folder `x` that a run has below `runs`; "" when there is none.
std::string DidYouMeanRun(const std::string& folder);

/// The words with commas between them; of more than 40 the first 40, and how many more there are.
std::string Joined(const std::vector<std::string>& words);

/// What follows a complaint about a word that is none of the choices: " (did you mean 'x'? valid:
/// x, y, z)".
std::string Suggestion(const std::string& word, const std::vector<std::string>& choices);

}  // namespace halfstep
