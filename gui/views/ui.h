// What every view gets: the state to show, where to put what the person does, and its own memory of how it is looked at
// (what is open, scrolled, or half typed), which is nobody else's business.
#pragma once

#include <imgui.h>

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "gui/event.h"
#include "gui/question.h"
#include "gui/render/camera.h"
#include "gui/residuals.h"
#include "gui/state.h"
#include "gui/views/theme.h"

namespace spacetime::gui {

struct Rect {
  float x = 0, y = 0, width = 0, height = 0;  // pixels, from the window's upper left corner
};

struct CurvesMemory {
  double low = 0, high = 0;  // shown; equal: fitted
  bool derivative[3]{true, false, false};
  bool controls = true, knots = true;
  enum class Show { curves, residuals, multipliers } show = Show::curves;
  std::string dragged;  // degree of freedom of the control point that is being dragged
  int dragged_index = -1;
  std::size_t dragged_of = 0;  // so many control points its curve had when it was taken hold of
  double dragged_value = 0;
  std::string reading;  // what is told of the curve that the mouse is near
  std::string lacking;  // what is told of curves that are asked for and not there
  bool held = false;    // what is shown stays while a control point is dragged, though it was fitted
};

struct SceneMemory {
  Camera camera{.pitch = 0.12F};  // a little from above, so that the ground is seen
  bool framed = false;            // the camera has been put in front of the scene
  int framed_for = 0;             // State::opened
  float ground = 0;               // m, under the lowest that the figure has come since
  long grounded = -1;             // State::revision
  bool trails = true, ghosts = true, forces = false, marks = true, legend = true;
  std::string pointed;  // what is told of the part under the pointer
  std::string doing;    // ... of what is being done
};

struct BarMemory {
  std::string dragged;   // the bar of which an end is held; one mouse, one drag
  double ends[2]{0, 0};  // s, of it
};

struct SelectionToolsMemory {
  double strength = 0.5, amplitude = 0.1;  // of a filter, s; of a shake
  int seed = 1;
};

// The control that the mouse is over, for its help.
struct HelpMemory {
  ImVec2 corner{-1, -1};  // of it
  double since = 0;       // s, by ImGui's clock
  int frame = -1;         // in which it was last so
  bool used = false;      // it was pressed: there is no help until the mouse leaves it
};

struct SpanMemory {
  double start = 0, end = 0;  // s, of the scene
  double from = 0, to = 0;    // s, of it shown by the timeline and the curves
};

struct KeyMemory {
  int dragged = -1;  // index into Question::keys
  double time = 0;   // s, where it is held
  bool moved = false;
};

// What a folder holds, as it was when it was last looked at.
struct Listing {
  std::string folder;
  double since = -1;                                // s, by ImGui's clock
  std::vector<std::pair<bool, std::string>> names;  // not a folder, name: folders come first
  bool failed = false;
};

// Likewise a file.
struct Looked {
  std::string file;
  double since = -1;  // s
  bool there = false, regular = false;
};

struct FilesMemory {
  enum class Dialog { none, open, save, film } dialog = Dialog::none;
  std::string folder, name;
  Listing listing;
  Looked looked;
  // Films:
  bool as_seen = true;   // by the window's camera
  int size[2]{0, 0};     // pixels
  double rate = 30;      // pictures a second
  double span[2]{0, 0};  // s
};

// What comes after the scene that is open, and how far it is decided what becomes of that.
struct Leaving {
  enum class To { quit, file, example, fresh } to = To::quit;
  std::string file{};
  enum class Stage {
    asking,
    naming,    // the file that it is to be saved in
    stopping,  // the run, whose outcome is to be saved
    saving,    // goes on when that is done
  } stage = Stage::asking;
};

inline constexpr int scene_tab = 1;  // of the tools: the scene's text

// What a question was worked out from: nothing else changes it.
struct Asked {
  std::shared_ptr<const Scene> scene;
  int present = -1;
  std::size_t acts = 0;
  // Of the present entry: an act may join one that is there, and where it led is known later.
  int number = 0;
  std::size_t actions = 0;
  std::shared_ptr<const Motion> motion;
  bool operator==(const Asked&) const = default;
};

// A line of the log as it is shown.
struct LogLine {
  int number = 0;  // of its entry
  std::shared_ptr<const Motion> motion;
  std::size_t length = 0;       // bytes, of the entry's text
  float width = 0, height = 0;  // pixels, of the text wrapped
  std::string text;
};

struct Memory {
  Fonts fonts;
  Colours colours;
  std::optional<bool> dark;  // the theme that `colours` and ImGui have been given
  float scale = 1;
  Asked asked;
  Question question;
  long measured = -1;  // State::revision that `residuals` are of
  Residuals residuals;
  std::shared_ptr<const Scene> mistaken;  // whose text has been brought forward
  bool helping = false;                   // a help is shown in this frame
  std::set<std::string> helped;           // names of this frame's controls that have help
  std::map<std::string, Rect> places;  // of this frame's controls, by name: for help, and for whoever drives the window
  SceneMemory scene;
  CurvesMemory curves;
  HelpMemory help;
  BarMemory bar;
  KeyMemory key;
  SpanMemory span;
  SelectionToolsMemory selection_tools;
  FilesMemory files;
  std::set<std::string> told;                   // the notices that were shown in the last frame
  std::set<std::string> focused_drafts;         // the keyboard has been given to them
  bool drag_dropped = false;                    // by Esc: nothing more comes of it until the button is let go
  double bounds[2]{-1, 1};                      // being typed
  float left = 320, right = 330, bottom = 310;  // pixels at scale 1, of the panels
  int tab_left = -1, tab_right = -1;            // to be chosen in the next frame
  bool welcome = false, shortcuts = false;
  bool quit = false;               // the window is to be closed
  bool discard = false;            // ... and what is not saved is to be thrown away
  std::optional<Leaving> leaving;  // once the person has decided about unsaved changes
  std::vector<LogLine> log_lines;
  std::string console, console_by;
  int scroll_to_line = 0;               // in the scene text
  bool objective_by_iteration = false;  // rather than how far it is from converged
  int method = 0;
  std::string standing;      // what the panel says of the run in a few words
  float outcome_height = 0;  // pixels, of the rest
  double tolerance = 1e-8;
  int starts = 1;
};

struct Ui {
  const State& state;
  Memory& memory;
  std::vector<Event>& events;

  void emit(Event event) { events.push_back(std::move(event)); }
  void act(std::string line, Notice::Place place = Notice::Place::status, std::string about = {}) {
    emit(Act{std::move(line), place, std::move(about)});
  }
  const Colours& colours() const { return memory.colours; }
  const Question& question() const { return memory.question; }  // of the scene shown
  const Residuals& residuals() const;                           // of its equations, on the curves shown
  const ImVec4& colour(Severity severity) const;
  float scaled(float pixels) const { return pixels * memory.scale; }

  // The last item is a control of this name, and helped with: what a person can press, turn or write into.  Tests find
  // it by the name, and know by it that there is help.
  void control(const std::string& name, const std::string& text);
  // Remembers where the last item is, so that it can be found by name: what is only looked at.
  void here(const std::string& name);
  // Help that appears beside the last item, when the mouse has stayed on it and not pressed it.
  void help(const char* text) const;
  // The notices of a place, about something or about nothing in particular.
  // Whether one of them has come since the last frame.
  bool notices(Notice::Place place, const std::string& about = {});
};

// Brings the memory up to the state, once a frame.
void refresh(Ui& ui);

// Behind all views of a frame: ends what is held no more.  Its control sees that itself, unless it is gone, or lay
// under a dialog when the button was let go.
void end_lost_drags(Ui& ui);

// Whether there is something to show; says why not.
bool has_problem(const Ui& ui);

// A number for people: four significant digits.
std::string shown(double number);

}  // namespace spacetime::gui
