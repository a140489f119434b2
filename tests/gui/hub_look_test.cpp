// How the session is looked at: notices, samples, poses, playback.
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
  EXPECT_EQ(table.state.record.size(), 99U);
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
