// Buttons and keys on their way to ImGui, which is told once a frame what is down.  What goes down and up again within
// one frame, as it does when frames are slow, would never have been down; so each change has a frame of its own, and a
// button goes down where the mouse was then.  What is typed keeps its place among them: a letter behind Ctrl+A would be
// thrown away where Ctrl were still down.
#pragma once

#include <imgui.h>

#include <array>
#include <deque>
#include <optional>

namespace spacetime::gui {

class Input {
 public:
  void button(int which, bool down, const ImVec2& at);
  void key(int glfw_key, bool down, int glfw_modifiers);
  void character(unsigned code);  // that was typed, in its place among the keys

  // Before ImGui's NewFrame: what is down in this frame, and where the mouse is; `mouse` is where it is by now.
  void give(ImGuiIO& io, const ImVec2& mouse);
  bool waiting() const { return !changes_.empty(); }  // for another frame

 private:
  struct Change {
    enum class Kind { button, key, character } kind = Kind::button;
    int which = 0;  // of a character its code
    bool down = false;
    ImVec2 at{};
    int modifiers = 0;
  };
  bool makes_letter(const Change& key) const;  // and nothing else
  std::deque<Change> changes_;
  std::array<bool, IM_ARRAYSIZE(ImGuiIO::MouseDown)> buttons_{};
  std::array<bool, IM_ARRAYSIZE(ImGuiIO::KeysDown)> keys_{};
};

}  // namespace spacetime::gui
