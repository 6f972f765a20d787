#include "experiments/plot/canvas.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>

#include <cmath>
#include <memory>
#include <stdexcept>

#include "experiments/plot/style.h"
#include "experiments/plot/thinned.h"

namespace halfstep::plot {
namespace {

using Eigen::Vector2d;

// As journals set figures; where it is absent, fontconfig takes what is nearest.
constexpr char kFont[] = "Liberation Sans";
constexpr double kDotsPerInch = 300.0;  // of PNG
constexpr double kThinning = 0.015;     // how far a drawn line is from all its points at most [pt]
constexpr double kHalo = 1.6;           // width of the white about labels, half of it outside [pt]
constexpr double kHatching = 3.0;       // between hatching lines [pt]
constexpr char kNoDate[] = "2000-01-01T00:00:00Z";  // the same run gives the same file

struct DestroySurface {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
struct DestroyContext {
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using Surface = std::unique_ptr<cairo_surface_t, DestroySurface>;
using Context = std::unique_ptr<cairo_t, DestroyContext>;

void Check(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS) {
    throw std::runtime_error(std::string("cairo cannot draw the figure: ") +
                             cairo_status_to_string(status));
  }
}

cairo_status_t Append(void* bytes, const unsigned char* data, unsigned int size) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), size);
  return CAIRO_STATUS_SUCCESS;
}

void SelectFont(cairo_t* c, bool bold) {
  cairo_select_font_face(c, kFont, CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(c, style::kTextSize);
  // Widths that are the same on the screen and on paper.
  cairo_font_options_t* const options = cairo_font_options_create();
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_set_font_options(c, options);
  cairo_font_options_destroy(options);
}

void SetColor(cairo_t* c, const Color& color) {
  cairo_set_source_rgb(c, color.r, color.g, color.b);
}

void SetStroke(cairo_t* c, const Stroke& stroke) {
  SetColor(c, stroke.color);
  cairo_set_line_width(c, stroke.width);
  cairo_set_dash(c, stroke.dash.data(), static_cast<int>(stroke.dash.size()), 0.0);
}

// A path through points of the page, broken where one is not finite.
void Path(cairo_t* c, const std::vector<Vector2d>& points) {
  bool begun = false;
  for (const Vector2d& p : points) {
    if (!p.allFinite()) {
      begun = false;
    } else if (begun) {
      cairo_line_to(c, p.x(), p.y());
    } else {
      cairo_move_to(c, p.x(), p.y());
      begun = true;
    }
  }
}

std::vector<Vector2d> OnThePage(const PlacedPanel& panel, const std::vector<Vector2d>& points) {
  std::vector<Vector2d> page;
  page.reserve(points.size());
  for (const Vector2d& p : points) page.push_back(panel.ToPage(p));
  return page;
}

void Rectangle(cairo_t* c, const PageBox& box) {
  cairo_rectangle(c, box.min().x(), box.min().y(), box.sizes().x(), box.sizes().y());
}

void Hatch(cairo_t* c, const PageBox& box) {
  const double height = box.sizes().y();
  SetStroke(c, {.color = style::Grey(0.55), .width = 0.4});
  for (double x = box.min().x() - height; x < box.max().x(); x += kHatching) {
    cairo_move_to(c, x, box.max().y());
    cairo_line_to(c, x + height, box.min().y());
  }
  cairo_stroke(c);
}

void DrawArea(cairo_t* c, const PlacedPanel& panel, const Area& area) {
  Path(c, Thinned(OnThePage(panel, area.corners), kThinning));
  cairo_close_path(c);
  if (area.fill) {
    SetColor(c, *area.fill);
    cairo_fill_preserve(c);
  }
  if (area.hatched) {
    cairo_path_t* const path = cairo_copy_path(c);
    cairo_save(c);
    cairo_clip(c);
    Hatch(c, panel.frame);
    cairo_restore(c);
    cairo_new_path(c);
    cairo_append_path(c, path);
    cairo_path_destroy(path);
  }
  if (area.outline) {
    SetStroke(c, *area.outline);
    cairo_stroke_preserve(c);
  }
  cairo_new_path(c);
}

void DrawMark(cairo_t* c, const PlacedPanel& panel, const Mark& mark) {
  const Vector2d p = panel.ToPage(mark.at);
  if (!p.allFinite()) return;
  cairo_new_sub_path(c);
  cairo_arc(c, p.x(), p.y(), mark.radius, 0.0, 2.0 * M_PI);
  SetColor(c, mark.open ? style::kWhite : mark.fill);
  cairo_fill_preserve(c);
  SetStroke(c, {.color = mark.fill, .width = 0.7});
  cairo_stroke(c);
}

void DrawAxes(cairo_t* c, const PlacedPanel& placed) {
  const auto& [panel, frame] = placed;
  SetStroke(c, {.color = style::kBlack, .width = style::kFrameWidth});
  if (panel.equal) {
    Rectangle(c, frame);
  } else {
    cairo_move_to(c, frame.min().x(), frame.min().y());
    cairo_line_to(c, frame.min().x(), frame.max().y());
    cairo_line_to(c, frame.max().x(), frame.max().y());
  }
  for (const Tick& tick : panel.x.ticks) {
    const Vector2d p = placed.ToPage({tick.at, panel.y.low});
    cairo_move_to(c, p.x(), frame.max().y());
    cairo_line_to(c, p.x(), frame.max().y() + style::kTickLength);
  }
  for (const Tick& tick : panel.y.ticks) {
    const Vector2d p = placed.ToPage({panel.x.low, tick.at});
    cairo_move_to(c, frame.min().x(), p.y());
    cairo_line_to(c, frame.min().x() - style::kTickLength, p.y());
  }
  cairo_stroke(c);
}

void DrawPanel(cairo_t* c, const PlacedPanel& placed) {
  cairo_save(c);
  Rectangle(c, placed.frame);
  cairo_clip(c);
  for (const Area& area : placed.panel.areas) DrawArea(c, placed, area);
  for (const Line& line : placed.panel.lines) {
    Path(c, Thinned(OnThePage(placed, line.points), kThinning));
    SetStroke(c, line.stroke);
    cairo_stroke(c);
  }
  cairo_restore(c);
  DrawAxes(c, placed);
  for (const Mark& mark : placed.panel.marks) DrawMark(c, placed, mark);
}

void DrawText(cairo_t* c, const PlacedText& text) {
  SelectFont(c, text.bold);
  cairo_save(c);
  cairo_move_to(c, text.at.x(), text.at.y());
  if (text.upwards) cairo_rotate(c, -0.5 * M_PI);
  if (text.halo) {
    cairo_text_path(c, text.text.c_str());
    SetStroke(c, {.color = style::kWhite, .width = kHalo});
    cairo_stroke(c);
    cairo_move_to(c, text.at.x(), text.at.y());
  }
  SetColor(c, text.ink);
  cairo_show_text(c, text.text.c_str());
  cairo_restore(c);
}

Surface MakeSurface(const PlacedFigure& figure, FileKind kind, std::string* bytes) {
  if (kind == FileKind::kPng) {
    const double scale = kDotsPerInch / kPointsPerInch;
    return Surface(cairo_image_surface_create(
        CAIRO_FORMAT_RGB24, static_cast<int>(std::lround(figure.width * scale)),
        static_cast<int>(std::lround(figure.height * scale))));
  }
  if (kind == FileKind::kSvg) {
    return Surface(cairo_svg_surface_create_for_stream(Append, bytes, figure.width, figure.height));
  }
  Surface pdf(cairo_pdf_surface_create_for_stream(Append, bytes, figure.width, figure.height));
  cairo_pdf_surface_set_metadata(pdf.get(), CAIRO_PDF_METADATA_TITLE, figure.title.c_str());
  cairo_pdf_surface_set_metadata(pdf.get(), CAIRO_PDF_METADATA_CREATOR, "halfstep");
  cairo_pdf_surface_set_metadata(pdf.get(), CAIRO_PDF_METADATA_CREATE_DATE, kNoDate);
  return pdf;
}

}  // namespace

std::string WhyNoPlots() { return ""; }

double TextWidth(const std::string& text, bool bold) {
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1));
  const Context c(cairo_create(surface.get()));
  SelectFont(c.get(), bold);
  cairo_text_extents_t extents;
  cairo_text_extents(c.get(), text.c_str(), &extents);
  Check(cairo_status(c.get()));
  return extents.x_advance;
}

std::string Drawn(const PlacedFigure& figure, FileKind kind) {
  std::string bytes;
  const Surface surface = MakeSurface(figure, kind, &bytes);
  {
    const Context c(cairo_create(surface.get()));
    if (kind == FileKind::kPng) {
      SetColor(c.get(), style::kWhite);
      cairo_paint(c.get());
      cairo_scale(c.get(), kDotsPerInch / kPointsPerInch, kDotsPerInch / kPointsPerInch);
    }
    cairo_set_line_join(c.get(), CAIRO_LINE_JOIN_ROUND);
    for (const PlacedPanel& panel : figure.panels) DrawPanel(c.get(), panel);
    for (const PlacedText& text : figure.texts) DrawText(c.get(), text);
    Check(cairo_status(c.get()));
  }
  if (kind == FileKind::kPng) {
    Check(cairo_surface_write_to_png_stream(surface.get(), Append, &bytes));
  }
  cairo_surface_finish(surface.get());
  Check(cairo_surface_status(surface.get()));
  return bytes;
}

}  // namespace halfstep::plot
