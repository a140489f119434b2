// What is written over the scene: what the person does, what came of it, and what the picture shows.
#pragma once

#include <glm/vec2.hpp>

#include "gui/render/picture.h"
#include "gui/views/ui.h"

namespace spacetime::gui {

// Over a picture with these measures, in pixels.
void draw_words(Ui& ui, const Picture& picture, const ImVec2& corner, const glm::vec2& size);

}  // namespace spacetime::gui
