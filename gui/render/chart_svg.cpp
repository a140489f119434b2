#include <cmath>
#include <cstdio>

#include "gui/render/chart.h"

namespace spacetime::gui {
namespace {

std::string colour(const Colour& c) {
  char text[8];
  const auto part = [](float x) { return static_cast<unsigned>(std::lround(255 * x)) & 255U; };
  std::snprintf(text, sizeof text, "#%02x%02x%02x", part(c.red), part(c.green), part(c.blue));
  return text;
}

std::string number(float x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", static_cast<double>(x));
  return text;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else
      out += c;
  }
  return out;
}

}  // namespace

std::string svg(const Drawing& drawing) {
  const std::string width = std::to_string(drawing.width), height = std::to_string(drawing.height);
  std::string out =
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + width + "\" height=\"" + height + "\" viewBox=\"0 0 " +
      width + " " + height +
      "\" font-family=\"DejaVu Sans, Verdana, sans-serif\">\n<rect width=\"100%\" height=\"100%\" fill=\"" +
      colour(drawing.background) + "\"/>\n";
  for (const auto& stroke : drawing.strokes) {
    out += "<polyline fill=\"none\" stroke-linejoin=\"round\" stroke=\"" + colour(stroke.colour) +
           "\" stroke-width=\"" + number(stroke.width) + "\" points=\"";
    for (const auto& p : stroke.points) out += number(p.x) + "," + number(p.y) + " ";
    out.back() = '"';
    out += "/>\n";
  }
  for (const auto& word : drawing.words) {
    const char* const anchors[]{"start", "middle", "end"};
    out += "<text x=\"" + number(word.at.x) + "\" y=\"" + number(word.at.y) + "\" font-size=\"" + number(word.size) +
           "\" text-anchor=\"" + anchors[static_cast<int>(word.anchor)] + "\" fill=\"" + colour(word.colour) + "\">" +
           escaped(word.text) + "</text>\n";
  }
  return out + "</svg>\n";
}

}  // namespace spacetime::gui
