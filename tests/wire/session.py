"""A session with the optimizer that keeps what replays, and what two motions have in common."""


def without_seconds(motion):
    return {name: value for name, value in motion.items() if name != "seconds"}


def without_words(motion):
    """What a run that was stopped and the same number of iterations have in common."""
    return {name: value for name, value in without_seconds(motion).items() if name not in ("status", "message")}


class Session:
    """A peer with the throw loaded that keeps what replays: every answer's log."""

    def __init__(self, daemon):
        self.peer = daemon.connect()
        self.peer.greet()
        self.log = []
        self.peer.arrived = self.note

    def load(self, problem):
        return self.peer.ask("problem/load", problem=problem)

    def note(self, message):
        self.log += message.get("result", {}).get("log", [])

    def do(self, **action):
        return self.peer.ask("action/do", action=action)

    def motion(self):
        return self.peer.ask("motion/get")["motion"]

    def checkpoint_after(self, iterations):
        self.do(action="iterate", iterations=iterations)
        return self.peer.ask("motion/get", checkpoint=True)["motion"]

    def wait_for_progress(self, count=1):
        """Until so many iterates have been shown; the last one.  None where the run has ended before; its answer waits."""
        while True:
            message = self.peer.receive()
            if message.get("method") != "$/progress":
                self.peer.waiting.insert(0, message)
                return None
            count -= 1
            if count <= 0:
                return message["params"]["value"]
