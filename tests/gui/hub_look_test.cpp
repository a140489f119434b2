// How the session is looked at: notices, samples, poses, playback.
#include <cmath>

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
  table.feed(FileChanged{"/a.scene", true});
  EXPECT_EQ(table.state.notices.size(), 3U);
  table.feed(Save{});
  EXPECT_TRUE(std::get<WriteFile>(table.others.back()).overwrite);
  table.feed(FileWritten{"/a.scene", text_of(table.state)});
  EXPECT_EQ(table.state.notices.size(), 1U);  // the daemon is lost still
  table.feed(Save{});
  EXPECT_FALSE(std::get<WriteFile>(table.others.back()).overwrite);
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
