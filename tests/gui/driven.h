// A hub with real daemons, driven from one thread.
#pragma once

#include <functional>
#include <string>

#include "gui/hub.h"

namespace spacetime::test {

// Options with the daemons of this build and a folder for journals (empty: none).
gui::HubOptions daemons(const std::string& folder = {});

// How often something is killed: $SPACETIME_KILLS, or so often in an ordinary run.
int kills(int usual);

// Steps until the condition holds; a test failure after half a minute without.
void until(gui::Hub& hub, const std::function<bool(const gui::State&)>& holds, const std::string& what);
// Steps until nothing is under way any more: no run, no act, and the present entry has its checkpoint.
void until_quiet(gui::Hub& hub);
bool quiet(const gui::State& state);

void post_and_wait(gui::Hub& hub, gui::Event event);
void act(gui::Hub& hub, const std::string& line);

// The curves of a motion as one document: equal where every coefficient has the same bits.
std::string curves_text(const Motion& motion);
std::string present_curves(const gui::State& state);  // of the act that is shown
// Of the text performed by `spacetime-symbolic compile | spacetime-optimizer solve`.
std::string batch_curves(const std::string& text);
// What is told of errors and warnings, for messages of failed tests.
std::string told(const gui::State& state);

}  // namespace spacetime::test
