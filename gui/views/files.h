// Choosing files: scenes to open and to save, films and pictures to make.
#pragma once

#include "gui/views/ui.h"

namespace spacetime::gui {

// The dialog that `FilesMemory` asks for.
void draw_files(Ui& ui);

// Esc was pressed, which closes what is open.
bool escaped();

}  // namespace spacetime::gui
