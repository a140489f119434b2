"""What examples/ shows people: the client of a page, a sweep, a record and its replay."""
import json
import os
import shutil
import subprocess
import tempfile
import unittest

from tests.wire import peer
from tests.wire.session import Session


class Examples(unittest.TestCase):
    def run_example(self, *arguments, **options):
        return subprocess.run([os.path.join(peer.SOURCE, "examples", arguments[0]), *arguments[1:]], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, timeout=100, cwd=peer.SOURCE, text=True, **options)

    def test_the_client_moves_the_basket_and_solves_again(self):
        run = self.run_example("client.py", "examples/throw.scene", "BasketX", "3", peer.PROGRAMS)
        self.assertEqual(run.returncode, 0, run.stderr)
        motion = json.loads(run.stdout)
        self.assertEqual((motion["status"], motion["constants"]["BasketX"]), ("converged", 3))
        self.assertEqual(run.stderr.count("converged after"), 2)

    def test_the_sweep_gathers_a_table(self):
        self.assertIsNotNone(shutil.which("parallel"), "this test needs GNU parallel")
        run = self.run_example("sweep.sh", "examples/throw.scene", "BasketX", "2.4", "2.5", "2.6",
                               env={**os.environ, "PROGRAMS": peer.PROGRAMS})
        rows = [line.split("\t") for line in run.stdout.splitlines()]
        self.assertEqual([row[:2] for row in rows], [["BasketX", "status"]] + [[x, "converged"] for x in ("2.4", "2.5", "2.6")])
        self.assertLess(float(rows[1][3]), float(rows[3][3]))

    def test_a_record_replays(self):
        with tempfile.TemporaryDirectory() as directory:
            record = os.path.join(directory, "record.jsonl")
            with peer.Daemon("optimizer", "unix", ["--record", record]) as daemon:
                for chance in (1, 2):
                    session = Session(daemon)
                    session.load(peer.problem_of("tests/wire/long_throw.scene"))
                    run = session.peer.start("action/do", action={"action": "solve"})
                    session.wait_for_progress(chance)
                    session.do(action="set", constant="BasketX", value=2.5 + 0.1 * chance)
                    session.motion()
                    session.wait_for_progress()
                    session.peer.notify("$/cancelRequest", id=run)
                    session.note(session.peer.answer(run))
                    session.motion()
                    session.peer.ask("sample", times=[0, 1, 2])
                self.assertEqual(daemon.end(), 0)
            replay = self.run_example("replay.py", record, peer.path_of("optimizer"))
            self.assertEqual(replay.returncode, 0, replay.stdout + replay.stderr)
            self.assertEqual(replay.stdout.count("2 answers compared, 0 differ"), 2, replay.stdout)
            with open(record, encoding="utf-8") as file:
                text = file.read()
            with open(record, "w", encoding="utf-8") as file:  # one that tells another motion is noticed
                file.write(text.replace('"total":', '"total":1'))
            self.assertEqual(self.run_example("replay.py", record, peer.path_of("optimizer")).returncode, 1)


if __name__ == "__main__":
    unittest.main()
