#include "gui/journal.h"

#include <algorithm>
#include <map>

#include "protocol/check.h"
#include "protocol/motion_json.h"
#include "protocol/strict.h"
#include "protocol/writer.h"

namespace spacetime::gui {
namespace {

constexpr std::string_view journal_format = "spacetime-journal/1";
constexpr std::string_view document = "journal";

std::string text_of(const Entry& entry) { return entry.scene->text; }

std::vector<std::string> strings(const Node& node) {
  return node.each([](const Node& text) { return text.string(); });
}

// What the lines read so far make.
struct Reading {
  Restored restored;
  std::vector<std::string> script;  // as it was opened
  std::map<int, std::size_t> left;  // of it, by entry's number
  bool begun = false;

  void begin(const Node& line) {
    line.object({"journal", "file", "saved", "text", "script", "number"});
    if (line["journal"].string() != journal_format) line["journal"].refuse("this format is not known");
    restored.file = line["file"].string();
    restored.saved = line["saved"].string();
    script = strings(line["script"]);
    Entry entry;
    auto scene = std::make_shared<Scene>();
    scene->text = entry.text = line["text"].string();
    entry.scene = scene;
    entry.number = line["number"].integer();
    left[entry.number] = script.size();
    restored.log = {entry};
    begun = true;
  }

  void take_entry(const Node& line) {
    line.object({"entry", "number", "adds", "text", "actions", "iterated", "script"});
    const int index = line["entry"].integer(1, static_cast<int>(restored.log.size()));
    restored.log.resize(static_cast<std::size_t>(index));
    Entry entry;
    auto scene = std::make_shared<Scene>();
    scene->text = text_of(restored.log.back()) + line["adds"].string();
    entry.scene = scene;
    entry.text = line["text"].string();
    entry.actions = strings(line["actions"]);
    entry.iterated = line["iterated"].boolean();
    entry.number = line["number"].integer();
    left[entry.number] = static_cast<std::size_t>(line["script"].integer(0, static_cast<int>(script.size())));
    restored.log.push_back(std::move(entry));
    restored.present = index;
  }

  void take_checkpoint(const Node& line) {
    line.object({"checkpoint", "motion"});
    const auto entry = std::ranges::find(restored.log, line["checkpoint"].integer(), &Entry::number);
    if (entry == restored.log.end()) return;
    const Node node = line["motion"];
    Motion motion = motion_from(Node(node.json(), document));
    if (const auto fault = validate(motion)) node.refuse(fault->message);
    entry->checkpoint = std::make_shared<const std::string>(node.json().dump());
    entry->motion = std::make_shared<const Motion>(std::move(motion));
  }

  void take(const Node& line) {
    if (!begun) return begin(line);
    if (line.find("entry")) return take_entry(line);
    if (line.find("checkpoint")) return take_checkpoint(line);
    if (line.find("present")) {
      restored.present = line["present"].integer(0, static_cast<int>(restored.log.size()) - 1);
      return;
    }
    if (const auto pins = line.find("pins")) {
      line.object({"pins"});
      restored.pins = pins->numbers();
      return;
    }
    line.object({"saved", "file"});
    restored.saved = line["saved"].string();
    restored.file = line["file"].string();
  }
};

}  // namespace

std::string journal_begin(const State& state) {
  Writer to(false);
  to.object([&] {
    to.member("journal", journal_format);
    to.member("file", state.file);
    to.member("saved", state.saved);
    to.member("text", state.log.front().scene->text);
    to.key("script");
    to.list_of(state.script, [&](const std::string& line) { to.string(line); });
    to.member("number", state.log.front().number);
  });
  return to.take();
}

std::string journal_entry(const Entry& entry, const Scene& before, std::size_t index, std::size_t script) {
  Writer to(false);
  to.object([&] {
    to.member("entry", static_cast<int>(index));
    to.member("number", entry.number);
    to.member("adds", std::string_view(entry.scene->text).substr(before.text.size()));
    to.member("text", entry.text);
    to.key("actions");
    to.list_of(entry.actions, [&](const std::string& action) { to.string(action); });
    to.member("iterated", entry.iterated);
    to.member("script", static_cast<int>(script));
  });
  return to.take();
}

std::string journal_checkpoint(const Entry& entry) {
  return "{\"checkpoint\":" + std::to_string(entry.number) + ",\"motion\":" + *entry.checkpoint + "}";
}

std::string journal_present(int index) { return "{\"present\":" + std::to_string(index) + "}"; }

std::string journal_saved(const State& state) {
  Writer to(false);
  to.object([&] {
    to.member("saved", state.saved);
    to.member("file", state.file);
  });
  return to.take();
}

std::string journal_pins(const State& state) {
  Writer to(false);
  to.object([&] {
    to.key("pins");
    to.numbers(state.pins);
  });
  return to.take();
}

Restored read_journal(std::string_view text) {
  Reading reading;
  while (!text.empty()) {
    const auto end = text.find('\n');
    if (end == std::string_view::npos) break;  // cut short
    try {
      const Json line = parse(text.substr(0, end), document);
      reading.take(Node(line, document));
    } catch (const InputError&) {
      if (!reading.begun) throw;
      break;
    }
    text.remove_prefix(end + 1);
  }
  if (!reading.begun) throw InputError("the journal is empty");
  Restored& restored = reading.restored;
  std::size_t left = reading.left[restored.log.back().number];
  // What came last may not have been answered any more.
  std::vector<std::string> again;
  while (restored.log.size() > 1 && !restored.log.back().checkpoint) {
    const Entry last = std::move(restored.log.back());
    restored.log.pop_back();
    const bool shown = restored.present >= static_cast<int>(restored.log.size());
    if (shown) again.insert(again.begin(), text_of(last).substr(text_of(restored.log.back()).size()));
    restored.present = std::min(restored.present, static_cast<int>(restored.log.size()) - 1);
  }
  restored.script = std::move(again);
  restored.script.insert(restored.script.end(), reading.script.end() - static_cast<std::ptrdiff_t>(left),
                         reading.script.end());
  return restored;
}

bool unsaved(const Restored& restored) {
  std::string text = text_of(restored.log[restored.present]);
  for (const std::string& line : restored.script) text += line;
  return text != restored.saved;
}

}  // namespace spacetime::gui
