// What hangs together at a moment: the hand and the ball in it.
#pragma once

#include <string>
#include <vector>

#include "gui/question.h"
#include "gui/render/figures.h"
#include "gui/render/picture.h"

namespace spacetime::gui {

// A body of a creature of one, tied to one of a creature of several: where the one is, the other has to be.
struct Hold {
  std::string holder, held;  // bodies
  bool operator==(const Hold&) const = default;
};

// Those at a time (s): where an equation of both creatures' degrees of freedom is in force, and the picture shows that
// they touch.  So a ball that flies, or one that the motion does not bring to the hand yet, is held by nobody.
std::vector<Hold> holds_at(const Question& question, const Problem& problem, const Curves& curves,
                           const Figures& figures, const Picture& picture, double time);

}  // namespace spacetime::gui
