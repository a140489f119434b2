"""Checkpoints: gone on with to the same bits, come back to, and refused where they do not fit."""
import json
import os
import subprocess
import tempfile
import unittest

from tests.wire import peer
from tests.wire.session import Session, without_seconds


class Checkpoints(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.problem = peer.problem_of("tests/wire/long_throw.scene")

    def test_a_checkpoint_continues_to_the_same_bits(self):
        with peer.Daemon("optimizer") as daemon, peer.Daemon("optimizer") as another:
            session, later = Session(daemon), Session(another)
            session.load(self.problem)
            session.do(action="window", **{"from": 0.2, "to": 1.5})
            session.do(action="damp", limit=0.1, dofs=["arm.elbow"])
            session.do(action="iterate", iterations=9)
            session.do(action="refine", tolerance=1e-3)  # which spans it halves depends on the motion
            checkpoint = session.checkpoint_after(2)
            later.load(self.problem)  # and nothing else: edits, window, damping and knots are in the checkpoint
            later.peer.ask("motion/set", motion=checkpoint)
            for one in (session, later):
                one.do(action="iterate", iterations=3)
                one.do(action="set", constant="BasketX", value=2.8)
                one.do(action="refine", dofs=["arm.elbow"])
                one.do(action="window")
                outcome = one.do(action="solve", tolerance=1e-4)  # to its own end, after some 140 iterations
                self.assertEqual(outcome["status"], "converged")
            self.assertEqual(without_seconds(session.motion()), without_seconds(later.motion()))

    def test_numbers_rounded_on_the_way_are_told(self):
        def fifteen_digits(document):
            return json.loads(json.dumps(document), parse_float=lambda digits: float("%.15g" % float(digits)))

        with peer.Daemon("optimizer") as daemon:
            session = Session(daemon)
            load = session.peer.start("problem/load", problem=fifteen_digits(self.problem))
            fault = session.peer.answer(load)["error"]
            self.assertRegex(fault["data"]["path"], "^/problem/programs/[0-9a-f]{32}$")
            self.assertIn("numbers have probably been rounded on the way", fault["message"])
            session.load(self.problem)
            checkpoint = session.checkpoint_after(5)
            fault = session.peer.answer(session.peer.start("motion/set", motion=fifteen_digits(checkpoint)))["error"]
            self.assertEqual((fault["code"], fault["data"]["path"]), (-32602, "/motion/checkpoint/fingerprint"))
            self.assertIn("numbers have probably been rounded on the way", fault["message"])
            # Members in another order and numbers in other words are the same.
            other = json.dumps(checkpoint, sort_keys=True).replace(": 0.5,", ": 5.0e-1,")
            session.peer.ask("motion/set", motion=json.loads(other))
            with tempfile.TemporaryDirectory() as directory:
                files = [os.path.join(directory, name) for name in ("problem", "start")]
                for file, document in zip(files, (self.problem, fifteen_digits(checkpoint))):
                    with open(file, "w", encoding="utf-8") as out:
                        json.dump(document, out)
                solve = [peer.path_of("optimizer"), "solve", files[0], "--start", files[1]]
                solved = subprocess.run(solve, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
                self.assertEqual(solved.returncode, 1)
                self.assertIn(b"numbers have probably been rounded on the way", solved.stderr)

    def test_a_checkpoint_undoes_what_came_after_it(self):
        with peer.Daemon("optimizer") as daemon:
            session = Session(daemon)
            session.load(self.problem)
            checkpoint = session.checkpoint_after(5)
            ends = []
            for _ in range(2):
                session.do(action="iterate", iterations=6)
                ends.append(without_seconds(session.motion()))
                session.do(action="set", constant="BasketX", value=2.8)
                session.do(action="window", **{"from": 0.2, "to": 1.5})
                session.do(action="solve", method="sqp92", iterations=3)
                session.peer.ask("motion/set", motion=checkpoint)
            self.assertEqual(ends[0], ends[1])
            self.assertEqual(ends[0]["iterations"], 11)

    def test_a_checkpoint_during_a_run_disturbs_nothing(self):
        with peer.Daemon("optimizer", "unix") as daemon, peer.Daemon("optimizer", "unix") as another:
            for method in ("newton", "sqp92"):
                session, later, alone = Session(daemon), Session(another), Session(another)
                for one in (session, later, alone):
                    one.load(self.problem)
                solve = {"action": "solve", "method": method, "iterations": 60, "tolerance": 1e-300}
                run, question = session.peer.start_together(("action/do", {"action": solve}), ("motion/get", {"checkpoint": True}))
                answer = session.peer.answer(question)["result"]
                done = answer["iteration"]
                self.assertEqual(sum(part["iterations"] for part in answer["log"]), done)
                outcome = session.peer.answer(run)["result"]
                alone.do(**solve)
                self.assertEqual(without_seconds(session.motion()), without_seconds(alone.motion()))
                later.peer.ask("motion/set", motion=answer["motion"])
                for action in outcome["log"]:
                    later.do(**action)
                self.assertEqual(without_seconds(session.motion()), without_seconds(later.motion()))
                self.assertEqual(sum(part["iterations"] for part in session.log), 60)

    def test_a_checkpoint_of_another_problem_is_refused(self):
        with peer.Daemon("optimizer") as daemon:
            session = Session(daemon)
            session.load(self.problem)
            checkpoint = session.checkpoint_after(2)
            other = dict(self.problem, plots=[])
            session.peer.ask("problem/update", problem=other)
            fault = session.peer.answer(session.peer.start("motion/set", motion=checkpoint))["error"]
            self.assertEqual(fault["data"]["path"], "/motion/checkpoint/problem")
            checkpoint["checkpoint"]["newton"]["active"] = [1]
            checkpoint["format"] = "spacetime-motion/1"  # which has no fingerprint
            del checkpoint["checkpoint"]["fingerprint"]
            session.peer.ask("problem/update", problem=self.problem)
            fault = session.peer.answer(session.peer.start("motion/set", motion=checkpoint))["error"]
            self.assertEqual(fault["data"]["path"], "/motion/checkpoint/newton/active")
            del checkpoint["checkpoint"]
            session.peer.ask("motion/set", motion=checkpoint)


if __name__ == "__main__":
    unittest.main()
