#include "tests/experiments/parsed_csv.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>

namespace halfstep {

ParsedCsv::ParsedCsv(const std::string& text) {
  bool quoted = false;
  std::vector<std::string> row(1);
  if (text.empty() || text.back() != '\n') throw std::runtime_error("the last line is not whole");
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '"' && text[i + 1] == '"') {
      row.back() += text[++i];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (!quoted && c == ',') {
      row.emplace_back();
    } else if (!quoted && c == '\n') {
      EndRow(&row);
    } else {
      row.back() += c;
    }
  }
  if (quoted) throw std::runtime_error("a quote is open");
}

const std::string& ParsedCsv::Text(size_t row, const std::string& column) const {
  const auto found = std::find(header_.begin(), header_.end(), column);
  if (found == header_.end()) throw std::runtime_error("no column " + column);
  return rows_.at(row)[static_cast<size_t>(found - header_.begin())];
}

double ParsedCsv::Number(size_t row, const std::string& column) const {
  const std::string& text = Text(row, column);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw std::runtime_error("not a number: '" + text + "' in " + column);
  }
  return value;
}

std::string ParsedCsv::Without(const std::vector<std::string>& columns) const {
  std::string text;
  for (size_t c = 0; c < header_.size(); ++c) {
    if (std::find(columns.begin(), columns.end(), header_[c]) != columns.end()) continue;
    text += header_[c] + ":";
    for (const auto& row : rows_) text += row[c] + "|";
    text += "\n";
  }
  return text;
}

void ParsedCsv::EndRow(std::vector<std::string>* row) {
  if (header_.empty()) {
    header_ = *row;
  } else {
    if (row->size() != header_.size()) throw std::runtime_error("a ragged row");
    rows_.push_back(*row);
  }
  *row = {""};
}

}  // namespace halfstep
