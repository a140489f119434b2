// The keys that stand on the timeline: the sketch's, and those that acts of the log have pulled the motion through.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/action.h"
#include "common/problem.h"
#include "gui/state.h"

namespace spacetime::gui {

// Keys are pulls, and the pulls of several are sums.  So as long as nothing else has shaped the motion since, one can
// be taken out of it again: what it added is what the motion had more behind its act than before it.
struct KeyMark {
  double time = 0;                     // s
  std::map<std::string, double> held;  // values it gave to degrees of freedom
  bool sketched = false;               // a keyframe of the scene: only the scene's text can change it
  // What it added to coefficients, by degree of freedom; empty where it cannot be taken out: of the sketch, where the
  // motion was solved, reshaped or refined since, and as long as the act's motion is not known.
  std::map<std::string, std::vector<double>> added{};
};

// What each entry up to the present one asked of the optimizer, as it was read from the log; nothing in place of what a
// newer version of this program wrote.
using ReadActions = std::vector<std::vector<std::optional<Action>>>;

// Of the present entry.
std::vector<KeyMark> key_marks(const State& state, const ReadActions& actions,
                               const std::map<std::string, double>& constants);

// The keys with which the motion is pulled back to where it would be without this one.
std::vector<std::pair<std::string, double>> without(const KeyMark& mark, const Motion& motion);

// What moves the key to another time: pulled out where it was and in where it is to be; or, where it cannot be taken
// out any more, the same pose at the other time, from which it is solved again.
Steering moved(const KeyMark& mark, const Motion& motion, double time);

}  // namespace spacetime::gui
