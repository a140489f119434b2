#include "gui/render/place_marks.h"

#include <cmath>
#include <numbers>

#include "gui/places.h"
#include "gui/render/chart.h"
#include "gui/render/palette.h"

namespace spacetime::gui {
namespace {

// Pixels, in a picture of so many rows as most windows have; larger in larger ones.
constexpr float radius = 8, tick = 4, line = 2, letters = 14, usual_height = 720;
constexpr int corners = 32;  // of what passes for a circle

}  // namespace

std::vector<NamedPlace> places_in(const Problem& problem, const Motion& motion) {
  const std::map<std::string, double> constants(motion.constants.begin(), motion.constants.end());
  std::vector<NamedPlace> out;
  for (const PlaceHandle& place : places_of(problem)) out.push_back({place.name, glm::vec3(at(place, constants))});
  return out;
}

void mark(Image& image, const std::vector<NamedPlace>& places, const Camera& camera, Theme theme) {
  const glm::vec2 size(image.width, image.height);
  const float scale = std::max(1.0F, size.y / usual_height), r = radius * scale;
  const Colour colour = palette(theme).soft;
  Drawing drawing;
  for (const NamedPlace& place : places) {
    const auto seen = project(camera, size, place.at);
    if (!seen) continue;
    const auto add = [&](std::vector<glm::vec2> points) {
      drawing.strokes.push_back({std::move(points), colour, line * scale});
    };
    std::vector<glm::vec2> ring;
    for (int k = 0; k <= corners; ++k) {
      const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(k) / corners;
      ring.push_back(*seen + r * glm::vec2(std::cos(angle), std::sin(angle)));
    }
    add(std::move(ring));
    for (const glm::vec2 way : {glm::vec2(1, 0), glm::vec2(-1, 0), glm::vec2(0, 1), glm::vec2(0, -1)})
      add({*seen + (r - tick * scale) * way, *seen + (r + tick * scale) * way});
    drawing.words.push_back({place.name, *seen + glm::vec2(r + 6 * scale, 0.35F * letters * scale), letters * scale,
                             colour, Drawing::Anchor::start});
  }
  if (!drawing.words.empty()) paint(image, drawing);
}

}  // namespace spacetime::gui
