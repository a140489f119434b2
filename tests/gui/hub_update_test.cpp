// Update as a pure function, on events made by hand: no daemon, no file, no clock.
#include <gtest/gtest.h>

#include <algorithm>

#include "gui/update.h"
#include "gui/words.h"

namespace spacetime::gui {
namespace {

// A session whose daemons answer when the test says so.
struct Table {
  State state;
  std::vector<Request> requests;  // not answered yet
  std::vector<Effect> others;

  void feed(const Event& event) {
    for (Effect& effect : update(state, event)) {
      if (auto* request = std::get_if<Request>(&effect)) {
        requests.push_back(*request);
      } else {
        others.push_back(effect);
      }
    }
  }
  Request take(const std::string& method) {
    for (std::size_t i = 0; i < requests.size(); ++i) {
      if (requests[i].method != method) continue;
      Request request = requests[i];
      requests.erase(requests.begin() + static_cast<std::ptrdiff_t>(i));
      return request;
    }
    ADD_FAILURE() << "nobody asked for " << method;
    return {};
  }
  int count(const std::string& method) const {
    return static_cast<int>(std::ranges::count(requests, method, &Request::method));
  }

  // Compiles a text of one line a statement, each line that begins with a capital letter a declaration.
  void compile() {
    const Request request = take("scene/compile");
    auto scene = std::make_shared<Scene>();
    auto problem = std::make_shared<Problem>();
    scene->text = request.text;
    std::size_t begin = 0;
    for (int line = 1; begin < request.text.size(); ++line) {
      const std::size_t end = std::min(request.text.find('\n', begin), request.text.size());
      Statement statement;
      statement.text = request.text.substr(begin, end - begin);
      statement.word = statement.text.substr(0, statement.text.find(' '));
      statement.line = line;
      statement.begin = begin;
      statement.end = end;
      statement.action = statement.word != "time";
      if (statement.word == "solve") problem->actions.push_back({Solve{}, {line, 1}});
      if (statement.word == "set") problem->actions.push_back({SetConstant{"k", {1, {}, 0}}, {line, 1}});
      if (statement.word == "wrong") scene->diagnostics.push_back({{line, 1, 5}, "this is wrong", {}});
      scene->outline.push_back(std::move(statement));
      begin = end + 1;
    }
    if (scene->diagnostics.empty()) scene->problem = problem;
    feed(Compiled{request.number, scene});
  }
  void reach(int iterations) {
    const Request request = take("motion/get");
    auto motion = std::make_shared<Motion>();
    motion->iterations = iterations;
    Trajectory x;
    x.name = "x";
    x.basis.knots = {0, 0, 0, 0, 1, 1, 1, 1};
    x.coefficients = std::vector<double>(4, iterations);
    motion->dofs = {x};
    feed(Reached{
        request.number, motion, std::make_shared<std::string>("{\"at\":" + std::to_string(iterations) + "}"), {}});
  }
  void done(const Request& request, std::vector<Logged> log, bool run = false) {
    feed(Done{request.number, std::move(log), run, Status::converged, "done"});
  }
  void acknowledge(const Request& request) { feed(Acknowledged{request.number}); }

  void open() {
    feed(OpenText{"time\n"});
    compile();
    acknowledge(take("problem/load"));
    reach(0);
  }
  void set() {
    feed(Act{"set k"});
    compile();
    const Request request = take("action/do");
    done(request, {{request.params.substr(9), ""}});
  }
  Request solve() {
    feed(Act{"solve"});
    compile();
    return take("action/do");
  }
};

const std::string solved = R"({"action":"solve"})";

TEST(Update, TheSameStateAndEventGiveTheSame) {
  Table a, b;
  for (Table* table : {&a, &b}) {
    table->open();
    table->set();
    table->reach(0);
    table->feed(Act{"solve"});
  }
  EXPECT_EQ(a.requests.back().params, b.requests.back().params);
  EXPECT_EQ(a.requests.back().number, b.requests.back().number);
}

TEST(Update, AnActIsCompiledBehindTheTextAndJoinsItWhenItIsAnswered) {
  Table table;
  table.open();
  table.feed(Act{"set k"});
  ASSERT_EQ(table.requests.size(), 1U);
  EXPECT_EQ(table.requests[0].text, "time\nset k\n");
  table.compile();
  EXPECT_EQ(text_of(table.state), "time\n");
  const Request request = table.take("action/do");
  table.done(request, {{request.params.substr(9), ""}});
  EXPECT_EQ(text_of(table.state), "time\nset k\n");
  EXPECT_EQ(table.state.log.size(), 2U);
  EXPECT_FALSE(table.state.log[1].checkpoint);
  table.reach(0);
  EXPECT_TRUE(table.state.log[1].checkpoint);
  EXPECT_TRUE(can_undo(table.state));
}

TEST(Update, AMistakeIsToldWhereItBelongs) {
  Table table;
  table.open();
  table.feed(Act{"set k\nwrong", Notice::Place::equations, "goal"});
  table.compile();
  ASSERT_EQ(table.state.notices.size(), 1U);
  EXPECT_EQ(table.state.notices[0].text, "line 2: this is wrong");
  EXPECT_EQ(table.state.notices[0].place, Notice::Place::equations);
  EXPECT_EQ(table.state.notices[0].about, "goal");
  EXPECT_EQ(text_of(table.state), "time\n");
  EXPECT_TRUE(table.requests.empty());
  table.feed(Act{"set k"});  // it goes with the next act
  EXPECT_TRUE(table.state.notices.empty());
}

TEST(Update, ARefusedActLeavesNothing) {
  Table table;
  table.open();
  table.feed(Act{"set k"});
  table.compile();
  table.feed(Refused{table.take("action/do").number, "not so"});
  EXPECT_EQ(table.state.log.size(), 1U);
  EXPECT_EQ(table.state.notices.back().text, "not so");
  EXPECT_TRUE(table.requests.empty());
}

TEST(Update, TwoSetsInOneLineOfWhichOneIsRefusedAreBothUndone) {
  Table table;
  table.open();
  table.feed(Act{"set k\nset k"});
  table.compile();
  const Request first = table.take("action/do"), second = table.take("action/do");
  table.done(first, {{first.params.substr(9), ""}});
  table.feed(Refused{second.number, "not so"});
  EXPECT_EQ(table.state.log.size(), 1U);
  EXPECT_EQ(table.count("problem/load"), 1);  // back to where the session is
  EXPECT_EQ(table.count("motion/set"), 1);
}

TEST(Update, AnswersToWhatNobodyWaitsForAreDropped) {
  Table table;
  table.open();
  table.feed(Act{"set k"});
  const Request compile = table.requests[0];
  table.feed(OpenText{"time\ntime\n"});  // another session
  auto scene = std::make_shared<Scene>();
  scene->text = "stale";
  table.feed(Compiled{compile.number, scene});
  table.feed(Done{compile.number, {}, false, Status::stopped, ""});
  table.feed(Refused{compile.number, "stale"});
  EXPECT_EQ(table.state.present, -1);
  EXPECT_TRUE(table.state.notices.empty());
  table.take("scene/compile");
  table.compile();
  EXPECT_EQ(text_of(table.state), "time\ntime\n");
}

TEST(Update, UndoShowsAtOnceAndLeadsTheOptimizerThere) {
  Table table;
  table.open();
  table.set();
  table.reach(3);
  EXPECT_EQ(table.state.curves->dofs[0].coefficients[0], 3);
  table.feed(Undo{});
  EXPECT_EQ(table.state.present, 0);
  EXPECT_EQ(table.state.curves->dofs[0].coefficients[0], 0);
  EXPECT_EQ(text_of(table.state), "time\n");
  const Request load = table.take("problem/load"), set = table.take("motion/set");
  EXPECT_EQ(set.params, "\"motion\":{\"at\":0}");
  // Undone and done again before the optimizer is there: it is led to the last place alone, and stale answers count
  // for nothing.
  table.feed(Redo{});
  table.feed(Undo{});
  table.feed(Redo{});
  table.acknowledge(load);
  table.acknowledge(set);
  EXPECT_NE(table.state.work.at, table.state.log[1].number);
  EXPECT_EQ(table.state.present, 1);
  while (table.count("motion/set") > 0) {
    table.acknowledge(table.take("problem/load"));
    while (table.count("action/do") > 0) table.done(table.take("action/do"), {});
    table.acknowledge(table.take("motion/set"));
  }
  EXPECT_EQ(table.state.work.at, table.state.log[1].number);
}

TEST(Update, AnActAfterUndoCutsWhatCouldBeRedone) {
  Table table;
  table.open();
  table.set();
  table.reach(0);
  table.set();
  table.reach(0);
  table.feed(Undo{});
  table.feed(Undo{});
  EXPECT_TRUE(can_redo(table.state));
  table.feed(Act{"set k"});
  EXPECT_TRUE(can_redo(table.state));  // not before it is known to be right
  while (table.count("motion/set") > 0) {
    table.acknowledge(table.take("problem/load"));
    table.acknowledge(table.take("motion/set"));
  }
  table.compile();
  EXPECT_FALSE(can_redo(table.state));
  EXPECT_EQ(table.state.log.size(), 1U);
}

TEST(Update, AnEditDuringARunComesBehindItsIterations) {
  Table table;
  table.open();
  const Request run = table.solve();
  EXPECT_TRUE(table.state.running);
  table.feed(Act{"set k"});
  table.compile();
  const Request edit = table.take("action/do");
  table.done(edit, {{R"({"action":"iterate","iterations":4})", "iterate 4"}, {edit.params.substr(9), ""}});
  EXPECT_EQ(text_of(table.state), "time\niterate 4\nset k\n");
  ASSERT_EQ(table.state.log.size(), 2U);
  EXPECT_EQ(table.state.log[1].text, "iterate 4\nset k");
  EXPECT_EQ(table.state.scene->outline.size(), 3U);
  EXPECT_EQ(table.state.scene->outline[2].line, 3);
  table.done(run, {{R"({"action":"solve","iterations":996})", "solve iterations 996"}}, true);
  EXPECT_EQ(text_of(table.state), "time\niterate 4\nset k\nsolve iterations 996\n");
  EXPECT_FALSE(table.state.running);
}

TEST(Update, UndoDuringARunKeepsItsOutcomeToBeRedone) {
  Table table;
  table.open();
  const Request run = table.solve();
  table.feed(Undo{});
  EXPECT_TRUE(std::holds_alternative<Cancel>(table.others.end()[-2]) ||
              std::holds_alternative<Cancel>(table.others.back()));
  IterationRecord record;
  record.iteration = 9;
  table.feed(Iterated{run.number, {record}, {}, {}});
  EXPECT_TRUE(table.state.record.empty());  // it is not looked at any more
  table.done(run, {{R"({"action":"iterate","iterations":9})", "iterate 9"}}, true);
  EXPECT_EQ(table.state.present, 0);
  EXPECT_EQ(text_of(table.state), "time\n");
  table.reach(9);
  EXPECT_TRUE(can_redo(table.state));
  EXPECT_EQ(table.state.log[1].text, "iterate 9");
  EXPECT_EQ(table.state.curves->dofs[0].coefficients[0], 0);
}

TEST(Update, ADragSendsTheNewestValueAlone) {
  Table table;
  table.open();
  for (int i = 0; i < 500; ++i) {
    const Words words = set_words("k", i);
    table.feed(Steer{{words.line, {words.action}}});
  }
  EXPECT_LE(table.requests.size(), 4U);  // the first value's round, and samples
  const Request edit = table.take("action/do"), run = table.take("action/do");
  table.done(edit, {});
  table.done(run, {}, true);
  table.reach(1);
  EXPECT_EQ(table.take("action/do").params, "\"action\":" + set_words("k", 499).action);
  const Request second = table.take("action/do");
  EXPECT_EQ(table.count("action/do"), 0);

  // Let go: from the checkpoint before it, once.
  table.feed(Steered{true});
  EXPECT_EQ(table.count("problem/load"), 1);
  EXPECT_EQ(table.take("motion/set").params, "\"motion\":{\"at\":0}");
  table.done(second, {}, true);  // too late
  EXPECT_EQ(table.state.log.size(), 1U);
  EXPECT_FALSE(table.state.steering);
}

TEST(Update, UndoDuringTheSolveAfterADragLeavesThatToBeRedone) {
  Table table;
  table.open();
  const Words words = set_words("k", 1);
  table.feed(Steer{{words.line, {words.action}}});
  table.feed(Steered{true});
  table.requests.erase(table.requests.begin(), table.requests.begin() + 3);  // the drag's, which nobody waits for
  table.acknowledge(table.take("problem/load"));
  table.acknowledge(table.take("motion/set"));
  table.compile();
  table.done(table.take("action/do"), {{words.action, ""}});
  table.reach(0);
  table.compile();
  const Request run = table.take("action/do");
  const std::string text = text_of(table.state);
  table.feed(Undo{});
  EXPECT_EQ(table.state.present, 1);
  table.done(run, {{R"({"action":"iterate","iterations":3})", "iterate 3"}}, true);
  table.reach(3);
  ASSERT_EQ(table.state.log.size(), 3U);
  EXPECT_EQ(table.state.present, 1);
  EXPECT_EQ(table.state.log[1].scene->text, text);
  EXPECT_EQ(text_of(table.state), text);
  EXPECT_EQ(table.state.curves->dofs[0].coefficients[0], 0);
  EXPECT_TRUE(can_redo(table.state));
}

TEST(Update, UndoDropsWhatWaitsAndOnlyThat) {
  Table table;
  table.open();
  table.set();
  table.reach(0);
  table.feed(Act{"set k"});
  table.feed(Act{"set k"});
  table.feed(Undo{});
  EXPECT_EQ(table.state.present, 1);
  EXPECT_EQ(table.state.waiting, 0);
  table.requests.clear();  // to compile it
  // One that may have been performed: the optimizer is led back.
  table.feed(Act{"set k"});
  table.compile();
  table.take("action/do");
  table.feed(Undo{});
  EXPECT_EQ(table.state.present, 1);
  EXPECT_EQ(table.count("motion/set"), 1);
  table.acknowledge(table.take("problem/load"));
  table.acknowledge(table.take("motion/set"));
  EXPECT_EQ(table.state.work.at, table.state.log[1].number);
  table.feed(Undo{});
  EXPECT_EQ(table.state.present, 0);
}

TEST(Update, NothingOfAnActThatWasLeftIsInTheNext) {
  Table table;
  table.open();
  table.set();
  table.reach(0);
  table.feed(Act{"set k\nset k"});
  table.compile();
  const Request first = table.take("action/do");
  table.done(first, {{R"({"action":"iterate","iterations":4})", "iterate 4"}, {first.params.substr(9), ""}});
  table.take("action/do");
  table.feed(GoTo{0});
  table.acknowledge(table.take("problem/load"));
  table.acknowledge(table.take("motion/set"));
  table.set();
  ASSERT_EQ(table.state.log.size(), 2U);
  EXPECT_EQ(text_of(table.state), "time\nset k\n");
  EXPECT_EQ(table.state.log[1].actions.size(), 1U);
}

TEST(Update, AnActIsComparedWithTheTextItWasCompiledBehind) {
  Table table;
  table.open();
  table.solve();
  table.set();
  table.feed(Act{"set k"});
  // Meanwhile it is known how far the run had come.
  table.feed(Reached{table.take("motion/get").number,
                     std::make_shared<Motion>(),
                     std::make_shared<std::string>("{}"),
                     {{R"({"action":"iterate","iterations":2})", "iterate 2"}}});
  EXPECT_EQ(text_of(table.state), "time\nset k\niterate 2\n");
  table.compile();
  const Request second = table.take("action/do");
  table.done(second, {{second.params.substr(9), ""}});
  EXPECT_EQ(text_of(table.state), "time\nset k\niterate 2\nset k\n");
  ASSERT_EQ(table.state.log.size(), 3U);
  EXPECT_EQ(table.state.log[2].actions.size(), 1U);
  EXPECT_EQ(table.state.scene->outline.size(), 4U);
}

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

TEST(Update, NothingGrowsWhereNobodyAnswers) {
  Table table;
  table.open();
  for (int i = 0; i < 2000; ++i) {
    table.feed(Act{"set k"});
    table.feed(Ask{"1 + 1"});
    table.feed(Tick{0.01});
  }
  EXPECT_LE(table.requests.size(), 20U);
  EXPECT_LE(table.state.work.tasks.size(), 64U);
  EXPECT_LE(table.state.console.size(), 200U);
  EXPECT_LE(table.state.notices.size(), 20U);
  EXPECT_LE(table.state.work.wanted.size(), 20U);
}

TEST(Update, ALostOptimizerLeavesTheLogToLookAtAndToSave) {
  Table table;
  table.open();
  table.set();
  table.reach(5);
  table.feed(DaemonIs{false, Daemon::Condition::lost, "gone"});
  ASSERT_EQ(table.state.notices.size(), 1U);
  EXPECT_EQ(table.state.notices[0].severity, Severity::error);
  table.feed(Undo{});
  EXPECT_EQ(table.state.present, 0);
  table.feed(Refused{table.take("problem/load").number, "the daemon is lost"});
  for (int i = 0; i < 10; ++i) table.feed(Tick{1});
  EXPECT_EQ(table.count("problem/load"), 0);  // it is not tried for ever
  table.feed(Redo{});
  EXPECT_EQ(table.state.curves->dofs[0].coefficients[0], 5);
  table.feed(Save{"a.scene"});
  ASSERT_TRUE(std::holds_alternative<WriteFile>(table.others.back()));
  EXPECT_EQ(std::get<WriteFile>(table.others.back()).text, "time\nset k\n");
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
