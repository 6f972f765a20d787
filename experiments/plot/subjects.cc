#include "experiments/plot/subjects.h"

namespace halfstep::plot {
namespace {

constexpr RunSubject kRunSubjects[] = {
    {"walk", "footprints, obstacles, CoM and ZMP from above", WalkRows},
    {"foot", "heights and places of the soles against time", FootRows},
    {"side", "heights of the soles along the way, and obstacles in it", SideRows},
    {"zmp", "CoM and ZMP against time, in the band of the standing soles", ZmpRows},
    {"margins", "proved margins against time", MarginsRows},
    {"joints", "angles and speeds of the legs' joints, and limits", JointsRows}};

constexpr FolderSubject kComparisonSubjects[] = {
    {"durations", "of the methods by scenario", DurationsRows},
    {"profiles", "scenarios solved within a multiple of the least work", ProfilesRows},
    {"anytime", "the best walk so far against work", AnytimeRows}};

constexpr FolderSubject kSweepSubjects[] = {{"sweep", "durations against the keys", SweepRows}};

}  // namespace

std::span<const RunSubject> RunSubjects() { return kRunSubjects; }
std::span<const FolderSubject> ComparisonSubjects() { return kComparisonSubjects; }
std::span<const FolderSubject> SweepSubjects() { return kSweepSubjects; }

}  // namespace halfstep::plot
