#include "html_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>

#include "figure.hpp"
#include "html_style.hpp"
#include "html_text.hpp"

namespace plumbline::reports {
namespace {

constexpr double kWidth = 900, kHeight = 380;
constexpr double kLeft = 74, kRight = 16, kTop = 22, kBottom = 44;
constexpr double kFloorGap = 22;          // between the lowest decade and the line of zero errors
constexpr std::size_t kPointsDrawn = 80;  // of dozens of curves a reader sees no more; keeps the page small
constexpr int kDecadesShown = 18;         // below that far under the largest error all is round-off
constexpr double kMarksPerCurve = 5;

using Out = std::back_insert_iterator<std::string>;

// Maps time and error to the picture.
struct Axes {
  double t_end = 1;        // [s]
  int low = -1, high = 0;  // decades
  bool zeros = false;      // room for the floor line is needed

  double bottom() const { return kHeight - kBottom - (zeros ? kFloorGap : 0); }
  double x(double t) const { return kLeft + (kWidth - kLeft - kRight) * t / t_end; }
  double y(double error) const {
    if (error == 0) return kHeight - kBottom;
    const double share = (std::log10(error) - low) / (high - low);
    return bottom() - (bottom() - kTop) * std::clamp(share, 0.0, 1.0);
  }
};

Axes axes_of(const std::vector<const RunResult*>& runs) {
  Axes axes;
  double t_end = 0, smallest = HUGE_VAL, largest = 0;
  for (const RunResult* run : runs) {
    for (const CurvePoint& p : run->curve) {
      if (std::isfinite(p.t)) t_end = std::max(t_end, p.t);
      const double error = std::abs(p.error);
      if (error == 0) axes.zeros = true;
      if (!std::isfinite(error) || error == 0) continue;
      smallest = std::min(smallest, error);
      largest = std::max(largest, error);
    }
  }
  if (t_end > 0) axes.t_end = t_end;
  if (largest > 0) {
    axes.high = static_cast<int>(std::ceil(std::log10(largest)));
    axes.low = std::min(static_cast<int>(std::floor(std::log10(smallest))), axes.high - 1);
    axes.low = std::max(axes.low, axes.high - kDecadesShown);
  }
  return axes;
}

// A round distance between about `wanted` ticks: 1, 2 or 5 times a power of ten.
double tick_distance(double length, double wanted) {
  const double raw = length / wanted;
  const double power = std::pow(10, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= raw) return factor * power;
  }
  return 10 * power;
}

void draw_axes(const Axes& axes, Out out) {
  const int every = std::max(1, (axes.high - axes.low + 8) / 9);
  for (int decade = axes.low; decade <= axes.high; ++decade) {
    const double y = axes.bottom() - (axes.bottom() - kTop) * (decade - axes.low) / (axes.high - axes.low);
    const bool labelled = (axes.high - decade) % every == 0;
    if (!labelled) continue;
    fmt::format_to(out, "<path class=\"grid\" d=\"M{:.0f} {:.1f}H{:.0f}\"/>", kLeft, y, kWidth - kRight);
    fmt::format_to(out, "<text x=\"{:.0f}\" y=\"{:.1f}\" text-anchor=\"end\">1e{}</text>", kLeft - 7, y + 4, decade);
  }
  if (axes.zeros) {
    const double y = axes.y(0);
    fmt::format_to(out, "<path class=\"floor\" d=\"M{:.0f} {:.1f}H{:.0f}\"/>", kLeft, y, kWidth - kRight);
    fmt::format_to(out, "<text x=\"{:.0f}\" y=\"{:.1f}\" text-anchor=\"end\">exactly 0</text>", kLeft - 7, y + 4);
  }
  const double distance = tick_distance(axes.t_end, 8);
  // Counted in whole ticks: adding up the distance would lose the last one to rounding.
  const auto ticks = static_cast<int>(std::floor(axes.t_end / distance * (1 + 1e-9)));
  for (int k = 0; k <= ticks; ++k) {
    const double t = k * distance;
    fmt::format_to(out, "<path class=\"grid\" d=\"M{:.1f} {:.0f}V{:.0f}\"/>", axes.x(t), kTop, kHeight - kBottom);
    fmt::format_to(out, "<text x=\"{:.1f}\" y=\"{:.0f}\" text-anchor=\"middle\">{:g}</text>", axes.x(t),
                   kHeight - kBottom + 17, t);
  }
  fmt::format_to(out, "<text class=\"axis\" x=\"{:.0f}\" y=\"{:.0f}\" text-anchor=\"middle\">time t [s]</text>",
                 (kLeft + kWidth - kRight) / 2, kHeight - 8);
  fmt::format_to(out,
                 "<text class=\"axis\" transform=\"translate(15 {:.0f}) rotate(-90)\" text-anchor=\"middle\">"
                 "distance from the reference [m]</text>",
                 (kTop + kHeight - kBottom) / 2);
}

// At most that many points: of each bucket the first point that is not finite, else the largest.
std::vector<CurvePoint> thinned(const std::vector<CurvePoint>& curve) {
  if (curve.size() <= kPointsDrawn) return curve;
  const std::size_t bucket = (curve.size() + kPointsDrawn - 1) / kPointsDrawn;
  std::vector<CurvePoint> kept;
  for (std::size_t begin = 0; begin < curve.size(); begin += bucket) {
    const std::size_t end = std::min(begin + bucket, curve.size());
    std::size_t best = begin;
    for (std::size_t i = begin; i < end && std::isfinite(curve[best].error); ++i) {
      if (!(curve[i].error <= curve[best].error)) best = i;
    }
    kept.push_back(curve[best]);
  }
  return kept;
}

// The marker shapes, about (x, y): an engine reads without its colour.
std::string marker(std::size_t shape, double x, double y) {
  switch (shape % 8) {
    case 0:
      return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.6\"/>", x, y);
    case 1:
      return fmt::format("<path d=\"M{:.1f} {:.1f}h7v7h-7z\"/>", x - 3.5, y - 3.5);
    case 2:
      return fmt::format("<path d=\"M{:.1f} {:.1f}l4.5 8h-9z\"/>", x, y - 4.5);
    case 3:
      return fmt::format("<path d=\"M{:.1f} {:.1f}l4.5 4.5l-4.5 4.5l-4.5-4.5z\"/>", x, y - 4.5);
    case 4:
      return fmt::format("<path d=\"M{:.1f} {:.1f}h9m-4.5-4.5v9\" fill=\"none\"/>", x - 4.5, y);
    case 5:
      return fmt::format("<path d=\"M{:.1f} {:.1f}l7 7m0-7l-7 7\" fill=\"none\"/>", x - 3.5, y - 3.5);
    case 6:
      return fmt::format("<path d=\"M{:.1f} {:.1f}l4.5-8h-9z\"/>", x, y + 4.5);
    default:
      return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.6\" fill=\"none\"/>", x, y);
  }
}

std::string draw_curve(const RunResult& run, std::size_t look, const Axes& axes) {
  std::string path, marks;
  char pen = 'M';
  std::optional<double> lost;  // where it stopped being finite
  const std::vector<CurvePoint> points = thinned(run.curve);
  // Curves often lie on each other: every engine starts its markers elsewhere, so that all of them show.
  const double spacing = axes.t_end / kMarksPerCurve;
  double next_mark = spacing * (0.15 + 0.11 * static_cast<double>(look % 8));
  for (const CurvePoint& p : points) {
    if (!std::isfinite(p.t)) continue;
    if (!std::isfinite(p.error)) {
      if (!lost) lost = p.t;
      pen = 'M';
      continue;
    }
    const double x = axes.x(p.t), y = axes.y(std::abs(p.error));
    fmt::format_to(std::back_inserter(path), "{}{:.1f} {:.1f}", pen, x, y);
    pen = 'L';
    if (p.t < next_mark) continue;
    marks += marker(look, x, y);
    while (next_mark <= p.t) next_mark += spacing;
  }
  const std::string what =
      fmt::format("{}.{}: {}, position.max {}", escaped(run.engine), profile_name(run.profile),
                  verdict_name(run.verdict), with_unit(run.metric("position.max"), "position.max"));
  const std::size_t color = look % kCurveColors;
  std::string svg = fmt::format("<g><title>{}</title><path class=\"curve {} k{}\" d=\"{}\"/>", what,
                                profile_name(run.profile), color, path);
  if (!marks.empty()) svg += fmt::format("<g class=\"mark f{}\">{}</g>", color, marks);
  if (lost) {
    svg += fmt::format("<g class=\"mark k{}\"><path d=\"M{:.1f} {:.1f}l10 10m0-10l-10 10\"/></g>", color,
                       axes.x(*lost) - 5, kTop - 5);
    const bool near_end = axes.x(*lost) > kWidth - 130;
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.0f}\" text-anchor=\"{}\">not finite</text>",
                       axes.x(*lost) + (near_end ? -9 : 9), kTop - 6, near_end ? "end" : "start");
  }
  return svg + "</g>\n";
}

bool has_curve(const RunResult* run) { return run != nullptr && !run->curve.empty(); }

}  // namespace

CurveLooks::CurveLooks(const Report& report) {
  for (const EngineInfo& e : report.engines) engines_.push_back(e.name);
  for (const RunResult& r : report.runs) {
    if (std::find(engines_.begin(), engines_.end(), r.engine) == engines_.end()) engines_.push_back(r.engine);
  }
}

std::size_t CurveLooks::index(std::string_view engine) const {
  return static_cast<std::size_t>(std::find(engines_.begin(), engines_.end(), engine) - engines_.begin());
}

std::string error_chart(const std::vector<const RunResult*>& runs, const CurveLooks& looks, const std::string& title) {
  std::vector<const RunResult*> drawn;
  std::copy_if(runs.begin(), runs.end(), std::back_inserter(drawn), has_curve);
  if (drawn.empty())
    return "<p class=\"soft\">No engine left a trajectory at this dt, so there is nothing to draw.</p>\n";

  const Axes axes = axes_of(drawn);
  std::string svg =
      fmt::format("<div class=\"chart scroll\"><svg viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\">\n",
                  kWidth, kHeight, escaped(title));
  draw_axes(axes, std::back_inserter(svg));
  svg += '\n';
  for (const RunResult* run : drawn) svg += draw_curve(*run, looks.index(run->engine), axes);
  return svg + "</svg></div>\n";
}

std::string chart_legend(const std::vector<const RunResult*>& runs, const CurveLooks& looks) {
  std::map<std::size_t, std::string> names;  // by look, so that every legend has the same order
  for (const RunResult* run : runs) {
    if (has_curve(run)) names.emplace(looks.index(run->engine), run->engine);
  }
  if (names.empty()) return "";
  std::string html = "<ul class=\"legend\">";
  for (const auto& [look, name] : names) {
    html += fmt::format(
        "<li><svg viewBox=\"0 0 44 14\" aria-hidden=\"true\"><path class=\"curve k{0}\" d=\"M1 7H43\"/>"
        "<g class=\"mark f{0}\">{1}</g></svg>{2}</li>",
        look % kCurveColors, marker(look, 22, 7), escaped(name));
  }
  return html + "<li class=\"soft\">solid: matched, dashed: default</li></ul>\n";
}

}  // namespace plumbline::reports
