// What opens over the window: files, examples, shortcuts, unsaved changes.
#pragma once

#include "gui/views/ui.h"

namespace spacetime::gui {

void draw_dialogs(Ui& ui);

// Opens `file`, or an example's text without its file (or closes the window where it is empty), after asking about
// changes that are not saved.
void leave_for(Ui& ui, const std::string& file, bool example = false);

// The folder of the examples that come with the program; empty where it is not found.
std::string examples_folder();

}  // namespace spacetime::gui
