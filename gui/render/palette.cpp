#include "gui/render/palette.h"

#include <array>

namespace spacetime::gui {
namespace {

const Palette light{.above = colour_of(0xf4f3ef),
                    .below = colour_of(0xfbfaf7),
                    .ground = colour_of(0xeceae4),
                    .grid = colour_of(0xa9a69c),
                    .ink = colour_of(0x33383d),
                    .faint = colour_of(0xb4b2aa),
                    .met = colour_of(0x1f8a70),
                    .violated = colour_of(0xc8372d),
                    .soft = colour_of(0xc98a1b),
                    .disabled = colour_of(0xa3a19a)};
const Palette dark{.above = colour_of(0x1b1e23),
                   .below = colour_of(0x23272d),
                   .ground = colour_of(0x2b3037),
                   .grid = colour_of(0x59616b),
                   .ink = colour_of(0xd9dce0),
                   .faint = colour_of(0x59616b),
                   .met = colour_of(0x4cc2a0),
                   .violated = colour_of(0xff6b5e),
                   .soft = colour_of(0xf0b84a),
                   .disabled = colour_of(0x6b727b)};

constexpr std::array<unsigned, series_colours> light_series{0x2f6f9f, 0xd9692f, 0x2a9187, 0x8d5fa8,
                                                            0xb98a14, 0xb8456b, 0x6b7680};
constexpr std::array<unsigned, series_colours> dark_series{0x6cb2e4, 0xf2935c, 0x57c7b8, 0xbe97dd,
                                                           0xe0bc4c, 0xe8809f, 0x9aa5b0};

}  // namespace

const Palette& palette(Theme theme) { return theme == Theme::dark ? dark : light; }

Colour series_colour(Theme theme, int k) {
  const auto& series = theme == Theme::dark ? dark_series : light_series;
  return colour_of(series[static_cast<std::size_t>(k % series_colours)]);
}

}  // namespace spacetime::gui
