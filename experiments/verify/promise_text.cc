#include "experiments/verify/promise_text.h"

#include "experiments/verify/json_text.h"

namespace halfstep::verify {
namespace {

bool Truth(const JsonMember& member, const std::string& key) {
  const auto it = member.object().find(key);
  if (it == member.object().end() || !it->is_boolean()) {
    member.Fail(key + ": is not true or false");
  }
  return it->get<bool>();
}

BrokenText BrokenOf(const JsonMember& member) {
  BrokenText broken{
      .name = member.String("name"),
      .was_there = Truth(member, "was_there"),
      .from = member.Number("from_s"),
      .measured = member.NumberOrNull("measured_s"),
      .known = member.NumberOrNull("known_s"),
      .frames = member.Whole("frames"),
      .beyond = member.Number("beyond_m"),
      .rested = Truth(member, "rested"),
      .speed = member.NumberOrNull("speed_m_s").value_or(std::numeric_limits<double>::infinity()),
      .error = member.Number("error_m"),
      .covered_by = {},
      .unproved = {}};
  for (const nlohmann::json& one : member.List("covered_by")) {
    if (!one.is_string()) member.Fail("covered_by: is no list of texts");
    broken.covered_by.push_back(one.get<std::string>());
  }
  for (const nlohmann::json& one : member.List("unproved_s")) {
    if (!one.is_array() || one.size() != 2 || !one[0].is_number() || !one[1].is_number()) {
      member.Fail("unproved_s: is no list of two times each");
    }
    broken.unproved.emplace_back(one[0].get<double>(), one[1].get<double>());
  }
  return broken;
}

}  // namespace

PromiseText ReadPromise(const std::string& path, const std::string& manifest) {
  const nlohmann::json document = ParseJson(path, manifest);
  const JsonMember root(path, document, "");
  const JsonMember member = root.Object("promise");
  PromiseText promise{.status = member.String("status"),
                      .judged_by = member.String("judged_by"),
                      .broken = {},
                      .touched = {}};
  for (const JsonMember& one : member.Items("broken")) promise.broken.push_back(BrokenOf(one));
  for (const JsonMember& one : member.Items("touched")) {
    promise.touched.push_back({one.String("obstacle"), one.Number("from_s")});
  }
  return promise;
}

}  // namespace halfstep::verify
