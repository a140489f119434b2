// How the window looks: fonts, colours and measures, light and dark.
#pragma once

#include <imgui.h>

#include <array>

namespace spacetime::gui {

struct Fonts {
  ImFont* text = nullptr;
  ImFont* strong = nullptr;
  ImFont* code = nullptr;
};

struct Colours {
  ImVec4 ground, panel, raised, line, text, faint, accent, good, warning, bad;
  std::array<ImVec4, 8> curves;  // told apart by people who see fewer colours, too (Okabe and Ito 2008)
};

// Loads Inter and DejaVu Sans Mono where Debian puts them; ImGui's own font where they are not installed.  `scale` is
// of the screen: 1 for about 100 dots an inch.
Fonts load_fonts(float scale);

Colours colours_of(bool dark);

// Sets ImGui's style to the palette.
void apply(const Colours& colours, float scale);

ImU32 packed(const ImVec4& colour, float opacity = 1);

}  // namespace spacetime::gui
