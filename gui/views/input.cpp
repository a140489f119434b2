#include "gui/views/input.h"

#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <vector>

namespace spacetime::gui {

void Input::button(int which, bool down, const ImVec2& at) {
  if (which >= 0 && which < static_cast<int>(buttons_.size()))
    changes_.push_back({Change::Kind::button, which, down, at, 0});
}

void Input::key(int glfw_key, bool down, int glfw_modifiers) {
  if (glfw_key >= 0 && glfw_key < static_cast<int>(keys_.size()))
    changes_.push_back({Change::Kind::key, glfw_key, down, {}, glfw_modifiers});
}

void Input::character(unsigned code) { changes_.push_back({Change::Kind::character, static_cast<int>(code)}); }

bool Input::makes_letter(const Change& key) const {
  constexpr std::array others{GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL, GLFW_KEY_LEFT_ALT,
                              GLFW_KEY_RIGHT_ALT,    GLFW_KEY_LEFT_SUPER,    GLFW_KEY_RIGHT_SUPER};
  const auto held = [&](int other) { return keys_[static_cast<std::size_t>(other)]; };
  return key.which < GLFW_KEY_ESCAPE && (key.modifiers & (GLFW_MOD_CONTROL | GLFW_MOD_ALT | GLFW_MOD_SUPER)) == 0 &&
         std::ranges::none_of(others, held);
}

void Input::give(ImGuiIO& io, const ImVec2& mouse) {
  std::vector<Change> given;
  int modifiers = 0;
  std::optional<ImVec2> at;
  for (; !changes_.empty(); changes_.pop_front()) {
    const Change& next = changes_.front();
    const bool key = next.kind == Change::Kind::key, button = next.kind == Change::Kind::button;
    // A text field wants the letters alone; with their keys one could not type faster than frames are drawn.
    if (key && io.WantTextInput && makes_letter(next) && !keys_[static_cast<std::size_t>(next.which)]) continue;
    // ImGui takes what is typed in a frame before the keys that were pressed in it.
    const auto stands_before = [&](const Change& one) {
      if (!key && !button) return one.kind == Change::Kind::key && one.down;
      return one.kind == next.kind && one.which == next.which;
    };
    if (std::ranges::any_of(given, stands_before)) break;
    if (button && at && (at->x != next.at.x || at->y != next.at.y)) break;
    if (button) at = next.at;
    if (key && next.down) modifiers |= next.modifiers;
    if (key) keys_[static_cast<std::size_t>(next.which)] = next.down;
    if (button) buttons_[static_cast<std::size_t>(next.which)] = next.down;
    if (!key && !button) io.AddInputCharacter(static_cast<unsigned>(next.which));
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
