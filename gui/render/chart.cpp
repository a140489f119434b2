#include "gui/render/chart.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gui/render/palette.h"

namespace spacetime::gui {
namespace {

constexpr float letter = 0.62F;  // average width of a letter over the size of the font
constexpr float font = 13, left = 76, right = 16, top = 22, bottom = 44, gap = 26, key = 22;

std::string text_of(double number, double step) {
  if (std::abs(number) < step / 2) return "0";
  const double size = std::abs(number);
  char text[40];
  if (size >= 1e5 || step < 1e-4) {
    std::snprintf(text, sizeof text, "%.4g", number);
  } else {
    const int digits = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
    std::snprintf(text, sizeof text, "%.*f", digits, number);
  }
  std::string result = text;
  if (result.front() == '-') result.replace(0, 1, "\xE2\x88\x92");  // a minus sign
  return result;
}

struct Range {
  double low = 0, high = 1;
};

Range range_of(const std::vector<Curve>& curves) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Curve& curve : curves) {
    for (const double v : curve.values) {
      if (!std::isfinite(v)) continue;
      low = std::min(low, v);
      high = std::max(high, v);
    }
  }
  if (!(low <= high)) return {};
  const double room = high > low ? 0.06 * (high - low) : std::max(0.5 * std::abs(high), 0.5);
  return {low - room, high + room};
}

struct Frame {
  float left, top, right, bottom;
};

void draw_panel(Drawing& out, const Chart& chart, const std::vector<Curve>& curves, const Frame& frame, bool last) {
  const Palette& colours = palette(chart.theme);
  const Colour grid = mix(out.background, colours.faint, 0.45F);
  const auto [low, high] = range_of(curves);
  const double begin = chart.times.front(), end = chart.times.back();
  const auto x = [&](double t) {
    return frame.left + static_cast<float>((t - begin) / (end - begin)) * (frame.right - frame.left);
  };
  const auto y = [&](double v) {
    return frame.bottom - static_cast<float>((v - low) / (high - low)) * (frame.bottom - frame.top);
  };

  const auto across = ticks(begin, end, static_cast<int>((frame.right - frame.left) / 90));
  for (const double t : across) {
    out.strokes.push_back({{{x(t), frame.top}, {x(t), frame.bottom}}, grid, 1});
    if (last) {
      out.words.push_back({text_of(t, across.size() > 1 ? across[1] - across[0] : 1),
                           {x(t), frame.bottom + 18},
                           font,
                           colours.ink,
                           Drawing::Anchor::middle});
    }
  }
  const auto up = ticks(low, high, std::max(2, static_cast<int>((frame.bottom - frame.top) / 40)));
  for (const double v : up) {
    const bool zero = std::abs(v) < 1e-9 * (high - low);
    out.strokes.push_back({{{frame.left, y(v)}, {frame.right, y(v)}}, zero ? colours.faint : grid, 1});
    out.words.push_back({text_of(v, up.size() > 1 ? up[1] - up[0] : 1),
                         {frame.left - 8, y(v) + 0.36F * font},
                         font,
                         colours.ink,
                         Drawing::Anchor::end});
  }
  out.strokes.push_back(
      {{{frame.left, frame.top}, {frame.left, frame.bottom}, {frame.right, frame.bottom}}, colours.faint, 1});

  for (std::size_t k = 0; k < curves.size(); ++k) {
    const Colour colour = series_colour(chart.theme, static_cast<int>(k));
    Drawing::Stroke stroke{{}, colour, 2};
    const auto flush = [&] {
      if (stroke.points.size() > 1) out.strokes.push_back(stroke);
      stroke.points.clear();
    };
    for (std::size_t i = 0; i < chart.times.size(); ++i) {
      if (!std::isfinite(curves[k].values[i])) {
        flush();
        continue;
      }
      stroke.points.emplace_back(x(chart.times[i]), y(curves[k].values[i]));
    }
    flush();
    const float line = frame.top + 10 + 20 * static_cast<float>(k);
    out.strokes.push_back({{{frame.right + 14, line}, {frame.right + 14 + key, line}}, colour, 2.5F});
    out.words.push_back({curves[k].label, {frame.right + 14 + key + 8, line + 0.36F * font}, font, colours.ink});
  }
}

}  // namespace

std::vector<double> ticks(double low, double high, int count) {
  const double about = (high - low) / std::max(1, count);
  const double power = std::pow(10, std::floor(std::log10(about)));
  double step = power;
  for (const double factor : {2.0, 5.0, 10.0}) {
    if (step < about * (1 - 1e-9)) step = factor * power;
  }
  std::vector<double> result;
  const auto first = static_cast<long long>(std::ceil(low / step - 1e-9));
  for (long long k = first; static_cast<double>(k) * step <= high + 1e-9 * step; ++k)
    result.push_back(static_cast<double>(k) * step);
  return result;
}

Drawing draw(const Chart& chart, int width, int height) {
  const Palette& colours = palette(chart.theme);
  Drawing out{.width = width, .height = height, .background = colours.below, .strokes = {}, .words = {}};
  std::size_t longest = 0;
  for (const auto& panel : chart.panels)
    for (const Curve& curve : panel) longest = std::max(longest, curve.label.size());
  const float legend = 14 + key + 8 + letter * font * static_cast<float>(longest) + right;
  const auto count = static_cast<float>(chart.panels.size());
  const float tall = (static_cast<float>(height) - top - bottom - gap * (count - 1)) / count;
  for (std::size_t k = 0; k < chart.panels.size(); ++k) {
    const float from = top + static_cast<float>(k) * (tall + gap);
    const Frame frame{left, from, std::max(left + 40, static_cast<float>(width) - legend), from + tall};
    draw_panel(out, chart, chart.panels[k], frame, k + 1 == chart.panels.size());
    if (k + 1 == chart.panels.size()) {
      out.words.push_back({"time (s)",
                           {0.5F * (frame.left + frame.right), frame.bottom + 36},
                           font,
                           colours.ink,
                           Drawing::Anchor::middle});
    }
  }
  return out;
}

}  // namespace spacetime::gui
