"""Runs: cancelled, edited while they go on, and replayed from their logs."""
import random
import statistics
import tempfile
import time
import unittest

from tests.wire import peer
from tests.wire.session import Session, without_seconds, without_words


class Runs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.problem = peer.problem_of("tests/wire/long_throw.scene")

    def replayed(self, log):
        with peer.Daemon("optimizer") as daemon:
            session = Session(daemon)
            session.load(self.problem)
            for action in log:
                session.do(**action)
            return session.motion()

    def test_a_cancelled_run_answers_with_its_outcome_and_loses_nothing(self):
        latencies = []
        for transport in peer.TRANSPORTS:
            with peer.Daemon("optimizer", transport) as daemon:
                session = Session(daemon)
                session.load(self.problem)
                number = session.peer.start("action/do", action=peer.ENDLESS)
                seen = session.wait_for_progress(2)["iteration"]
                begun = time.monotonic()
                session.peer.notify("$/cancelRequest", id=number)
                outcome = session.peer.answer(number)["result"]
                latencies.append(time.monotonic() - begun)
                self.assertEqual(outcome["status"], "stopped")
                self.assertIn("Interrupted", outcome["message"])
                self.assertGreaterEqual(outcome["iteration"], seen)
                motion = session.motion()
                self.assertEqual(motion["iterations"], outcome["iteration"])
                self.assertEqual(without_words(self.replayed(session.log)), without_words(motion))
        print(f"cancelled: answered after {max(latencies) * 1e3:.1f} ms at most", flush=True)

    def test_a_run_with_a_pace_keeps_it_and_hears_what_is_asked_meanwhile(self):
        with peer.Daemon("optimizer") as daemon:
            session = Session(daemon)
            session.load(self.problem)
            number = session.peer.start("action/do", action={"action": "iterate", "iterations": 5}, pace=1000)
            outcome = session.peer.answer(number)["result"]
            self.assertGreaterEqual(outcome["seconds"], 0.004)
            session.do(action="reset")
            # Between two iterations that are ten seconds apart it answers, and ends, at once.
            slow = session.peer.start("action/do", action={"action": "solve"}, pace=0.1)
            self.assertEqual(session.wait_for_progress()["iteration"], 6)
            for _ in range(3):
                self.assertEqual(session.motion()["iterations"], 6)
            session.peer.notify("$/cancelRequest", id=slow)
            outcome = session.peer.answer(slow)["result"]
            self.assertEqual((outcome["status"], outcome["iterations"]), ("stopped", 1))
            self.assertLess(outcome["seconds"], 9)
            for wrong in (0, -1, 1e9, "fast"):
                error = session.peer.answer(
                    session.peer.start("action/do", action={"action": "iterate", "iterations": 1}, pace=wrong))["error"]
                self.assertIn("/pace", error["message"])

    def test_requests_that_wait_are_cancelled_and_answered(self):
        with peer.Daemon("optimizer") as daemon:
            session = Session(daemon)
            session.load(self.problem)
            first = session.peer.start("action/do", action=peer.ENDLESS)
            second = session.peer.start("action/do", action={"action": "solve"})
            session.wait_for_progress()
            session.peer.notify("$/cancelRequest", id=second)
            self.assertEqual(session.peer.answer(second)["error"]["code"], -32800)
            session.peer.notify("$/cancelRequest", id=first)
            session.peer.notify("$/cancelRequest", id=first)
            session.peer.notify("$/cancelRequest", id="never asked")
            self.assertEqual(session.peer.answer(first)["result"]["status"], "stopped")

    def test_edits_during_a_run_take_effect_at_once_and_replay(self):
        seed = 1994
        print("seed", seed)
        chance = random.Random(seed)
        edits = [lambda: {"action": "set", "constant": "BasketX", "value": chance.uniform(2, 3)},
                 lambda: {"action": "set", "constant": "release", "value": chance.uniform(0.9, 1.1)},
                 lambda: {"action": "disable", "name": "calm"},
                 lambda: {"action": "enable", "name": "calm"},
                 lambda: {"action": "weight", "name": "calm", "weight": chance.uniform(1e-3, 1e-2)},
                 lambda: {"action": "bound", "dof": "arm.elbow", "lower": -3, "upper": chance.uniform(1, 3)},
                 lambda: {"action": "reset"}]
        latencies, during = [], 0
        with peer.Daemon("optimizer", "unix") as daemon:
            for round_ in range(40):  # these runs end by themselves, some of them before an edit where we are kept waiting
                if round_ >= 6 and during >= 12:
                    break
                session = Session(daemon)
                session.load(self.problem)
                run = session.peer.start("action/do", action=chance.choice(
                    [{"action": "solve"}, {"action": "solve", "tolerance": 1e-6, "iterations": 90},
                     {"action": "iterate", "iterations": 60}]))
                for _ in range(4):
                    shown = session.wait_for_progress(chance.randrange(1, 3))
                    if not shown:
                        break
                    begun = time.monotonic()
                    edit = session.do(**chance.choice(edits)())
                    latencies.append(time.monotonic() - begun)
                    self.assertGreaterEqual(edit["iteration"], shown["iteration"])
                    during += edit["log"][0]["action"] in ("iterate", "solve")
                if round_ % 2:
                    session.peer.notify("$/cancelRequest", id=run)
                outcome = session.peer.answer(run)["result"]
                motion = session.motion()
                self.assertEqual(motion["iterations"], outcome["iteration"])
                replayed = self.replayed(session.log)
                if round_ % 2 == 0:
                    self.assertEqual(replayed["status"], motion["status"])
                self.assertEqual(without_words(replayed), without_words(motion), session.log)
                session.peer.close()
        self.assertGreaterEqual(during, 12)
        print(f"edits: answered after {statistics.median(latencies) * 1e3:.1f} ms, at most {max(latencies) * 1e3:.1f} ms; "
              f"{during} of {len(latencies)} split a run")

    def test_the_motion_can_be_asked_for_and_set_during_a_run(self):
        with peer.Daemon("optimizer") as daemon:
            session = Session(daemon)
            session.load(self.problem)
            start = session.motion()
            run = session.peer.start("action/do", action=peer.ENDLESS)
            session.wait_for_progress(2)
            now = session.motion()
            self.assertEqual(now["status"], "stopped")
            self.assertIn("Going on", now["message"])
            self.assertGreater(now["iterations"], 0)
            values = session.peer.ask("sample", times=[0, 1, 2], expressions=[])
            self.assertEqual(values, {"times": [0, 1, 2], "values": {}, "poses": {}})
            back = session.peer.ask("motion/set", motion=start)
            self.assertGreaterEqual(back["iteration"], now["iterations"])
            session.peer.notify("$/cancelRequest", id=run)
            self.assertEqual(session.peer.answer(run)["result"]["status"], "stopped")

    def test_a_new_problem_ends_the_run_of_the_old_one(self):
        with peer.Daemon("optimizer") as daemon:
            session = Session(daemon)
            session.load(self.problem)
            run = session.peer.start("action/do", action=peer.ENDLESS)
            session.wait_for_progress()
            load = session.peer.start("problem/load", problem=self.problem)
            self.assertEqual(session.peer.answer(run)["result"]["status"], "stopped")
            self.assertIn("unknowns", session.peer.answer(load)["result"])
            self.assertEqual(session.motion()["iterations"], 0)

    def test_a_problem_that_is_refused_leaves_the_one_before_it(self):
        with peer.Daemon("optimizer") as daemon:
            session = Session(daemon)
            session.load(self.problem)
            session.do(action="iterate", iterations=2)
            before = without_seconds(session.motion())
            # What makes no sense stands behind an action, and shows with the value of a constant.
            text = ("time [0, 1]\nconstant late = 0.5\ntrajectory bspline spans 4\ndof x\nminimize integral(x''^2)\n"
                    "solve\nconstrain x = 0 at late\n")
            with tempfile.NamedTemporaryFile("w", suffix=".scene") as scene:
                scene.write(text)
                scene.flush()
                refused = peer.problem_of(scene.name)
            refused["constants"][0]["value"] = 2
            with self.assertRaisesRegex(RuntimeError, "time"):
                session.load(refused)
            self.assertEqual(without_seconds(session.motion()), before)

    def test_a_run_holds_up_no_other_session(self):
        with peer.Daemon("optimizer", "unix") as daemon:
            busy, other = Session(daemon), Session(daemon)
            others = peer.problem_of("examples/double_integrator.scene")
            busy.load(self.problem)
            run = busy.peer.start("action/do", action=peer.ENDLESS)
            busy.wait_for_progress()
            other.load(others)
            self.assertEqual(other.do(action="solve")["status"], "converged")
            busy.peer.notify("$/cancelRequest", id=run)
            self.assertEqual(busy.peer.answer(run)["result"]["status"], "stopped")

    def test_an_edit_and_a_question_at_once_reach_every_method(self):
        for method in ("newton", "sqp92", "bfgs"):
            with peer.Daemon("optimizer", "unix") as daemon:
                for _ in range(10):  # Newton's ends by itself, which may be before we have our turn
                    session = Session(daemon)
                    session.load(self.problem)
                    run = session.peer.start("action/do", action=dict(peer.ENDLESS, method=method))
                    session.wait_for_progress(3)
                    edit, question = session.peer.start_together(
                        ("action/do", {"action": {"action": "set", "constant": "BasketX", "value": 2.8}}), ("motion/get", {}))
                    session.peer.answer(edit)
                    found = session.peer.answer(question)["result"]["motion"]["message"]
                    session.wait_for_progress()
                    session.peer.notify("$/cancelRequest", id=run)
                    session.peer.answer(run)
                    if method != "newton" or "Going on" in found:
                        break
                self.assertIn("Going on", found)
                self.assertEqual(len(session.log), 3, "the edit has come after the run")
                self.assertEqual(without_words(self.replayed(session.log)), without_words(session.motion()), method)

    def test_edits_and_questions_pass_a_run_that_waits(self):
        with peer.Daemon("optimizer") as daemon:
            session = Session(daemon)
            session.load(self.problem)
            run = session.peer.start("action/do", action=peer.ENDLESS)
            session.wait_for_progress(2)
            waits = session.peer.start("action/do", action={"action": "iterate", "iterations": 2})
            edits = [session.peer.start("action/do", action={"action": "set", "constant": "BasketX", "value": value})
                     for value in (2.8, 2.9)]
            update = session.peer.start("problem/update", problem=self.problem)  # long: parsed in its turn
            question = session.peer.start("sample", times=[0], expressions=[])
            answers = []
            while len(answers) < 4:
                answers.append(session.peer.receive_answer())
            self.assertEqual([answer["id"] for answer in answers], edits + [update, question])
            self.assertEqual(answers[0]["result"]["log"][0]["action"], "solve")  # of the run that goes on
            session.peer.notify("$/cancelRequest", id=run)
            self.assertEqual(session.peer.receive_answer()["result"]["status"], "stopped")
            last = session.peer.receive_answer()
            self.assertEqual((last["id"], last["result"]["log"]), (waits, [{"action": "iterate", "iterations": 2}]))
            motion = session.motion()
            self.assertEqual(motion["constants"]["BasketX"], 2.9)
            self.assertEqual(without_words(self.replayed(session.log)), without_words(motion))

    def test_a_new_problem_ends_runs_that_wait_before_it_and_edits_after_it_are_of_it(self):
        with peer.Daemon("optimizer") as daemon:
            session = Session(daemon)
            session.load(self.problem)
            runs = [session.peer.start("action/do", action=peer.ENDLESS) for _ in range(2)]
            session.wait_for_progress(2)
            load = session.peer.start("problem/load", problem=self.problem)
            edit = session.peer.start("action/do", action={"action": "set", "constant": "BasketX", "value": 2.9})
            answers = [session.peer.receive_answer() for _ in range(4)]
            self.assertEqual([answer["id"] for answer in answers], runs + [load, edit])
            self.assertEqual([answer["result"]["status"] for answer in answers[:2]], ["stopped"] * 2)
            self.assertEqual(answers[1]["result"]["log"], [])
            self.assertEqual(session.motion()["constants"]["BasketX"], 2.9)

    def test_an_update_lends_its_revision_to_the_run(self):
        with peer.Daemon("optimizer") as daemon:
            session = Session(daemon)
            session.peer.ask("problem/load", problem=self.problem, revision=10)
            run = session.peer.start("action/do", action=peer.ENDLESS, revision=10)
            self.assertEqual(session.peer.receive()["params"]["revision"], 10)
            update = session.peer.start("problem/update", problem=self.problem, revision=12)
            self.assertEqual(session.peer.answer(update)["result"]["revision"], 12)
            self.assertEqual(session.peer.receive()["params"]["revision"], 12)
            session.peer.notify("$/cancelRequest", id=run)
            self.assertEqual(session.peer.answer(run)["result"]["revision"], 12)

    def test_a_motion_set_during_a_run_logs_what_had_been_done(self):
        with peer.Daemon("optimizer") as daemon, peer.Daemon("optimizer") as another:
            session, later = Session(daemon), Session(another)
            session.load(self.problem)
            later.load(self.problem)
            start = session.motion()
            session.do(action="iterate", iterations=30)
            later_motion = session.motion()
            for motion in (start, later_motion):
                for _ in range(10):  # the run may have ended before we have our turn
                    begun = session.motion()["iterations"]
                    run = session.peer.start("action/do", action=dict(peer.ENDLESS, iterations=80))
                    session.wait_for_progress(2)
                    back = session.peer.ask("motion/set", motion=motion)
                    done = sum(action["iterations"] for action in back["log"])
                    shown = session.wait_for_progress()
                    outcome = session.peer.answer(run)["result"]
                    if shown:
                        break
                self.assertGreater(done, 0)
                self.assertEqual(back["iteration"], begun + done)
                self.assertGreater(shown["iteration"], motion["iterations"])
                self.assertEqual(outcome["iteration"], motion["iterations"] + 80 - done)
                self.assertEqual(outcome["iterations"], 80)
                self.assertRegex(outcome["message"], f"^Stopped at iteration {outcome['iteration']}: no more were allowed.")
                self.assertRegex(outcome["message"], "This run made 80 iterations.$")
                later.peer.ask("motion/set", motion=motion)
                for action in outcome["log"]:
                    later.do(**action)
                self.assertEqual(without_seconds(later.motion()), without_seconds(session.motion()))

    def test_an_edit_ends_a_solve_from_many_starts_and_stays(self):
        edits = [("action/do", {"action": {"action": "set", "constant": "BasketX", "value": 2.8}}),
                 ("action/do", {"action": {"action": "shake", "amplitude": 0.1, "seed": 5}}),
                 ("action/do", {"action": {"action": "reset"}})]
        for method, params in edits:
            with peer.Daemon("optimizer") as daemon:
                session = Session(daemon)
                session.load(self.problem)
                session.do(action="iterate", iterations=2)
                run = session.peer.start("action/do", action={"action": "solve", "tolerance": 1e-300, "starts": 1000})
                session.peer.ask(method, **params)
                outcome = session.peer.answer(run)["result"]
                self.assertEqual((outcome["status"], outcome["log"]), ("stopped", []))
                self.assertIn("an edit ended", outcome["message"])
                self.assertEqual(session.log, [{"action": "iterate", "iterations": 2}, params["action"]])
                self.assertEqual(without_words(self.replayed(session.log)), without_words(session.motion()))

    def test_a_solve_from_many_starts_tells_of_each_and_is_not_logged_when_cancelled(self):
        with peer.Daemon("optimizer") as daemon:
            session = Session(daemon)
            session.load(self.problem)
            run = session.peer.start("action/do", action={"action": "solve", "iterations": 3, "tolerance": 1e-300,
                                                          "starts": 1000})
            told = [session.wait_for_progress() for _ in range(3)]
            self.assertEqual(told[0]["iteration"] % 3, 0)
            self.assertLess(told[0]["iteration"], told[1]["iteration"])
            self.assertLess(told[1]["iteration"], told[2]["iteration"])
            session.peer.notify("$/cancelRequest", id=run)
            outcome = session.peer.answer(run)["result"]
            self.assertEqual((outcome["status"], outcome["log"]), ("stopped", []))
            self.assertRegex(outcome["message"], "^Interrupted .* of 1000 starts [0-9]+ had ended")

    def test_threads_of_many_starts_allocate_for_their_session(self):
        with peer.Daemon("optimizer", options=["--limit-memory", "15e6"]) as daemon:
            session = Session(daemon)
            session.load(self.problem)
            run = session.peer.start("action/do", action={"action": "solve", "starts": 1000, "iterations": 1})
            self.assertEqual(session.peer.answer(run)["error"]["data"]["limit"], "memory")
            self.assertEqual(session.do(action="iterate", iterations=1)["iteration"], 1)


if __name__ == "__main__":
    unittest.main()
