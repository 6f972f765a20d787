// What came out for walks, added up, and in lines of a file, so that a study goes on where it
// stopped.
#include <algorithm>
#include <cstdio>
#include <sstream>

#include "tests/oracle/judge.h"

namespace halfstep::oracle {
namespace {

std::string FamilyWords(const std::string& what, const std::string& name, const FamilyTally& t) {
  char text[300];
  std::snprintf(text, sizeof text, " %s %s %ld %ld %ld %ld %.17g %.17g", what.c_str(), name.c_str(),
                t.statements, t.pushed, t.falsified, t.found, t.least_spare, t.disagreement);
  return text;
}

}  // namespace

void FamilyTally::Add(const FamilyTally& other) {
  statements += other.statements;
  pushed += other.pushed;
  falsified += other.falsified;
  found += other.found;
  least_spare = std::min(least_spare, other.least_spare);
  if (other.disagreement > disagreement) {
    disagreement = other.disagreement;
    where = other.where;
  }
}

void Tally::Add(const Tally& other) {
  walks += other.walks;
  refused += other.refused;
  certified += other.certified;
  violated += other.violated;
  undecided += other.undecided;
  judged += other.judged;
  idle += other.walks == 1 ? other.judged == 0 : other.idle;
  false_certified += other.false_certified;
  false_violated += other.false_violated;
  instants += other.instants;
  for (const auto& [name, family] : other.families) families[name].Add(family);
  for (const auto& [name, family] : other.tubes) tubes[name].Add(family);
  missed.insert(missed.end(), other.missed.begin(), other.missed.end());
}

std::string ToLine(const Tally& t) {
  char text[300];
  std::snprintf(text, sizeof text, "%ld %ld %ld %ld %ld %ld %ld %ld %ld", t.walks, t.refused,
                t.certified, t.violated, t.undecided, t.judged, t.false_certified, t.false_violated,
                t.instants);
  std::string line = text;
  for (const auto& [name, family] : t.families) line += FamilyWords("family", name, family);
  for (const auto& [name, family] : t.tubes) line += FamilyWords("tube", name, family);
  return line;
}

Tally ToTally(const std::string& line) {
  Tally t;
  std::istringstream in(line);
  in >> t.walks >> t.refused >> t.certified >> t.violated >> t.undecided >> t.judged >>
      t.false_certified >> t.false_violated >> t.instants;
  for (std::string what, name, least, disagreement; in >> what >> name;) {
    FamilyTally& its = (what == "tube" ? t.tubes : t.families)[name];
    in >> its.statements >> its.pushed >> its.falsified >> its.found >> least >> disagreement;
    its.least_spare = std::stod(least);
    its.disagreement = std::stod(disagreement);
  }
  return t;
}

}  // namespace halfstep::oracle
