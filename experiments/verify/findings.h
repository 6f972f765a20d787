#pragma once

#include <algorithm>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "wpg/files/text.h"

namespace halfstep::verify {

/// What a verification found: one line for each check, and the reasons why it disagrees.
class Findings {
 public:
  void Say(std::string line) { lines_.push_back(std::move(line)); }  ///< notes a check that held
  /// Notes what no check could look at, and why.
  void NotExamined(std::string what) { not_examined_.push_back(std::move(what)); }
  /// Notes a reason why it disagrees.
  void Disagree(const std::string& reason) {
    if (reasons_.size() < kKept) reasons_.push_back(reason);
    ++disagreements_;
  }
  /// Notes why the rows cannot settle a check, so that the walk is neither verified nor refused.
  void TooCoarse(std::string reason) { too_coarse_ = std::move(reason); }
  /// Notes what the verdict of one who reads only that must say.
  void Remark(std::string remark) { remark_ = std::move(remark); }
  const std::string& remark() const { return remark_; }  ///< "": nothing
  /// Adds the lines and disagreements of `other`.
  void Take(const Findings& other) {
    lines_.insert(lines_.end(), other.lines_.begin(), other.lines_.end());
    not_examined_.insert(not_examined_.end(), other.not_examined_.begin(),
                         other.not_examined_.end());
    TakeReasons(other, "");
  }
  /// Adds the disagreements of `other`, each with `prefix` before it, but not its lines.
  void TakeReasons(const Findings& other, const std::string& prefix) {
    for (const std::string& reason : other.reasons_) Disagree(prefix + reason);
    disagreements_ += other.disagreements_ - std::ssize(other.reasons_);
  }
  const std::vector<std::string>& lines() const { return lines_; }  ///< of all checks
  /// What no check could look at.
  const std::vector<std::string>& not_examined() const { return not_examined_; }
  const std::string& too_coarse() const { return too_coarse_; }  ///< "": the rows settle all checks
  /// The first twenty reasons; `disagreements()` counts them all.
  const std::vector<std::string>& reasons() const { return reasons_; }
  long disagreements() const { return disagreements_; }  ///< all, not the first twenty only

 private:
  static constexpr size_t kKept = 20;
  std::vector<std::string> lines_;
  std::vector<std::string> not_examined_;
  std::vector<std::string> reasons_;
  long disagreements_ = 0;
  std::string too_coarse_, remark_;
};

/// "41,230".
std::string Count(long n);

/// Mistakes of one kind: the first is reported, the others are counted.
class Faults {
 public:
  /// Notes one mistake.
  void Add(const std::string& what) {
    if (count_++ == 0) first_ = what;
  }
  /// Reports them, if there are any.
  void Conclude(Findings* findings) const {
    if (count_ == 1) findings->Disagree(first_);
    if (count_ > 1) findings->Disagree(first_ + ", and " + Count(count_ - 1) + " more");
  }

 private:
  std::string first_;
  long count_ = 0;
};

/// One check over many instants: how many values, the smallest, and where it is. Disagrees at
/// the first value below what is demanded, and counts the others.
class Check {
 public:
  /// `name` and `unit` are printed as they are. A value passes when it is at least demanded −
  /// tolerance.
  Check(std::string name, std::string unit, double demanded, double tolerance)
      : name_(std::move(name)),
        unit_(std::move(unit)),
        demanded_(demanded),
        tolerance_(tolerance) {}

  /// `where` is called for values that are kept, and names their place: "RLEG_LINK5 - bar at t =
  /// 3.215 s".
  template <typename Where>
  void Add(double value, const Where& where) {
    ++count_;
    if (value < smallest_ || !(value == value)) {
      smallest_ = value;
      where_ = where();
    }
    if (!(value >= demanded_ - tolerance_) && failures_++ == 0) first_failure_ = where();
  }
  /// Something that could not be settled, in words.
  void Open(const std::string& what) {
    if (failures_++ == 0) first_failure_ = what;
  }
  /// The least value that passes [unit of the check].
  double required() const { return demanded_ - tolerance_; }
  long failures() const { return failures_; }  ///< so far
  /// Says how it went.
  void Conclude(Findings* findings) const;

 private:
  std::string name_, unit_;
  double demanded_, tolerance_;
  long count_ = 0, failures_ = 0;
  double smallest_ = std::numeric_limits<double>::infinity();
  std::string where_, first_failure_;
};

}  // namespace halfstep::verify
