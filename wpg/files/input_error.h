#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace halfstep {

/// Bad input of a user: every complaint is one line "file:line:column: key: what is wrong (valid:
/// …)". The command line prints them all and exits with status 2.
class InputError : public std::runtime_error {
 public:
  /// One line each; the error's text is all of them.
  explicit InputError(std::vector<std::string> complaints);
  /// In the order in which they shall be read.
  const std::vector<std::string>& complaints() const { return complaints_; }

 private:
  std::vector<std::string> complaints_;
};

/// Gathers complaints, so that all mistakes of a file are reported at once.
class Complaints {
 public:
  /// line and column count from 1; 0 leaves them out.
  void Add(const std::string& file, int line, int column, const std::string& key,
           const std::string& what);
  /// Adds complaints that are lines already.
  void Add(const std::vector<std::string>& lines) {
    lines_.insert(lines_.end(), lines.begin(), lines.end());
  }
  bool empty() const { return lines_.empty(); }  ///< whether there is no complaint
  /// Complaints so far, in the form above.
  const std::vector<std::string>& lines() const { return lines_; }
  /// Throws InputError when there is any complaint.
  void ThrowIfAny() const;

 private:
  std::vector<std::string> lines_;
};

/// The choice nearest to `word` by edit distance (swapped neighbours count as one slip) when at
/// most every third character is wrong, else ""; the first of several equally near.
std::string NearestWord(const std::string& word, const std::vector<std::string>& choices);

}  // namespace halfstep
