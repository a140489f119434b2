// Sessions with the real daemons: whatever was done, the text that is left leads a batch run to the same bits.
#include <gtest/gtest.h>

#include "common/files.h"
#include "gui/words.h"
#include "tests/gui/driven.h"
#include "tests/process/process.h"

namespace spacetime::test {
namespace {

using namespace gui;

std::string throw_text() { return text_of("examples/throw.scene"); }

void open(Hub& hub, const std::string& text) { post_and_wait(hub, OpenText{text}); }

void expect_same_as_batch(const Hub& hub) {
  const State& state = hub.state();
  ASSERT_TRUE(state.motion);
  EXPECT_TRUE(curves_text(*state.motion) == batch_curves(text_to_save(state))) << text_to_save(state);
}

TEST(HubSession, OpensSolvesUndoesRedoesSavesAndOpensAgain) {
  const std::string file = scratch("throw.scene"), text = throw_text();
  write_text(file, text);
  Hub hub(daemons());
  hub.post(Open{file});
  until(
      hub, [](const State& state) { return state.present == 0; }, "the scene");
  until_quiet(hub);
  const State& state = hub.state();
  EXPECT_EQ(state.script, std::vector<std::string>{"solve\n"});
  EXPECT_EQ(text_to_save(state), text);
  EXPECT_FALSE(unsaved(state));
  ASSERT_TRUE(state.curves);
  const Curves start = *state.curves;

  post_and_wait(hub, RunScript{});
  ASSERT_EQ(state.log.size(), 2U) << told(state);
  EXPECT_EQ(state.motion->status, Status::converged);
  EXPECT_GT(state.record.iterations.size(), 2U);
  EXPECT_EQ(text_to_save(state), text);
  EXPECT_FALSE(unsaved(state));
  const auto solved = curves_text(*state.motion);
  expect_same_as_batch(hub);

  act(hub, key_words(0.5, {{"arm.shoulder", -1.25}}).line);
  act(hub, set_words("BasketX", 2.2).line);
  act(hub, "solve");
  ASSERT_EQ(state.log.size(), 5U) << told(state);
  EXPECT_TRUE(unsaved(state));
  EXPECT_TRUE(curves_text(*state.motion) != solved);
  expect_same_as_batch(hub);
  const auto last = curves_text(*state.motion);

  for (int i = 0; i < 4; ++i) hub.post(Undo{});
  hub.step(0);
  EXPECT_EQ(state.present, 0);
  EXPECT_TRUE(*state.curves == start);  // at once
  until_quiet(hub);
  EXPECT_TRUE(*state.curves == start);
  EXPECT_FALSE(can_undo(state));
  for (int i = 0; i < 4; ++i) post_and_wait(hub, Redo{});
  EXPECT_EQ(state.present, 4);
  EXPECT_TRUE(curves_text(*state.motion) == last);
  EXPECT_FALSE(can_redo(state));
  act(hub, "solve");  // the optimizer stands where the session does
  expect_same_as_batch(hub);

  const std::string copy = scratch("copy.scene");
  hub.post(Save{copy});
  until(
      hub, [&](const State& now) { return now.file == copy; }, "the file");
  EXPECT_FALSE(unsaved(state));
  EXPECT_EQ(read_text(copy), text_of(state));
  const auto expected = curves_text(*state.motion);
  hub.post(Open{copy});
  until(
      hub, [](const State& now) { return now.log.size() == 1; }, "the copy");
  until_quiet(hub);
  EXPECT_EQ(state.script.size(), 5U);
  post_and_wait(hub, RunScript{});
  EXPECT_TRUE(state.script.empty());
  EXPECT_EQ(state.log.size(), 6U) << told(state);
  EXPECT_TRUE(curves_text(*state.motion) == expected);
  EXPECT_FALSE(unsaved(state));
}

TEST(HubSession, ActsDuringARunTakeEffectAndReplay) {
  Hub hub(daemons());
  open(hub, throw_text());
  hub.post(RunScript{});
  const State& state = hub.state();
  until(
      hub, [](const State& now) { return now.record.iterations.size() >= 1; }, "progress");
  hub.post(Act{"set BasketX = 2.25"});
  until_quiet(hub);
  ASSERT_GE(state.log.size(), 3U) << told(state);
  expect_same_as_batch(hub);
}

TEST(HubSession, AStoppedRunIsKeptAsItsIterations) {
  Hub hub(daemons());
  std::string fine = throw_text();
  fine.replace(fine.find("spans 24"), 8, "spans 256");
  open(hub, fine);
  hub.post(RunScript{});
  until(
      hub, [](const State& now) { return now.record.iterations.size() >= 2; }, "progress");
  post_and_wait(hub, Stop{});
  const State& state = hub.state();
  ASSERT_EQ(state.log.size(), 2U) << told(state);
  EXPECT_EQ(state.log[1].text.substr(0, 8), "iterate ");
  expect_same_as_batch(hub);
}

TEST(HubSession, UndoLeavesARunWhichCanBeComeBackTo) {
  Hub hub(daemons());
  std::string fine = throw_text();
  fine.replace(fine.find("spans 24"), 8, "spans 256");
  open(hub, fine);
  const Curves start = *hub.state().curves;
  hub.post(RunScript{});
  until(
      hub, [](const State& now) { return now.record.iterations.size() >= 2; }, "progress");
  hub.post(Undo{});
  hub.step(0);
  EXPECT_TRUE(*hub.state().curves == start);
  until_quiet(hub);
  EXPECT_EQ(hub.state().present, 0);
  EXPECT_TRUE(*hub.state().curves == start);
  until(
      hub, [](const State& now) { return can_redo(now); }, "the run's end");
  post_and_wait(hub, Redo{});
  expect_same_as_batch(hub);
}

TEST(HubSession, ADragLeavesOneEntryThatReplays) {
  Hub hub(daemons());
  open(hub, throw_text());
  post_and_wait(hub, RunScript{});
  const State& state = hub.state();
  const auto before = state.curves;
  for (int i = 1; i <= 20; ++i) {
    const double x = 2.5 - 0.02 * i;
    const Words words = set_words("BasketX", x);
    hub.post(Steer{{words.line, {words.action}}});
    hub.step(0.01);
    until(
        hub, [&](const State& now) { return i % 5 != 0 || now.work.drag->unanswered == 0; }, "the motion to follow");
  }
  EXPECT_TRUE(*state.curves != *before);
  EXPECT_TRUE(state.ghost);
  hub.post(Steered{true});
  until_quiet(hub);
  ASSERT_EQ(state.log.size(), 3U) << told(state);
  EXPECT_EQ(state.log[2].text, "set BasketX = 2.1\nsolve");
  expect_same_as_batch(hub);

  // And back, without a trace.
  const auto curves = *state.curves;
  const Words words = set_words("BasketX", 2.4);
  hub.post(Steer{{words.line, {words.action}}});
  hub.step(0.01);
  until(
      hub, [&](const State& now) { return now.work.drag->unanswered == 0; }, "the motion to follow");
  hub.post(Steered{false});
  until_quiet(hub);
  EXPECT_EQ(state.log.size(), 3U);
  EXPECT_TRUE(*state.curves == curves);
  act(hub, "iterate 1");
  expect_same_as_batch(hub);
}

TEST(HubSession, DeclarationsAmongActionsReplay) {
  Hub hub(daemons());
  open(hub, throw_text());
  post_and_wait(hub, RunScript{});
  act(hub, "set land = 1.65");
  act(hub, "disable calm");
  act(hub, "refine [0.8, 1.2]");
  act(hub, "constrain low: at(arm.elbow, 0.5) = 0.1");
  act(hub, "set BasketY = BasketX/4");
  act(hub, "solve");
  const State& state = hub.state();
  EXPECT_EQ(state.log.size(), 8U) << told(state);
  expect_same_as_batch(hub);
  // Undone and done again it is the same.
  const auto last = curves_text(*state.motion);
  post_and_wait(hub, GoTo{3});
  post_and_wait(hub, GoTo{6});
  act(hub, "solve");
  EXPECT_TRUE(curves_text(*state.motion) == last);
}

TEST(HubSession, AScriptOfSeveralActionsIsPerformedStatementByStatement) {
  const std::string text = throw_text() +
                           "set BasketX = 2.4; iterate 3  # a comment\nlet height = ball.Y  # shown\n\n"
                           "shake amplitude 0.01 seed 3\nsolve iterations 40\n";
  Hub hub(daemons());
  open(hub, text);
  const State& state = hub.state();
  EXPECT_EQ(state.script.size(), 6U);
  EXPECT_EQ(text_to_save(state), text);
  post_and_wait(hub, RunScript{});
  EXPECT_EQ(state.log.size(), 7U) << told(state);
  EXPECT_EQ(text_to_save(state), text);
  expect_same_as_batch(hub);
}

TEST(HubSession, MistakesInAnActAreToldAndChangeNothing) {
  Hub hub(daemons());
  open(hub, throw_text());
  const State& state = hub.state();
  const std::string text = text_to_save(state);
  hub.post(Act{"set BasketZ = 1", Notice::Place::constants, "BasketZ"});
  until_quiet(hub);
  ASSERT_EQ(state.notices.size(), 1U);
  EXPECT_EQ(state.notices[0].place, Notice::Place::constants);
  EXPECT_NE(state.notices[0].text.find("BasketX"), std::string::npos) << state.notices[0].text;
  act(hub, "window [3, 4]");  // refused by the optimizer
  ASSERT_EQ(state.notices.size(), 1U);
  EXPECT_EQ(text_to_save(state), text);
  EXPECT_EQ(state.log.size(), 1U);
  post_and_wait(hub, RunScript{});
  expect_same_as_batch(hub);
}

TEST(HubSession, ASceneWithMistakesIsShownWithThem) {
  Hub hub(daemons());
  open(hub, throw_text() + "constrain x = 1\n");
  const State& state = hub.state();
  ASSERT_EQ(state.log.size(), 1U);
  EXPECT_FALSE(state.scene->problem);
  EXPECT_EQ(state.scene->diagnostics.size(), 1U);
  EXPECT_GT(state.scene->outline.size(), 10U);
  act(hub, "solve");
  EXPECT_EQ(state.notices.size(), 1U);
}

TEST(HubSession, ASceneIsWrittenFromNothing) {
  Hub hub(daemons());
  open(hub, "time [0, 1]\n");
  const State& state = hub.state();
  for (const std::string line :
       {"trajectory bspline spans 4", "dof x", "solve", "constrain start: (x, x') = 0 at 0",
        "constrain goal: (x, x') = (1, 0) at 1", "minimize effort: integral(x''^2)", "solve"}) {
    act(hub, line);
  }
  ASSERT_EQ(state.log.size(), 8U) << told(state);
  EXPECT_EQ(state.motion->status, Status::converged);
  EXPECT_NEAR(state.motion->objective, 12, 1e-9);
  for (int i = 0; i < 7; ++i) post_and_wait(hub, Undo{});
  EXPECT_EQ(state.present, 0);
  EXPECT_FALSE(state.curves);
  for (int i = 0; i < 7; ++i) post_and_wait(hub, Redo{});
  EXPECT_NEAR(state.motion->objective, 12, 1e-9);
  act(hub, "iterate 1");
  EXPECT_EQ(state.log.size(), 9U) << told(state);
}

TEST(HubSession, TheConsoleAnswers) {
  Hub hub(daemons());
  open(hub, throw_text());
  hub.post(Ask{"g*2", ""});
  hub.post(Ask{"arm.elbo", ""});
  hub.step(0);
  until(
      hub, [](const State& now) { return !now.console[0].waiting && !now.console[1].waiting; }, "answers");
  EXPECT_NE(hub.state().console[0].answer.find("19.62"), std::string::npos) << hub.state().console[0].answer;
  EXPECT_TRUE(hub.state().console[1].wrong);
}

TEST(HubSession, SamplesFollowTheMotion) {
  Hub hub(daemons());
  open(hub, throw_text());
  until(
      hub, [](const State& now) { return now.samples != nullptr; }, "samples");
  const auto before = hub.state().samples;
  EXPECT_EQ(before->times.size(), 201U);
  EXPECT_TRUE(before->poses.contains("arm.upper"));
  post_and_wait(hub, RunScript{});
  until(
      hub, [&](const State& now) { return now.samples != before && now.work.sample == 0; }, "newer samples");
}

}  // namespace
}  // namespace spacetime::test
