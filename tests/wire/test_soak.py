"""Eight sessions for minutes (SPACETIME_SOAK_SECONDS, 180 unless said): the daemon's memory does not grow.

Run with `ctest -C soak`; the default run leaves it out.
"""
import os
import random
import threading
import time
import unittest

from tests.wire import peer

SECONDS = float(os.environ.get("SPACETIME_SOAK_SECONDS", "180"))
SESSIONS = 8
GROWTH = 8 << 20  # bytes: less than one session's worth


class Soak(unittest.TestCase):
    def work(self, daemon, number, problem, until, counts):
        chance = random.Random(number)
        while time.monotonic() < until:
            with daemon.connect(chance.choice(peer.FRAMINGS)) as connection:
                connection.greet()
                connection.ask("problem/load", problem=problem)
                for _ in range(20):
                    run = connection.start("action/do", action={"action": "solve"})
                    if chance.random() < 0.3:
                        connection.notify("$/cancelRequest", id=run)
                    edit = connection.start("action/do", action={"action": "set", "constant": "BasketX",
                                                                 "value": chance.uniform(2, 3)})
                    connection.answer(edit)
                    connection.answer(run)
                    connection.ask("sample", times=[k / 30 for k in range(60)])
                    connection.ask("motion/get", checkpoint=chance.random() < 0.2)
                    counts[number] += 5

    def test_memory_does_not_grow(self):
        problem = peer.problem_of("examples/throw.scene")
        with peer.Daemon("optimizer", "unix") as daemon:
            begun, counts = time.monotonic(), [0] * SESSIONS
            workers = [threading.Thread(target=self.work, args=(daemon, k, problem, begun + SECONDS, counts))
                       for k in range(SESSIONS)]
            for worker in workers:
                worker.start()
            sizes = []
            while any(worker.is_alive() for worker in workers):
                time.sleep(SECONDS / 20)
                sizes.append(daemon.resident_bytes())
            for worker in workers:
                worker.join()
            print(f"{sum(counts)} requests; MB: " + " ".join(f"{size / 1e6:.1f}" for size in sizes))
            self.assertGreater(min(counts), 0)
            self.assertLess(max(sizes[10:]) - max(sizes[:10]), GROWTH)
            self.assertEqual(daemon.end(), 0)


if __name__ == "__main__":
    unittest.main()
