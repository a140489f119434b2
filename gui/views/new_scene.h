// What "New scene" opens: a few lines of each kind, which can be run as they stand.
#pragma once

#include <string_view>

namespace spacetime::gui {

inline constexpr std::string_view new_scene =
    R"(# A cart goes from rest at 0 m to rest at 1 m with the least effort. Every line can be changed.

time [0, 2]                                    # seconds
constant Goal = 1                              # metres; drag it in the tab Constants
trajectory bspline spans 24                    # how finely motions are cut

creature cart {                                # what moves: links and their joints
  link body { prismatic along axis (1, 0, 0); mass 1; box (0.3, 0.15, 0.2) }
}

constrain start: (cart.along, cart.along') = (0, 0)     at 0   # what must hold, and when
constrain goal:  (cart.along, cart.along') = (Goal, 0)  at 2

minimize effort: integral(dot(cart.force, cart.force))         # what is best

solve                                          # what to do: Run does it
)";

}  // namespace spacetime::gui
