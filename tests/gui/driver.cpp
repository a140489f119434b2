#include "tests/gui/driver.h"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include "common/files.h"
#include "tests/gui/driven.h"

namespace spacetime::test {

Driver::Driver(gui::HubOptions options, int width, int height, float scale)
    : hub_(std::move(options)), screen_(width, height, scale) {}

void Driver::frame(int count) {
  for (int k = 0; k < count; ++k) {
    hub_.step(1.0 / 60);
    for (gui::Event& event : screen_.frame(hub_.state())) hub_.post(std::move(event));
  }
}

void Driver::until(const std::function<bool(const gui::State&)>& holds, const std::string& what) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!holds(hub_.state())) {
    frame();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (std::chrono::steady_clock::now() > deadline)
      throw std::runtime_error("waited in vain for " + what + "; told: " + told(hub_.state()));
  }
}

void Driver::settle() {
  frame(2);
  until(quiet, "quiet");
  frame(2);
}

void Driver::open(const std::string& text) {
  hub_.post(gui::OpenText{text});
  until([](const gui::State& s) { return s.curves != nullptr; }, "the scene");
  settle();
}

void Driver::open_example(const std::string& name) {
  open(read_text(SPACETIME_SOURCE_DIR "/examples/" + name + ".scene"));
}

bool Driver::has(const std::string& name) { return screen_.memory().places.contains(name); }

gui::Rect Driver::place(const std::string& name) {
  if (!has(name)) frame(2);
  const auto found = screen_.memory().places.find(name);
  if (found == screen_.memory().places.end()) {
    ADD_FAILURE() << "there is no '" << name << "' on the screen";
    return {};
  }
  return found->second;
}

void Driver::click(const std::string& name, int button) {
  const gui::Rect r = place(name);
  screen_.move(r.x + r.width / 2, r.y + r.height / 2);
  frame(2);
  screen_.button(button, true);
  frame();
  screen_.button(button, false);
  frame(2);
}

void Driver::drag(const std::string& name, float dx, float dy, int steps, bool let_go_then, int button) {
  const gui::Rect r = place(name);
  const float x = r.x + r.width / 2, y = r.y + r.height / 2;
  screen_.move(x, y);
  frame(2);
  screen_.button(button, true);
  frame();
  for (int k = 1; k <= steps; ++k) {
    const float share = static_cast<float>(k) / static_cast<float>(steps);
    screen_.move(x + share * dx, y + share * dy);
    frame();
  }
  if (let_go_then) let_go(button);
}

void Driver::let_go(int button) {
  screen_.button(button, false);
  frame(2);
}

void Driver::wheel(const std::string& name, float by, bool shift) {
  const gui::Rect r = place(name);
  screen_.move(r.x + r.width / 2, r.y + r.height / 2);
  if (shift) screen_.key(GLFW_KEY_LEFT_SHIFT, true);
  frame(2);
  screen_.wheel(by);
  frame();
  screen_.key(GLFW_KEY_LEFT_SHIFT, false);
  frame(2);
}

void Driver::key(int glfw_key, bool control, bool shift) {
  if (control) screen_.key(GLFW_KEY_LEFT_CONTROL, true);
  if (shift) screen_.key(GLFW_KEY_LEFT_SHIFT, true);
  frame();
  screen_.key(glfw_key, true);
  frame();
  screen_.key(glfw_key, false);
  screen_.key(GLFW_KEY_LEFT_CONTROL, false);
  screen_.key(GLFW_KEY_LEFT_SHIFT, false);
  frame();
}

void Driver::type(const std::string& text) {
  screen_.type(text);
  frame(2);
}

void Driver::write_into(const std::string& name, const std::string& text) {
  click(name);
  type(text);
  key(GLFW_KEY_ENTER);
}

void Driver::save_picture(const std::string& file) {
  const char* folder = std::getenv("SPACETIME_SCREENSHOTS");
  if (folder) gui::write_png(std::string(folder) + "/" + file, screen_.image());
}

}  // namespace spacetime::test
