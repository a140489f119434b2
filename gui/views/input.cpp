#include "gui/views/input.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <vector>

namespace spacetime::gui {

void Input::button(int which, bool down, const ImVec2& at) {
  if (which >= 0 && which < static_cast<int>(buttons_.size())) changes_.push_back({false, which, down, at, 0});
}

void Input::key(int glfw_key, bool down, int glfw_modifiers) {
  if (glfw_key >= 0 && glfw_key < static_cast<int>(keys_.size()))
    changes_.push_back({true, glfw_key, down, {}, glfw_modifiers});
}

void Input::give(ImGuiIO& io, const ImVec2& mouse) {
  std::vector<Change> given;
  int modifiers = 0;
  std::optional<ImVec2> at;
  for (; !changes_.empty(); changes_.pop_front()) {
    const Change& next = changes_.front();
    const auto same = [&](const Change& one) { return one.key == next.key && one.which == next.which; };
    if (std::ranges::any_of(given, same)) break;
    if (!next.key && at && (at->x != next.at.x || at->y != next.at.y)) break;
    if (!next.key) at = next.at;
    if (next.key && next.down) modifiers |= next.modifiers;
    (next.key ? keys_[static_cast<std::size_t>(next.which)] : buttons_[static_cast<std::size_t>(next.which)]) =
        next.down;
    given.push_back(next);
  }
  io.MousePos = at.value_or(mouse);
  std::ranges::copy(buttons_, io.MouseDown);
  std::ranges::copy(keys_, io.KeysDown);
  const auto held = [&](int left, int right, int bit) {
    return keys_[static_cast<std::size_t>(left)] || keys_[static_cast<std::size_t>(right)] || (modifiers & bit) != 0;
  };
  io.KeyCtrl = held(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL, GLFW_MOD_CONTROL);
  io.KeyShift = held(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT, GLFW_MOD_SHIFT);
  io.KeyAlt = held(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT, GLFW_MOD_ALT);
}

}  // namespace spacetime::gui
