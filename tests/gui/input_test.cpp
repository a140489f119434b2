// Keys and letters that come faster than frames.
#include "gui/views/input.h"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <string>

namespace spacetime::gui {
namespace {

// What ImGui was given in one frame: its letters, and whether Ctrl or Backspace was down.
struct Frame {
  std::string letters;
  bool control = false, backspace = false;
};

std::vector<Frame> frames_of(Input& input) {
  std::vector<Frame> frames;
  do {
    ImGuiIO& io = ImGui::GetIO();
    io.ClearInputCharacters();
    input.give(io, {0, 0});
    Frame& frame = frames.emplace_back();
    for (const ImWchar letter : io.InputQueueCharacters) frame.letters += static_cast<char>(letter);
    frame.control = io.KeyCtrl;
    frame.backspace = io.KeysDown[GLFW_KEY_BACKSPACE];
  } while (input.waiting());
  return frames;
}

class InputTest : public testing::Test {
 protected:
  InputTest() { ImGui::CreateContext(); }
  ~InputTest() override { ImGui::DestroyContext(); }

  void type(const std::string& text) {
    for (const char letter : text) {
      const int key = std::toupper(letter);
      input.key(key, true, 0);
      input.character(static_cast<unsigned>(letter));
      input.key(key, false, 0);
    }
  }
  void press(int key, int modifiers = 0) {
    input.key(key, true, modifiers);
    input.key(key, false, modifiers);
  }

  Input input;
};

TEST_F(InputTest, ATextFieldIsGivenAllLettersAtOnce) {
  ImGui::GetIO().WantTextInput = true;
  type("basket");
  const auto frames = frames_of(input);
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames.front().letters, "basket");
}

TEST_F(InputTest, WithoutATextFieldEachKeyIsDownForAFrame) {
  type("kg");
  int down = 0;
  do {
    input.give(ImGui::GetIO(), {0, 0});
    down += ImGui::GetIO().KeysDown['K'] + ImGui::GetIO().KeysDown['G'];
  } while (input.waiting());
  EXPECT_EQ(down, 2);
}

TEST_F(InputTest, LettersKeepTheirPlaceAmongKeysThatAct) {
  ImGui::GetIO().WantTextInput = true;
  type("ab");
  press(GLFW_KEY_BACKSPACE);
  type("c");
  std::string all;
  for (const Frame& frame : frames_of(input)) all += frame.letters + (frame.backspace ? "<" : "");
  EXPECT_EQ(all, "ab<c");
}

TEST_F(InputTest, ALetterBehindCtrlIsNotGivenWithIt) {
  ImGui::GetIO().WantTextInput = true;
  input.key(GLFW_KEY_LEFT_CONTROL, true, 0);
  press('A', GLFW_MOD_CONTROL);
  input.key(GLFW_KEY_LEFT_CONTROL, false, 0);
  type("x");
  std::string all;
  for (const Frame& frame : frames_of(input)) {
    EXPECT_FALSE(frame.control && !frame.letters.empty());
    all += frame.letters;
  }
  EXPECT_EQ(all, "x");
}

}  // namespace
}  // namespace spacetime::gui
