// The colours of pictures: calm, distinct for colour-blind people too (after the palettes of Okabe and Ito, and of
// Tol), on a light or a dark ground.
#pragma once

#include "gui/render/picture.h"

namespace spacetime::gui {

struct Palette {
  Colour above, below;  // the background, from the picture's top to its bottom
  Colour ground, grid;
  Colour ink, faint;  // text and axes; lines that are to stand back
  Colour met, violated, soft, disabled;
};
const Palette& palette(Theme theme);

// Of the k-th creature, or curve; they repeat after `series_colours`.
Colour series_colour(Theme theme, int k);
inline constexpr int series_colours = 7;

}  // namespace spacetime::gui
