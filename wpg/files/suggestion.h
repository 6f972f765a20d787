#pragma once

#include <string>
#include <vector>

namespace halfstep {

/// "did you mean 'x'? " for the choice that is nearest to a word (NearestWord); "" when none is.
std::string DidYouMean(const std::string& word, const std::vector<std::string>& choices);

/// The words with commas between them; of more than 40 the first 40, and how many more there are.
std::string Joined(const std::vector<std::string>& words);

/// What follows a complaint about a word that is none of the choices: " (did you mean 'x'? valid:
/// x, y, z)".
std::string Suggestion(const std::string& word, const std::vector<std::string>& choices);

}  // namespace halfstep
