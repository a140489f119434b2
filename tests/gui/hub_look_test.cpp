// How the session is looked at: notices, samples, poses, playback.
#include <cmath>
#include <functional>

#include "protocol/json.h"
#include "protocol/strict.h"
#include "tests/gui/table.h"

namespace spacetime::gui {
namespace {

TEST(Update, WhatIsToldOfFilesAndDaemonsOutlivesActs) {
  Table table;
  table.feed(FileRead{"/a.scene", "time\n"});
  table.compile();
  table.acknowledge(table.take("problem/load"));
  table.reach(0);
  table.set();
  table.reach(0);
  table.feed(FileChanged{"/a.scene"});
  table.feed(DaemonIs{true, Daemon::Condition::lost, "gone"});
  table.feed(Act{"set k"});
  EXPECT_EQ(table.state.notices.size(), 2U);

  // Saving is refused once.
  table.feed(Save{});
  EXPECT_FALSE(std::get<WriteFile>(table.others.back()).overwrite);
  table.feed(FileChanged{"/a.scene", true, std::get<WriteFile>(table.others.back()).number});
  EXPECT_EQ(table.state.notices.size(), 3U);
  table.feed(Save{});
  EXPECT_TRUE(std::get<WriteFile>(table.others.back()).overwrite);
  table.feed(FileWritten{"/a.scene", text_of(table.state), std::get<WriteFile>(table.others.back()).number});
  ASSERT_EQ(table.state.notices.size(), 2U);
  EXPECT_TRUE(table.state.notices[0].lasting);  // the daemon is lost still
  EXPECT_EQ(table.state.notices[1].text, "a.scene is saved.");
  table.feed(Save{});
  EXPECT_FALSE(std::get<WriteFile>(table.others.back()).overwrite);
}

// A table with a scene of a file.
Table of_file(const std::string& file) {
  Table table;
  table.feed(FileRead{file, "time\n"});
  table.compile();
  table.acknowledge(table.take("problem/load"));
  table.reach(0);
  return table;
}

template <typename Which>
const Which* newest(const Table& table) {
  const Which* found = nullptr;
  for (const Effect& effect : table.others)
    if (const auto* which = std::get_if<Which>(&effect)) found = which;
  return found;
}

TEST(Update, ASaveThatIsAnsweredLateNamesNoOtherScene) {
  Table table = of_file("/a.scene");
  table.set();
  table.reach(0);
  table.feed(Save{});
  const int first = newest<WriteFile>(table)->number;
  table.feed(Save{"/b.scene"});
  const int second = newest<WriteFile>(table)->number;
  table.feed(FileWritten{"/a.scene", "time\nset k\n", first});
  EXPECT_EQ(table.state.saving, "/b.scene");  // the other is still awaited
  table.feed(OpenText{"time\n"});
  table.compile();
  table.feed(FileWritten{"/b.scene", "time\nset k\n", second});
  EXPECT_EQ(table.state.file, "");
  EXPECT_EQ(table.state.saved, "time\n");
  EXPECT_EQ(table.state.recent.front(), "/b.scene");
}

TEST(Update, WhatIsDiscardedLeavesNoJournal) {
  for (const bool discard : {false, true}) {
    Table table = of_file("/a.scene");
    table.set();
    table.reach(0);
    table.feed(OpenText{"time\n", discard});
    ASSERT_TRUE(newest<JournalEnd>(table));
    EXPECT_EQ(newest<JournalEnd>(table)->keep, !discard);
    Table other = of_file("/a.scene");
    other.set();
    other.reach(0);
    other.feed(Open{"/b.scene", discard});
    EXPECT_EQ(newest<ReadFile>(other)->discard, discard);
    other.feed(FileRead{"/b.scene", "time\n", discard});
    EXPECT_EQ(newest<JournalEnd>(other)->keep, !discard);
  }
}

TEST(Update, WhatGoesOnWouldBeLostByLeaving) {
  Table table = of_file("/a.scene");
  EXPECT_FALSE(would_lose(table.state));
  table.feed(Draft{"goal", "x = 1"});
  EXPECT_TRUE(would_lose(table.state));
  table.feed(Draft{"goal", std::nullopt});
  EXPECT_FALSE(would_lose(table.state));
  table.feed(Act{"solve"});
  EXPECT_TRUE(would_lose(table.state));
  table.compile();
  EXPECT_TRUE(table.state.running);
  EXPECT_FALSE(unsaved(table.state));
  EXPECT_TRUE(would_lose(table.state));
}

// As an editor beside the window has it, which writes the file again and again.
TEST(Update, AFileThatIsReadAgainIsLookedAtAsBefore) {
  Table table = of_file("/a.scene");
  const int opened = table.state.opened;
  Selection selection;
  selection.expressions = {"x'"};
  table.feed(Select{selection});
  table.feed(Pin{0, true});
  table.feed(ShowSpan{0.25, 0.5});
  table.feed(Draft{"goal", "x = 1"});
  const auto read = [&](const std::string& file) {
    table.feed(FileRead{file, "time\ntime\n"});
    table.compile();
  };
  read("/a.scene");
  EXPECT_EQ(table.state.selection.expressions, selection.expressions);
  EXPECT_EQ(table.state.pins, std::vector<double>{0});
  EXPECT_NE(std::get<JournalLine>(table.others.back()).json.find("pins"), std::string::npos);
  EXPECT_EQ(table.state.span, std::pair(0.25, 0.5));
  EXPECT_EQ(table.state.drafts.at("goal"), "x = 1");
  EXPECT_EQ(table.state.opened, opened);
  read("/b.scene");
  EXPECT_TRUE(table.state.selection.expressions.empty());
  EXPECT_TRUE(table.state.pins.empty());
  EXPECT_TRUE(table.state.drafts.empty());
  EXPECT_NE(table.state.opened, opened);
}

TEST(Update, PicturesAreMadeOfAMotionThatIsShown) {
  Table table = of_file("/a.scene");
  const Request run = table.solve();
  table.feed(Film{"a.mp4"});
  EXPECT_FALSE(newest<MakeFilm>(table));  // it would be of the motion before
  EXPECT_FALSE(table.state.notices.empty());
  table.done(run, {{run.params.substr(9), "solve"}}, true);
  table.reach(3);
  table.feed(Film{"a.mp4"});
  EXPECT_TRUE(newest<MakeFilm>(table));

  Table written;  // the optimizer cannot take it yet
  written.feed(OpenText{"time\n"});
  written.compile();
  written.feed(Refused{written.take("problem/load").number, "nothing moves"});
  written.feed(Film{"a.mp4"});
  EXPECT_FALSE(newest<MakeFilm>(written));
}

TEST(Update, ALongRecordIsThinned) {
  Table table;
  table.open();
  const Request run = table.solve();
  for (int i = 1; i <= 20000; ++i) {
    IterationRecord record;
    record.iteration = i;
    table.feed(Iterated{run.number, {record}, {}, {}});
  }
  const auto& records = table.state.record.iterations;
  EXPECT_LE(records.size(), 4096U);
  EXPECT_GE(records.size(), 2000U);
  EXPECT_EQ(table.state.record.made(), 20000);
  EXPECT_TRUE(std::ranges::is_sorted(records, std::less_equal{}, &IterationRecord::iteration));
}

// A daemon's answer that no request could have had.
TEST(Update, IterationsBeforeTheFirstEntryAreNoPartOfIt) {
  Table table;
  table.feed(OpenText{"time\n"});
  table.compile();
  table.feed(Reached{table.take("motion/get").number,
                     std::make_shared<Motion>(),
                     std::make_shared<std::string>("{}"),
                     {{R"({"action":"iterate","iterations":2})", "iterate 2"}}});
  EXPECT_EQ(text_of(table.state), "time\n");
}

TEST(Update, ASamplesAnswerIsAwaitedBeforeTheNextIsAsked) {
  Table table;
  table.state.optimizer.condition = Daemon::Condition::ready;
  table.open();
  table.feed(Tick{1});
  ASSERT_EQ(table.count("sample"), 1);
  const Request run = table.solve();
  for (int i = 1; i < 100; ++i) {
    IterationRecord record;
    record.iteration = i;
    table.feed(Iterated{run.number, {record}, {}, {}});
    table.feed(Tick{0.1});
  }
  EXPECT_EQ(table.count("sample"), 1);
  EXPECT_EQ(table.state.record.iterations.size(), 100U);  // with where it began
}

// The span that is looked at has more samples; while one answer is awaited no more is asked, however it is zoomed.
TEST(Update, SamplesAreFineWhereTheCurvesAreLookedAt) {
  Table table;
  table.state.optimizer.condition = Daemon::Condition::ready;
  table.open();
  table.feed(Tick{1});
  const auto times_of = [](const Request& request) {
    const Json json = parse(request.params.substr(request.params.find('[')), "times");
    return Node(json, "times").numbers();
  };
  const auto answer = [&](const Request& request) {
    auto samples = std::make_shared<Samples>();
    samples->times = times_of(request);
    table.feed(Sampled{request.number, samples});
  };
  const Request whole = table.take("sample");
  EXPECT_EQ(times_of(whole).size(), 201U);
  for (int k = 0; k < 50; ++k) {
    table.feed(ShowSpan{0.5 + 1e-3 * k, 0.6});
    table.feed(Tick{0.1});
  }
  EXPECT_EQ(table.count("sample"), 0);
  answer(whole);
  table.feed(Tick{1});
  const Request zoomed = table.take("sample");
  const std::vector<double> times = times_of(zoomed);
  EXPECT_EQ(times.front(), 0);
  EXPECT_EQ(times.back(), 1);
  EXPECT_TRUE(std::ranges::is_sorted(times, std::less_equal{}));
  EXPECT_GE(std::ranges::count_if(times, [](double t) { return t >= 0.549 && t <= 0.6; }), 401);  // the newest span
  for (std::size_t i = 1; i < times.size(); ++i) EXPECT_GT(times[i] - times[i - 1], 1e-5);
  answer(zoomed);
  table.feed(Tick{1});
  EXPECT_EQ(table.count("sample"), 0);  // it is known
  table.feed(ShowSpan{0, 1});
  table.feed(Tick{1});
  EXPECT_EQ(times_of(table.take("sample")).size(), 201U);
}

// The ghost is the motion before what was done last; it goes with that.
TEST(Update, TheGhostIsOfTheLastEditOrRun) {
  Table table;
  table.open();
  const auto ghost = [&] { return table.state.ghost ? table.state.ghost->dofs.at(0).coefficients[0] : NAN; };
  const auto run = [&](int iterations) {
    const Request request = table.solve();
    table.done(request, {{request.params.substr(9), "solve"}}, true);
    table.reach(iterations);
  };
  table.set();
  table.reach(1);
  EXPECT_EQ(ghost(), 0);
  run(2);
  EXPECT_EQ(ghost(), 0);  // a run that follows an edit belongs to it
  run(3);
  EXPECT_EQ(ghost(), 2);
  run(4);
  EXPECT_EQ(ghost(), 3);
  table.feed(Undo{});
  EXPECT_FALSE(table.state.ghost);
  table.acknowledge(table.take("problem/load"));
  table.acknowledge(table.take("motion/set"));
  table.set();
  table.reach(5);
  EXPECT_EQ(ghost(), 3);
  table.feed(DropGhost{});
  EXPECT_FALSE(table.state.ghost);
  const Request refused = table.solve();
  EXPECT_EQ(ghost(), 5);
  table.feed(Refused{refused.number, "no"});
  EXPECT_FALSE(table.state.ghost);  // nothing has changed
}

// A run that goes on where the last one ended continues its plot; one after an edit begins another, and going back in
// the log brings the plot of that time back.
TEST(Update, TheRecordIsOfTheLastRun) {
  Table table;
  table.open();
  const auto numbers = [&] {
    std::vector<int> all;
    for (const IterationRecord& record : table.state.record.iterations) all.push_back(record.iteration);
    return all;
  };
  const auto run = [&](std::vector<int> iterations) {
    const Request request = table.solve();
    for (const int i : iterations) {
      IterationRecord record;
      record.iteration = i;
      table.feed(Iterated{request.number, {record}, {}, {}});
    }
    table.done(request, {{request.params.substr(9), "solve"}}, true);
    table.reach(iterations.back());
  };
  run({1, 2});
  EXPECT_EQ(numbers(), (std::vector<int>{0, 1, 2}));
  run({3});
  EXPECT_EQ(numbers(), (std::vector<int>{0, 1, 2, 3}));
  table.set();
  table.reach(3);
  EXPECT_EQ(numbers(), (std::vector<int>{0, 1, 2, 3}));  // to be looked at until there is another
  run({4, 5});
  EXPECT_EQ(numbers(), (std::vector<int>{3, 4, 5}));
  EXPECT_TRUE(std::isnan(table.state.record.iterations.front().stationarity));
  table.feed(GoTo{1});
  EXPECT_EQ(numbers(), (std::vector<int>{0, 1, 2}));
  table.feed(GoTo{4});
  EXPECT_EQ(numbers(), (std::vector<int>{3, 4, 5}));
}

TEST(Update, AnEditDuringARunIsMarkedInItsRecord) {
  Table table;
  table.open();
  const Request run = table.solve();
  IterationRecord record;
  record.iteration = 7;
  table.feed(Iterated{run.number, {record}, {}, {}});
  table.set();
  EXPECT_EQ(table.state.record.edits, std::vector<int>{7});
  EXPECT_EQ(table.state.record.iterations.size(), 2U);
}

TEST(Update, PosesAreCopiedMirroredAndKeyed) {
  Table table;
  table.open();
  table.feed(SetPose{Pose{{{"left.hip", 0.1}, {"right.hip", 0.2}, {"head", 0.3}}}});
  table.feed(CopyPose{});
  table.feed(SetPose{{}});
  table.feed(PastePose{true});
  ASSERT_TRUE(table.state.pose);
  EXPECT_EQ(table.state.pose->values.at("left.hip"), 0.2);
  EXPECT_EQ(table.state.pose->values.at("right.hip"), 0.1);
  EXPECT_EQ(table.state.pose->values.at("head"), 0.3);
  Playback playback;
  playback.time = 0.5;
  table.feed(SetPlayback{playback});
  table.feed(SetPose{Pose{{{"head", 0.25}}}});
  table.feed(KeyPose{});
  EXPECT_FALSE(table.state.pose);
  ASSERT_FALSE(table.state.notices.empty());
  EXPECT_EQ(table.state.notices.back().place, Notice::Place::view);
  EXPECT_NE(table.state.notices.back().text.find("guess"), std::string::npos);
  EXPECT_EQ(table.take("scene/compile").text, "time\nkey 0.5: head = 0.25\n");
}

TEST(Update, TimeGoesRoundWhileItPlays) {
  Table table;
  table.open();
  table.feed(Play{true});
  table.feed(Tick{2.25});
  EXPECT_DOUBLE_EQ(table.state.playback.time, 0.25);
  table.feed(Play{false});
  table.feed(Tick{0.5});
  EXPECT_DOUBLE_EQ(table.state.playback.time, 0.25);
}

}  // namespace
}  // namespace spacetime::gui
