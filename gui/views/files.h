// Choosing files: scenes to open and to save, films and pictures to make.
#pragma once

#include <filesystem>
#include <vector>

#include "gui/views/ui.h"

namespace spacetime::gui {

// What a folder holds, as far as it can be read.
struct Entries {
  std::vector<std::filesystem::directory_entry> all;
  bool failed = false;
};
Entries entries_of(const std::filesystem::path& folder);

// The dialog that `FilesMemory` asks for.
void draw_files(Ui& ui);

// Esc was pressed, which closes what is open.
bool escaped();

}  // namespace spacetime::gui
