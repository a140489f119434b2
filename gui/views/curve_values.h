// What curves there are to draw: of degrees of freedom and expressions, or of what constraints are off by and cost.
#pragma once

#include <imgui.h>

#include <string>
#include <vector>

#include "gui/views/ui.h"

namespace spacetime::gui {

struct Curve {
  std::string name{};   // in the legend
  std::string whole{};  // with its derivative, where something is told of it
  std::string of{};     // the degree of freedom, expression or constraint
  ImVec4 colour{};
  std::vector<double> times{}, values{};  // s; rising times
  int derivative = 0;
  bool dotted = false;  // a ghost, or a component
  bool points = false;  // only at these times, nothing between them
  int mark = 0;         // points' shape: disc, ring, square, diamond
};

constexpr int marks = 4;

// As CurvesMemory asks for, over the time that is shown.
std::vector<Curve> curves_shown(const Ui& ui);

// Where there are none: why.
const char* why_none(const Ui& ui);

}  // namespace spacetime::gui
