#include "experiments/plot/layout.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/plot/direct_labels.h"
#include "experiments/plot/style.h"
#include "experiments/plot/ticks.h"
#include "wpg/elementary.h"
#include "wpg/files/input_error.h"

namespace halfstep::plot {
namespace {

constexpr double kEdge = 1.0;           // free at the page's edges [pt]
constexpr double kBetweenRows = 5.0;    // [pt]
constexpr double kBetweenPanels = 8.0;  // beside each other [pt]
constexpr double kLeastFrame = 40.0;    // width of a frame [pt]
constexpr double kMostHeight = 1.6;     // height of a frame with equal axes, of its width

double Along(const Axis& axis, double value) {
  if (!axis.logarithmic) return (value - axis.low) / (axis.high - axis.low);
  if (!(value > 0.0)) return std::nan("");
  return Log(value / axis.low) / Log(axis.high / axis.low);
}

PlacedText Placed(const std::string& text, const Eigen::Vector2d& at, double width) {
  return {.text = text,
          .at = at,
          .box = PageBox(Eigen::Vector2d(at.x(), at.y() - style::kCapHeight),
                         Eigen::Vector2d(at.x() + width, at.y() + style::kDescent))};
}

/// What of a cell is beside its frame [pt].
struct Beside {
  double left = 0.0, right = 0.0;
};

/// Finds the places of one figure.
class Placing {
 public:
  Placing(const Figure& figure, const TextMeasure& measure)
      : measure_(measure), rows_(figure.rows) {
    placed_.title = figure.title;
    placed_.width = figure.width;
    // Ticks say how wide frames are, and frames how many ticks there are.
    for (int round = 0; round < 4; ++round) {
      for (Row& row : rows_) {
        for (size_t i = 0; i < row.size(); ++i) Scale(figure, row, i);
      }
    }
    double y = kEdge;
    for (const Row& row : rows_) y = PlaceRow(row, y);
    placed_.height = y + kEdge;
    for (PlacedPanel& panel : placed_.panels) AddLabels(panel);
  }
  PlacedFigure&& placed() { return std::move(placed_); }

 private:
  double FrameWidth(size_t columns) const {
    double free = placed_.width - 2 * kEdge - kBetweenPanels * static_cast<double>(columns - 1);
    if (const auto found = beside_.find(columns); found != beside_.end()) {
      for (const Beside& beside : found->second) free -= beside.left + beside.right;
    }
    const double width = free / static_cast<double>(columns);
    if (width < kLeastFrame) {
      throw InputError(
          {"--width: leaves no room for frames beside their numbers (valid: a larger one)"});
    }
    return width;
  }

  static double FrameHeight(const Panel& panel, double width) {
    if (!panel.equal) return panel.height;
    const double equal = width * (panel.y.high - panel.y.low) / (panel.x.high - panel.x.low);
    return std::max(equal, panel.height);
  }

  // Chooses ticks, makes axes equal, and notes what the panel needs beside its frame.
  void Scale(const Figure& figure, Row& row, size_t column) {
    Panel& panel = row[column];
    const Panel& asked = figure.rows[static_cast<size_t>(&row - rows_.data())][column];
    const double width = FrameWidth(row.size());
    panel.x = asked.x;
    if (panel.equal) {
      const double most = kMostHeight * width / (panel.y.high - panel.y.low);  // [pt per unit]
      const double wider = width / most - (panel.x.high - panel.x.low);
      if (wider > 0.0) {
        panel.x.low -= 0.5 * wider;
        panel.x.high += 0.5 * wider;
      }
    }
    const double height = FrameHeight(panel, width);
    if (asked.x.ticks.empty()) panel.x.ticks = FittingTicks(panel.x, width);
    if (asked.y.ticks.empty()) {
      int most = std::max(2, static_cast<int>(height / 10.0));
      // As far apart as along x.
      if (panel.equal && panel.x.ticks.size() > 1) {
        const double apart = panel.x.ticks[1].at - panel.x.ticks[0].at;
        most = std::min(most, static_cast<int>((panel.y.high - panel.y.low) / apart) + 1);
      }
      panel.y.ticks = ChosenTicks(panel.y, most);
    }
    Beside need;
    for (const Tick& tick : panel.y.ticks)
      need.left = std::max(need.left, measure_(tick.text, false));
    need.left += style::kTickLength + style::kPad;
    if (!panel.y.label.empty()) need.left += style::kLineHeight;
    if (!panel.x.ticks.empty()) {
      const Tick& last = panel.x.ticks.back();
      need.right =
          std::max(1.0, 0.5 * measure_(last.text, false) - (1.0 - Along(panel.x, last.at)) * width);
    }
    std::vector<Beside>& all = beside_[row.size()];
    all.resize(row.size());
    all[column].left = std::max(all[column].left, need.left);
    all[column].right = std::max(all[column].right, need.right);
  }

  // As many as leave room between their numbers.
  std::vector<Tick> FittingTicks(const Axis& axis, double width) const {
    for (int most = std::max(2, static_cast<int>(width / 18.0)); most > 2; --most) {
      const std::vector<Tick> ticks = ChosenTicks(axis, most);
      bool fits = true;
      for (size_t i = 1; i < ticks.size(); ++i) {
        const double apart = (Along(axis, ticks[i].at) - Along(axis, ticks[i - 1].at)) * width;
        const double words =
            0.5 * (measure_(ticks[i].text, false) + measure_(ticks[i - 1].text, false));
        fits = fits && apart >= words + 6.0;
      }
      if (fits) return ticks;
    }
    return ChosenTicks(axis, 2);
  }

  // From `top` on; where the row ends [pt].
  double PlaceRow(const Row& row, double top) {
    double above = placed_.panels.empty() ? 0.5 * style::kCapHeight : kBetweenRows, below = 0.0;
    for (const Panel& panel : row) {
      if (!panel.title.empty())
        above = (placed_.panels.empty() ? 0.0 : kBetweenRows) + style::kLineHeight;
      const double label = panel.x.label.empty() ? 0.0 : style::kLineHeight;
      if (panel.numbers_below) {
        below = std::max(
            below, style::kTickLength + style::kPad + style::kCapHeight + style::kDescent + label);
      }
    }
    double end = top, left = kEdge;
    const double width = FrameWidth(row.size());
    for (size_t i = 0; i < row.size(); ++i) {
      const Beside& beside = beside_.at(row.size())[i];
      const double x = left + beside.left, y = top + above;
      const double height = FrameHeight(row[i], width);
      const PlacedPanel panel{
          row[i], PageBox(Eigen::Vector2d(x, y), Eigen::Vector2d(x + width, y + height))};
      PlaceTexts(panel, left);
      placed_.panels.push_back(panel);
      end = std::max(end, y + height + below);
      left += beside.left + width + beside.right + kBetweenPanels;
    }
    return end;
  }

  // Numbers, labels of axes and the title of a panel whose cell begins at `left` [pt].
  void PlaceTexts(const PlacedPanel& placed, double left) {
    const auto& [panel, frame] = placed;
    const auto middle = [&](const std::string& text, double x, double y) {
      const double width = measure_(text, false);
      placed_.texts.push_back(Placed(text, {x - 0.5 * width, y}, width));
    };
    const double numbers = frame.max().y() + style::kTickLength + style::kPad + style::kCapHeight;
    if (panel.numbers_below) {
      for (const Tick& tick : panel.x.ticks) {
        middle(tick.text, placed.ToPage({tick.at, panel.y.low}).x(), numbers);
      }
      if (!panel.x.label.empty()) {
        middle(panel.x.label, frame.center().x(), numbers + style::kLineHeight);
      }
    }
    for (const Tick& tick : panel.y.ticks) {
      const double width = measure_(tick.text, false);
      const Eigen::Vector2d p = placed.ToPage({panel.x.low, tick.at});
      placed_.texts.push_back(Placed(
          tick.text,
          {p.x() - style::kTickLength - style::kPad - width, p.y() + 0.5 * style::kCapHeight},
          width));
    }
    if (!panel.y.label.empty()) PlaceUpwards(panel.y.label, left, frame);
    if (!panel.title.empty()) {
      const double width = measure_(panel.title, true);
      PlacedText title = Placed(panel.title, {frame.min().x(), frame.min().y() - 3.0}, width);
      title.bold = true;
      placed_.texts.push_back(title);
    }
  }

  void PlaceUpwards(const std::string& text, double left, const PageBox& frame) {
    const double width = measure_(text, false);
    const Eigen::Vector2d at(left + style::kCapHeight, frame.center().y() + 0.5 * width);
    placed_.texts.push_back(
        {.text = text,
         .at = at,
         .box = PageBox(Eigen::Vector2d(at.x() - style::kCapHeight, at.y() - width),
                        Eigen::Vector2d(at.x() + style::kDescent, at.y())),
         .upwards = true});
  }

  // The note, the words and the direct labels of a panel.
  void AddLabels(const PlacedPanel& placed) {
    std::vector<PageBox> taken;
    const auto add = [&](PlacedText text) {
      taken.push_back(text.box);
      placed_.texts.push_back(std::move(text));
    };
    if (!placed.panel.note.empty()) {
      PlacedText note = Placed(placed.panel.note,
                               placed.frame.min() + Eigen::Vector2d(3.0, 2.0 + style::kCapHeight),
                               measure_(placed.panel.note, false));
      note.halo = true;
      add(note);
    }
    for (const Word& word : placed.panel.words) {
      const double width = measure_(word.text, false);
      const Eigen::Vector2d p = placed.ToPage(word.at);
      PlacedText text = Placed(
          word.text,
          {word.after ? p.x() + style::kPad : p.x() - 0.5 * width, p.y() + 0.5 * style::kCapHeight},
          width);
      text.ink = word.ink;
      if (placed.frame.contains(text.box)) add(text);
    }
    for (const Mark& mark : placed.panel.marks) {
      const Eigen::Vector2d p = placed.ToPage(mark.at), r(mark.radius, mark.radius);
      taken.emplace_back(p - r, p + r);
    }
    for (PlacedText& label : DirectLabels(placed, measure_, taken)) {
      placed_.texts.push_back(std::move(label));
    }
  }

  const TextMeasure& measure_;
  std::vector<Row> rows_;
  std::map<size_t, std::vector<Beside>> beside_;  // by the number of columns
  PlacedFigure placed_;
};

}  // namespace

Eigen::Vector2d PlacedPanel::ToPage(const Eigen::Vector2d& p) const {
  return {frame.min().x() + Along(panel.x, p.x()) * frame.sizes().x(),
          frame.max().y() - Along(panel.y, p.y()) * frame.sizes().y()};
}

PlacedFigure PlaceFigure(const Figure& figure, const TextMeasure& measure) {
  return Placing(figure, measure).placed();
}

}  // namespace halfstep::plot
