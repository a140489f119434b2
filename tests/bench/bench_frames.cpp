// The window's frames on this machine, without a display: how long one takes while the throw is open and being solved,
// and how long it takes from moving the basket to seeing the figure move.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <thread>
#include <vector>

#include "gui/hub.h"
#include "gui/screen.h"
#include "gui/words.h"

namespace {

using namespace spacetime;
using Clock = std::chrono::steady_clock;

double milliseconds(Clock::time_point since) {
  return std::chrono::duration<double, std::milli>(Clock::now() - since).count();
}

struct Times {
  std::vector<double> all;
  double at(double share) {
    std::ranges::sort(all);
    return all.empty() ? 0 : all[static_cast<std::size_t>(share * static_cast<double>(all.size() - 1))];
  }
};

struct Split {
  Times step, draw;
};

void frame(gui::Hub& hub, gui::Screen& screen, Split& split) {
  const auto begun = Clock::now();
  hub.step(1.0 / 60);
  const double stepped = milliseconds(begun);
  for (gui::Event& event : screen.frame(hub.state())) hub.post(std::move(event));
  screen.finish();
  split.step.all.push_back(stepped);
  split.draw.all.push_back(milliseconds(begun) - stepped);
}

void report(const char* what, Split& split) {
  Times whole;
  for (std::size_t i = 0; i < split.draw.all.size(); ++i) whole.all.push_back(split.step.all[i] + split.draw.all[i]);
  fmt::print("{:<28} {:5} frames: median {:6.2f} ms, worst tenth {:6.2f} ms (update {:.2f}, drawing {:.2f})\n", what,
             whole.all.size(), whole.at(0.5), whole.at(0.9), split.step.at(0.5), split.draw.at(0.5));
}

}  // namespace

int main() {
  const auto daemon = [](const std::string& name) {
    return protocol::Target{{SPACETIME_BIN_DIR "/spacetime-" + name, "serve"}, {}, {}};
  };
  gui::Hub hub({daemon("symbolic"), daemon("optimizer"), {}, {}});
  gui::Screen screen(1280, 800);
  Split opening, still, solving, dragging;
  hub.post(gui::Open{SPACETIME_SOURCE_DIR "/examples/throw.scene"});
  while (!hub.state().curves) frame(hub, screen, opening);
  for (int k = 0; k < 100; ++k) frame(hub, screen, still);
  report("open, nothing going on", still);

  // One solve takes 20 ms: a hundred of them, from the beginning each time, so that most frames see one.
  for (int k = 0; k < 100; ++k) {
    if (!hub.state().running && hub.state().waiting == 0) {
      hub.post(gui::Act{"reset"});
      hub.post(gui::Act{"solve"});
    }
    frame(hub, screen, solving);
  }
  report("solving", solving);

  // The basket is moved, and then the figure.
  while (hub.state().running || hub.state().waiting > 0) frame(hub, screen, opening);
  Times answered, frames;
  screen.move(640, 797);  // below everything: what is dragged ends with the button
  screen.button(0, true);
  for (int k = 0; k < 60; ++k) {
    const double x = 2.5 - 0.3 * k / 60;
    gui::Words words = gui::set_words("BasketX", x);
    const long before = hub.state().revision;
    const auto begun = Clock::now();
    hub.post(gui::Steer{{words.line, {words.action}, {{"BasketX", x}}}});
    int count = 0;
    while (hub.state().revision == before && count < 100) {
      frame(hub, screen, dragging);
      ++count;
    }
    answered.all.push_back(milliseconds(begun));
    frames.all.push_back(count);
  }
  screen.button(0, false);
  report("dragging the basket", dragging);
  fmt::print("from input to the moved figure: median {:.1f} ms, {:.0f} frames; worst tenth {:.1f} ms, {:.0f} frames\n",
             answered.at(0.5), frames.at(0.5), answered.at(0.9), frames.at(0.9));
}
