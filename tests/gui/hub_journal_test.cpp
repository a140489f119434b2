// Sessions that end badly: whatever was answered is found again.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <random>

#include "common/files.h"
#include "gui/journal.h"
#include "gui/words.h"
#include "tests/gui/driven.h"
#include "tests/process/process.h"

namespace spacetime::test {
namespace {

using namespace gui;
namespace fs = std::filesystem;

std::vector<std::string> journals(const std::string& folder) {
  std::vector<std::string> files;
  if (!fs::exists(folder)) return files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().string().ends_with(journal_extension)) files.push_back(entry.path().string());
  }
  return files;
}

// A few acts, one after another.
void work(Hub& hub) {
  post_and_wait(hub, OpenText{text_of("examples/throw.scene")});
  post_and_wait(hub, RunScript{});
  act(hub, "set BasketX = 2.3");
  act(hub, "solve");
  act(hub, key_words(0.5, {{"arm.elbow", 0.25}}).line);
  post_and_wait(hub, Undo{});
}

void restore(Hub& hub, const std::string& journal) {
  hub.post(Open{journal});
  until(
      hub, [](const State& state) { return state.present >= 0; }, "the journal");
  until_quiet(hub);
}

TEST(HubJournal, BringsBackLogMotionsAndPlaceWithoutSolving) {
  const std::string folder = scratch("journal");
  std::string text, curves;
  {
    Hub hub(daemons(folder));
    work(hub);
    text = text_to_save(hub.state());
    curves = curves_text(*hub.state().motion);
    EXPECT_EQ(hub.state().present, 3);
  }  // without a farewell
  Hub hub(daemons(folder));
  until(
      hub, [](const State& state) { return !state.left.empty(); }, "what was left behind");
  ASSERT_EQ(hub.state().left.size(), 1U);
  restore(hub, hub.state().left[0].journal);
  const State& state = hub.state();
  EXPECT_TRUE(state.record.iterations.empty());  // nothing iterated
  EXPECT_TRUE(state.left.empty());
  EXPECT_FALSE(state.selection.dofs.empty());  // there are curves to be seen
  EXPECT_EQ(state.log.size(), 5U);
  EXPECT_EQ(state.present, 3);
  EXPECT_EQ(text_to_save(state), text);
  EXPECT_TRUE(curves_text(*state.motion) == curves);
  post_and_wait(hub, Redo{});
  act(hub, "solve");
  EXPECT_TRUE(curves_text(*state.motion) == batch_curves(text_to_save(state)));
  post_and_wait(hub, GoTo{1});
  act(hub, "iterate 1");
  EXPECT_TRUE(curves_text(*state.motion) == batch_curves(text_to_save(state)));

  // Saved and closed, nothing is left of it.
  const std::string file = scratch("kept.scene");
  hub.post(Save{file});
  until(
      hub, [&](const State& now) { return now.file == file; }, "the file");
  hub.close();
  until(
      hub, [&](const State&) { return journals(folder).empty(); }, "the journal to go");
}

// Pinned ghosts are no lines of the log, and are found again all the same: as they were left, twice over.
TEST(HubJournal, KeepsPinnedGhosts) {
  const std::string folder = scratch("pins");
  {
    Hub hub(daemons(folder));
    post_and_wait(hub, OpenText{text_of("examples/double_integrator.scene")});
    act(hub, "iterate 1");
    for (const double time : {0.75, 0.25, 0.5}) hub.post(Pin{time, true});
    hub.post(Pin{0.5, false});
    hub.step(0);
  }
  for (int again = 0; again < 2; ++again) {
    Hub hub(daemons(folder));
    until(
        hub, [](const State& state) { return !state.left.empty(); }, "what was left behind");
    restore(hub, hub.state().left[0].journal);
    EXPECT_EQ(hub.state().pins, (std::vector<double>{0.25, 0.75}));
  }
}

// What somebody else wrote into its file while it was gone is told of, and not written over unasked.
TEST(HubJournal, KnowsWhetherItsFileWasChangedMeanwhile) {
  for (const bool changed : {false, true}) {
    const std::string folder = scratch(changed ? "changed" : "unchanged"), file = scratch("meanwhile.scene");
    {
      Hub hub(daemons(folder));
      write_text(file, text_of("examples/double_integrator.scene"));
      hub.post(Open{file});
      until(
          hub, [](const State& state) { return state.present == 0; }, "the scene");
      act(hub, "iterate 1");
    }
    if (changed) write_text(file, "time [0, 1]\n");
    Hub hub(daemons(folder));
    until(
        hub, [](const State& state) { return !state.left.empty(); }, "what was left behind");
    restore(hub, hub.state().left[0].journal);
    hub.post(Save{});
    until(
        hub, [](const State& state) { return !unsaved(state) || !state.notices.empty(); }, "the file or a refusal");
    EXPECT_EQ(unsaved(hub.state()), changed) << told(hub.state());
    EXPECT_EQ(read_text(file) == "time [0, 1]\n", changed);
    until(
        hub, [&](const State& state) { return !changed || told(state).find("another program") != std::string::npos; },
        "a word of it");
    hub.post(Save{});
    until(
        hub, [](const State& state) { return !unsaved(state); }, "the file");
  }
}

TEST(HubJournal, SavingBeforeLeavingIsWaitedFor) {
  for (const bool possible : {true, false}) {
    const std::string folder = scratch(possible ? "left" : "not_left");
    {
      Hub hub(daemons(folder));
      post_and_wait(hub, OpenText{text_of("examples/double_integrator.scene")});
      act(hub, "iterate 1");
      hub.post(Save{possible ? scratch("left.scene") : scratch("no_folder") + "/left.scene"});
      hub.close();
    }
    EXPECT_EQ(journals(folder).size(), possible ? 0U : 1U);
  }
}

TEST(HubJournal, IsReadUpToWhereItWasCut) {
  const std::string folder = scratch("cut");
  {
    Hub hub(daemons(folder));
    work(hub);
  }
  ASSERT_EQ(journals(folder).size(), 1U);
  const std::string whole = read_text(journals(folder)[0]);
  const Restored all = read_journal(whole);
  EXPECT_EQ(all.log.size(), 5U);
  std::mt19937 random(1995);
  const auto first = whole.find('\n') + 1;
  for (int i = 0; i < 40; ++i) {
    const auto length = std::uniform_int_distribution<std::size_t>(first, whole.size())(random);
    const Restored cut = read_journal(std::string_view(whole).substr(0, length));
    ASSERT_LE(cut.log.size(), all.log.size());
    // Every entry is there, or what it was is to be done again.
    std::string text = cut.log[cut.present].scene->text;
    for (const Entry& entry : cut.log) EXPECT_TRUE(entry.checkpoint || cut.log.size() == 1);
    for (const std::string& line : cut.script) text += line;
    EXPECT_TRUE(text.starts_with(all.log[0].scene->text + "solve\n"));
  }
  EXPECT_THROW(read_journal(std::string_view(whole).substr(0, first - 1)), InputError);
}

// The process that has the window is killed at some moment of a session.
TEST(HubJournal, AKilledWindowLosesAtMostTheActInFlight) {
  std::mt19937 random(1996);
  for (int round = 0; round < kills(6); ++round) {
    const std::string folder = scratch("killed" + std::to_string(round));
    const int moment = std::uniform_int_distribution<int>(5, 250)(random);
    const std::string text = text_of("examples/throw.scene");
    // The child writes down what it has been answered.
    const std::string answered = scratch("answered" + std::to_string(round));
    const pid_t child = fork();
    if (child == 0) {
      std::vector<std::string> acts{"set BasketX = 2.3", "solve",        "set BasketY = 0.6",
                                    "iterate 3",         "disable calm", "solve"};
      Hub hub(daemons(folder));
      hub.post(OpenText{text});
      std::size_t next = 0;
      for (int step = 0; step < moment || next < 2; ++step) {
        hub.step(0.001);
        usleep(1000);
        if (!quiet(hub.state()) || !hub.written() || next == acts.size()) continue;
        write_text(answered, text_to_save(hub.state()));
        hub.post(Act{acts[next++]});
        hub.step(0);
      }
      kill(getpid(), SIGKILL);
    }
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_TRUE(WIFSIGNALED(status));
    Hub hub(daemons(folder));
    until(
        hub, [](const State& state) { return state.left.size() == 1; }, "what was left behind");
    restore(hub, hub.state().left[0].journal);
    const State& state = hub.state();
    // The script `solve\n` of the file stands behind what was done.
    const std::string known = read_text(answered);
    const std::string done = known.substr(0, known.size() - std::string("solve\n").size());
    EXPECT_TRUE(text_to_save(state).starts_with(done)) << "moment " << moment;
    if (!state.script.empty()) post_and_wait(hub, RunScript{});
    EXPECT_TRUE(curves_text(*state.motion) == batch_curves(text_to_save(state))) << "moment " << moment;
    hub.close(true);
  }
}

TEST(HubJournal, RemembersFilesAndTheme) {
  const std::string folder = scratch("settings"), file = scratch("remembered.scene");
  write_text(file, text_of("examples/double_integrator.scene"));
  {
    Hub hub(daemons(folder));
    post_and_wait(hub, OpenText{"time [0, 1]\n"});
    hub.post(SetTheme{false});
    hub.post(Open{file});
    until(
        hub, [&](const State& state) { return state.file == file; }, "the file");
    until_quiet(hub);
    hub.close();
  }
  Hub hub(daemons(folder));
  until(
      hub, [](const State& state) { return !state.recent.empty(); }, "settings");
  EXPECT_FALSE(hub.state().dark);
  EXPECT_EQ(hub.state().recent, std::vector<std::string>{file});
  EXPECT_TRUE(hub.state().left.empty());
}

TEST(HubJournal, AFileThatOthersChangeIsReadAgainUntilSomethingIsDone) {
  const std::string file = scratch("changed.scene");
  write_text(file, "time [0, 1\n");
  Hub hub(daemons());
  post_and_wait(hub, Open{file});
  until(
      hub, [](const State& state) { return state.present == 0; }, "the scene");
  EXPECT_FALSE(hub.state().scene->problem);
  write_text(file, text_of("examples/double_integrator.scene"));
  until(
      hub, [](const State& state) { return state.scene && state.scene->problem; }, "the mended scene");
  until_quiet(hub);
}

}  // namespace
}  // namespace spacetime::test
