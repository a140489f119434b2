// What curves there are to draw: of degrees of freedom and expressions, or of what constraints are off by and cost.
#pragma once

#include <imgui.h>

#include <string>
#include <vector>

#include "gui/views/ui.h"

namespace spacetime::gui {

struct Plotted {
  std::string name{};   // in the legend
  std::string whole{};  // with its derivative, where something is told of it
  std::string of{};     // the degree of freedom, expression or constraint
  ImVec4 colour{};
  std::vector<double> times{}, values{};  // s; rising times
  int derivative = 0;
  bool before = false;  // of the motion that the ghost shows
  bool points = false;  // only at these times, nothing between them
  int style = 0;        // of the line, or the points (pen.h)
};

// As CurvesMemory asks for, over the time that is shown.  No two names look alike, as long as there are no more of them
// than colours in all styles.
std::vector<Plotted> curves_shown(const Ui& ui);

// Of what is asked for, what there is nothing to draw of, and why; empty where nothing lacks.
std::string what_lacks(const Ui& ui);

}  // namespace spacetime::gui
