// The whole behaviour of the session: what each event makes of the state, and what is to be done about it.
#pragma once

#include "gui/effect.h"
#include "gui/event.h"
#include "gui/state.h"

namespace spacetime::gui {

// Without input or output, clocks or chance: the same state and event give the same state and effects.
Effects update(State& state, const Event& event);

}  // namespace spacetime::gui
