#include "experiments/server/message_fields.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "wpg/files/input_error.h"
#include "wpg/files/nesting.h"
#include "wpg/files/suggestion.h"
#include "wpg/files/text.h"
#include "wpg/nth.h"

namespace halfstep {

using nlohmann::json;

namespace {

constexpr size_t kMostItems = 10000;

[[noreturn]] void Refuse(const std::string& what) { throw InputError({"message: " + what}); }

double NumberOf(const json& value) {
  // NaN is in no range.
  return value.is_number() ? value.get<double>() : std::nan("");
}

std::string RangeText(double min, double max) { return Formatted("from %g to %g", min, max); }

}  // namespace

json ParseMessage(std::string_view text) {
  if (text.size() > kMostMessageBytes) {
    Refuse(Formatted("%zu bytes (valid: at most %zu)", text.size(), kMostMessageBytes));
  }
  if (JsonDepth(text) > kMostMessageLevels) {
    Refuse(Formatted("nests too deeply (valid: at most %d levels)", kMostMessageLevels));
  }
  std::vector<std::set<std::string>> open;
  std::string twice;
  const auto look = [&](int, json::parse_event_t event, json& parsed) {
    if (event == json::parse_event_t::object_start) open.emplace_back();
    if (event == json::parse_event_t::object_end) open.pop_back();
    if (event == json::parse_event_t::key && !open.back().insert(parsed.get<std::string>()).second)
      twice = parsed.get<std::string>();
    return true;
  };
  json object;
  try {
    object = json::parse(text, look);
  } catch (const json::parse_error& error) {
    Refuse(Formatted("is not JSON: byte %zu is not expected there", error.byte));
  } catch (const json::exception&) {
    Refuse("has a number that is too large (valid: numbers that a double can hold)");
  }
  if (!object.is_object()) Refuse("is no object (valid: {\"type\": …})");
  if (!twice.empty()) Refuse("the key " + Quote(twice) + " stands twice in one object");
  return object;
}

MessageFields::MessageFields(const json& object, std::string name)
    : object_(object), name_(std::move(name)) {}

void MessageFields::Fail(const std::string& key, const std::string& what) const {
  throw InputError({(name_.empty() ? "" : name_ + ".") + key + ": " + what});
}

const json& MessageFields::Of(const std::string& key) {
  known_.push_back(key);
  const auto found = object_.find(key);
  if (found == object_.end()) Fail(key, "is missing");
  return *found;
}

std::string MessageFields::Text(const std::string& key) {
  const json& value = Of(key);
  if (!value.is_string()) Fail(key, "is no text (valid: \"…\")");
  return value.get<std::string>();
}

double MessageFields::Number(const std::string& key, double min, double max,
                             std::optional<double> otherwise) {
  known_.push_back(key);
  if (otherwise && !Has(key)) return *otherwise;
  const double number = NumberOf(Of(key));
  if (!(number >= min && number <= max)) {
    Fail(key, "is not a number in its range (valid: " + RangeText(min, max) + ")");
  }
  return number;
}

Eigen::VectorXd MessageFields::Numbers(const std::string& key, int count, double min, double max) {
  const json& list = Of(key);
  const std::string valid = Formatted(" (valid: %d numbers ", count) + RangeText(min, max) + ")";
  if (!list.is_array() || std::ssize(list) != count) {
    Fail(key, Formatted("is no list of %d", count) + valid);
  }
  Eigen::VectorXd numbers(count);
  for (int i = 0; i < count; ++i) {
    numbers[i] = NumberOf(Nth(list, i));
    if (!(numbers[i] >= min && numbers[i] <= max)) {
      Fail(key, Formatted("item %d is not such a number", i + 1) + valid);
    }
  }
  return numbers;
}

Eigen::MatrixXd MessageFields::Rows(const std::string& key, int rows, int count, double min,
                                    double max) {
  const json& list = Of(key);
  const std::string valid =
      Formatted(" (valid: %d lists of %d numbers ", rows, count) + RangeText(min, max) + ")";
  if (!list.is_array() || std::ssize(list) != rows) {
    Fail(key, Formatted("is no list of %d lists", rows) + valid);
  }
  Eigen::MatrixXd numbers(rows, count);
  for (int i = 0; i < rows; ++i) {
    const json& row = Nth(list, i);
    if (!row.is_array() || std::ssize(row) != count) {
      Fail(key, Formatted("item %d is no list of %d", i + 1, count) + valid);
    }
    for (int j = 0; j < count; ++j) {
      numbers(i, j) = NumberOf(Nth(row, j));
      if (!(numbers(i, j) >= min && numbers(i, j) <= max)) {
        Fail(key, Formatted("item %d of list %d is not such a number", j + 1, i + 1) + valid);
      }
    }
  }
  return numbers;
}

Eigen::MatrixXd MessageFields::RowsUpTo(const std::string& key, int least, int most, int count,
                                        double min, double max) {
  const json& list = Of(key);
  const std::ptrdiff_t rows = list.is_array() ? std::ssize(list) : -1;
  if (rows < least || rows > most) {
    Fail(key,
         Formatted("is no list of %d to %d lists (valid: of %d numbers each ", least, most, count) +
             RangeText(min, max) + ")");
  }
  return Rows(key, static_cast<int>(rows), count, min, max);
}

MessageFields MessageFields::Object(const std::string& key) {
  const json& object = Of(key);
  if (!object.is_object()) Fail(key, "is no object (valid: {…})");
  return {object, key};
}

std::vector<MessageFields> MessageFields::Objects(const std::string& key) {
  const json& list = Of(key);
  if (!list.is_array() || list.size() > kMostItems) {
    Fail(key, Formatted("is no list (valid: [{…}, …] of at most %zu)", kMostItems));
  }
  std::vector<MessageFields> objects;
  for (size_t i = 0; i < list.size(); ++i) {
    const std::string name = key + Formatted("[%zu]", i);
    if (!list[i].is_object()) Fail(name, "is no object (valid: {…})");
    objects.emplace_back(list[i], name);
  }
  return objects;
}

std::vector<int> MessageFields::Indices(const std::string& key, int max) {
  const json& list = Of(key);
  const std::string valid = Formatted(" (valid: different whole numbers from 1 to %d)", max);
  if (!list.is_array() || list.size() > kMostItems) Fail(key, "is no list" + valid);
  std::set<int> indices;
  for (const json& item : list) {
    const double number = item.is_number_integer() ? NumberOf(item) : 0.0;
    if (!(number >= 1 && number <= max) || !indices.insert(static_cast<int>(number)).second) {
      Fail(key, Formatted("item %zu is none of them, or stands there twice", indices.size() + 1) +
                    valid);
    }
  }
  return {indices.begin(), indices.end()};
}

void MessageFields::RefuseOthers() const {
  for (const auto& item : object_.items()) {
    if (std::ranges::find(known_, item.key()) != known_.end()) continue;
    Fail(item.key().size() <= 60 ? item.key() : Quote(item.key()),
         "unknown key" + Suggestion(item.key(), known_));
  }
}

}  // namespace halfstep
