#include "experiments/plot/direct_labels.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/plot/style.h"

namespace halfstep::plot {
namespace {

using Eigen::Vector2d;

constexpr double kApart = 2.0;     // from a label to what it names [pt]
constexpr double kAnchors = 90.0;  // about how many places along a line are tried
constexpr double kOverText = 1e4;  // costs: of covering text
constexpr double kOverLine = 4.0;  // of a point's length of a line behind the label
constexpr double kOverEdge = 0.8;  // the same of an area's edge
constexpr double kUnclear = 3.0;   // of each point that another line is nearer than its own + 4

/// What is drawn as a line on the page.
struct Track {
  std::vector<Vector2d> points;  // [pt], about a point apart at least; NaN: a break
  bool edge = false;             // of an area
};

// About one point for each point's length, for labels need no more.
std::vector<Vector2d> OnPage(const PlacedPanel& panel, const std::vector<Vector2d>& points) {
  std::vector<Vector2d> result;
  for (size_t i = 0; i < points.size(); ++i) {
    const Vector2d p = panel.ToPage(points[i]);
    const bool last = i + 1 == points.size();
    if (!last && !result.empty() && p.allFinite() && (p - result.back()).norm() < 1.0) continue;
    if (!p.allFinite() && (result.empty() || !result.back().allFinite())) continue;
    result.push_back(p);
  }
  return result;
}

// Length of a segment's part in a box [pt].
double LengthWithin(const Vector2d& a, const Vector2d& b, const PageBox& box) {
  double begin = 0.0, end = 1.0;
  const Vector2d d = b - a;
  for (int k = 0; k < 2; ++k) {
    if (d[k] == 0.0) {
      if (a[k] < box.min()[k] || a[k] > box.max()[k]) return 0.0;
      continue;
    }
    const double s = (box.min()[k] - a[k]) / d[k], t = (box.max()[k] - a[k]) / d[k];
    begin = std::max(begin, std::min(s, t));
    end = std::min(end, std::max(s, t));
  }
  return end > begin ? (end - begin) * d.norm() : 0.0;
}

bool Inside(const std::vector<Vector2d>& polygon, const Vector2d& p) {
  bool inside = false;
  for (size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vector2d &a = polygon[i], &b = polygon[j];
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x()) {
      inside = !inside;
    }
  }
  return inside;
}

/// Looks for the places of one panel's labels, one after the other.
class LabelPlaces {
 public:
  LabelPlaces(const PlacedPanel& panel, const TextMeasure& measure, std::vector<PageBox> taken)
      : panel_(&panel), measure_(&measure), taken_(std::move(taken)) {
    for (const Area& area : panel.panel.areas) {
      Track edge{.points = {}, .edge = true};
      for (const Vector2d& corner : area.corners) edge.points.push_back(panel.ToPage(corner));
      if (!edge.points.empty()) edge.points.push_back(edge.points.front());
      drawn_.push_back(std::move(edge));
    }
    for (const Line& line : panel.panel.lines) drawn_.push_back({OnPage(panel, line.points)});
  }

  void Add(const std::string& text, const Color& ink, size_t own, bool only_inside = false) {
    size_ = {(*measure_)(text, false), style::kCapHeight + style::kDescent};
    best_cost_ = std::numeric_limits<double>::infinity();
    if (drawn_[own].edge) TryInside(own);
    if (best_cost_ > 1.0 && !only_inside) TryBeside(own);
    if (only_inside && best_cost_ >= kOverText) return;
    if (!std::isfinite(best_cost_)) return;  // nothing of it is within the frame
    taken_.push_back(best_);
    labels_.push_back({.text = text,
                       .at = {best_.min().x(), best_.max().y() - style::kDescent},
                       .box = best_,
                       .halo = true,
                       .direct = true,
                       .ink = ink});
  }
  std::ptrdiff_t count() const { return std::ssize(labels_); }
  std::vector<PlacedText>&& labels() { return std::move(labels_); }

 private:
  void TryInside(size_t own) {
    const std::vector<Vector2d>& corners = drawn_[own].points;
    PageBox bounds;
    for (const Vector2d& corner : corners) bounds.extend(corner);
    bounds.clamp(panel_->frame);
    if (bounds.isEmpty()) return;
    constexpr int kSteps = 12;
    for (int i = 0; i <= kSteps; ++i) {
      for (int j = 0; j <= kSteps; ++j) {
        const Vector2d middle = bounds.min() + bounds.sizes().cwiseProduct(Vector2d(i, j)) /
                                                   static_cast<double>(kSteps);
        const PageBox box(middle - 0.5 * size_, middle + 0.5 * size_);
        bool inside = true;
        for (const auto corner :
             {PageBox::BottomLeft, PageBox::BottomRight, PageBox::TopLeft, PageBox::TopRight}) {
          inside = inside && Inside(corners, box.corner(corner));
        }
        const double off = std::abs(i - kSteps / 2) + std::abs(j - kSteps / 2);
        if (inside) Try(box, own, 0.01 * off, /*beside=*/false);
      }
    }
  }

  void TryBeside(size_t own) {
    const std::vector<Vector2d>& points = drawn_[own].points;
    double length = 0.0;
    for (size_t i = 1; i < points.size(); ++i) {
      if (points[i].allFinite() && points[i - 1].allFinite())
        length += (points[i] - points[i - 1]).norm();
    }
    const double spacing = std::max(4.0, length / kAnchors);
    double gone = 0.0, next = 0.0;
    for (size_t i = 0; i < points.size(); ++i) {
      if (!points[i].allFinite()) continue;
      if (i == 0 || !points[i - 1].allFinite()) {
        AroundAnchor(points[i], own, gone / std::max(length, 1.0));
        continue;
      }
      const Vector2d way = points[i] - points[i - 1];
      for (; next <= gone + way.norm(); next += spacing) {
        const Vector2d anchor = points[i - 1] + way * ((next - gone) / std::max(way.norm(), 1e-9));
        AroundAnchor(anchor, own, next / std::max(length, 1.0));
      }
      gone += way.norm();
    }
  }

  void AroundAnchor(const Vector2d& anchor, size_t own, double share) {
    if (!panel_->frame.contains(anchor)) return;
    for (int i = -1; i <= 1; ++i) {
      for (int j = -1; j <= 1; ++j) {
        if (i == 0 && j == 0) continue;
        const Vector2d apart(i * (0.5 * size_.x() + (j == 0 ? kApart : 0.7 * kApart)),
                             j * (0.5 * size_.y() + (i == 0 ? kApart : 0.7 * kApart)));
        const Vector2d middle = anchor + apart;
        // Rather in the middle than at an end.
        Try(PageBox(middle - 0.5 * size_, middle + 0.5 * size_), own, std::abs(share - 0.5), true);
      }
    }
  }

  void Try(const PageBox& box, size_t own, double cost, bool beside) {
    const PageBox within(panel_->frame.min() + Vector2d(1, 1),
                         panel_->frame.max() - Vector2d(1, 1));
    if (!within.contains(box)) return;
    const PageBox wider(box.min() - Vector2d(0.8, 0.8), box.max() + Vector2d(0.8, 0.8));
    for (const PageBox& other : taken_) {
      if (wider.intersects(other)) cost += kOverText;
    }
    double nearest = std::numeric_limits<double>::infinity(), to_own = nearest;
    for (size_t k = 0; k < drawn_.size(); ++k) {
      if (!beside && k == own) continue;
      const std::vector<Vector2d>& points = drawn_[k].points;
      // Within another area, too, it would not say which it means.
      if (!beside && drawn_[k].edge && Inside(points, box.center())) cost += kUnclear;
      double covered = 0.0, distance = std::numeric_limits<double>::infinity();
      for (size_t i = 0; i < points.size(); ++i) {
        if (!points[i].allFinite()) continue;
        distance = std::min(distance, box.squaredExteriorDistance(points[i]));
        if (i > 0 && points[i - 1].allFinite())
          covered += LengthWithin(points[i - 1], points[i], wider);
      }
      cost += covered * (drawn_[k].edge ? kOverEdge : kOverLine);
      if (cost >= best_cost_) return;
      if (k == own) to_own = std::sqrt(distance);
      if (k != own && !drawn_[k].edge) nearest = std::min(nearest, std::sqrt(distance));
    }
    if (beside) cost += kUnclear * std::clamp(to_own + 4.0 - nearest, 0.0, 10.0);
    if (cost >= best_cost_) return;
    best_cost_ = cost;
    best_ = box;
  }

  const PlacedPanel* panel_;
  const TextMeasure* measure_;
  std::vector<PageBox> taken_;
  std::vector<Track> drawn_;  // edges of the areas, then the lines
  std::vector<PlacedText> labels_;
  Vector2d size_{0, 0};  // of the label that is being placed
  PageBox best_;
  double best_cost_ = 0.0;
};

}  // namespace

std::vector<PlacedText> DirectLabels(const PlacedPanel& panel, const TextMeasure& measure,
                                     const std::vector<PageBox>& taken) {
  LabelPlaces places(panel, measure, taken);
  const std::vector<Area>& areas = panel.panel.areas;
  const std::vector<Line>& lines = panel.panel.lines;
  const auto add_areas = [&](bool inside) {
    for (size_t i = 0; i < areas.size(); ++i) {
      if (areas[i].label.empty() || areas[i].label_inside != inside) continue;
      places.Add(areas[i].label, areas[i].ink, i, inside);
    }
  };
  // What has least choice first; numbers of footprints all or none, but for a few.
  add_areas(true);
  const auto numbers = std::ranges::count_if(
      areas, [](const Area& area) { return area.label_inside && !area.label.empty(); });
  if (2 * places.count() < numbers) places = LabelPlaces(panel, measure, taken);
  for (size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].label.empty()) continue;
    places.Add(lines[i].label, lines[i].stroke.color, areas.size() + i);
  }
  add_areas(false);
  return places.labels();
}

}  // namespace halfstep::plot
