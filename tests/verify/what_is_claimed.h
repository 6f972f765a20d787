#pragma once

#include <set>
#include <string>

namespace halfstep {

/// Why a change to a run is harmless: no statement of a certificate is about it.
inline constexpr char kHow[] = "how the method went, not what came of it";

/// Columns that are about how a method went, or that no statement is about.
inline const std::set<std::string> kFreeOfOverlaps = {
    "limited_by", "limited_by_family", "limited_by_scale", "price_s", "multiplier_s"};
inline const std::set<std::string> kFreeOfSummary = {
    "worst_margin", "worst_margin_name",          "instants", "effort", "collision_queries",
    "wall_s",       "time_to_first_improvement_s"};

/// Why another value of a member of manifest.json or certificate.json is harmless; "": it is not.
/// `pointer` as in "/methods/0/status".
const char* HarmlessInManifest(const std::string& pointer);
const char* HarmlessInCertificate(const std::string& pointer);

/// Why the bytes `a` may stand for the bytes `b` of a run's file: they differ in nothing that is
/// claimed; "": they do.
std::string SaysTheSame(const std::string& name, const std::string& a, const std::string& b);

}  // namespace halfstep
