// What the scene view shows of a state at one moment, as a picture.
#pragma once

#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gui/question.h"
#include "gui/render/figures.h"
#include "gui/render/picture.h"
#include "gui/residuals.h"
#include "gui/state.h"

namespace spacetime::gui {

struct Shows {
  bool trails = true, ghosts = true, forces = false, marks = true;
};

// The motion of the state's curves; with a pose, its degrees of freedom stand still at the pose's values.
Motion motion_of(const State& state, bool posed);

Picture picture_of(const State& state, const Question& question, const Residuals& residuals, const Figures& figures,
                   const Shows& shows);

}  // namespace spacetime::gui
