// What opens over the window: files, examples, shortcuts, unsaved changes.
#pragma once

#include "gui/views/ui.h"

namespace spacetime::gui {

void draw_dialogs(Ui& ui);

// Goes on to what is wanted (an example, and a fresh scene, are texts without a file), after asking about changes that
// are not saved.
void leave_for(Ui& ui, Leaving leaving);

// A session that ended without being saved, by a crash or a power cut, as it is called.
std::string name_of(const LeftBehind& left);

// The folder of the examples that come with the program; empty where it is not found.
std::string examples_folder();

}  // namespace spacetime::gui
