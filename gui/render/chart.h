// Curves against time as a drawing in the plane, and the drawing as SVG or as pixels.
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "gui/render/curves.h"
#include "gui/render/image.h"
#include "gui/render/picture.h"

namespace spacetime::gui {

// One panel above another, all over the same times.
struct Chart {
  std::vector<double> times;  // s, rising
  std::vector<std::vector<Curve>> panels;
  Theme theme = Theme::light;
};

// Lines and words; pixels from the left and the top.
struct Drawing {
  struct Stroke {
    std::vector<glm::vec2> points;
    Colour colour;
    float width = 1;
  };
  enum class Anchor { start, middle, end };
  struct Word {
    std::string text;
    glm::vec2 at{0};  // on its base line
    float size = 13;  // pixels
    Colour colour;
    Anchor anchor = Anchor::start;
  };
  int width = 0, height = 0;
  Colour background;
  std::vector<Stroke> strokes;
  std::vector<Word> words;
};

// Axes with ticks at round numbers, a legend beside each panel.  A curve that is not a number somewhere is broken
// there.
Drawing draw(const Chart& chart, int width, int height);

std::string svg(const Drawing& drawing);

// Throws InputError where the font is missing.
Image raster(const Drawing& drawing);
void paint(Image& image, const Drawing& drawing);  // over what is there; likewise

// Round numbers (1, 2 or 5 times a power of ten apart), about `count` of them, between low and high.
std::vector<double> ticks(double low, double high, int count);

}  // namespace spacetime::gui
