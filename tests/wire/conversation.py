"""Conversations as files: what a peer sends and what the daemon answers, line by line.

    # daemon: optimizer
    > {"jsonrpc": "2.0", "id": 1, "method": "initialize", "params": {"protocol": 1}}
    < {"jsonrpc": "2.0", "id": 1, "result": {"protocol": 1, "...": "..."}}

A line with > is sent as it is, one with < is what comes next; progress counts only where it is expected. In what is expected "..." stands for
anything, as a member it permits others. "@problem PATH" stands for the problem of a scene, "@motion PATH" for its motion,
"@text PATH" for a file's text.
"""
import json
import math
import os

from tests.wire import peer


def expand(value):
    if isinstance(value, dict):
        return {name: expand(member) for name, member in value.items()}
    if isinstance(value, list):
        return [expand(element) for element in value]
    if isinstance(value, str) and value.startswith("@problem "):
        return peer.problem_of(value.split()[1])
    if isinstance(value, str) and value.startswith("@motion "):
        return peer.motion_of(value.split()[1])
    if isinstance(value, str) and value.startswith("@text "):
        with open(os.path.join(peer.SOURCE, value.split()[1]), encoding="utf-8") as file:
            return file.read()
    return value


def mismatch(expected, found, where=""):
    """Where what was found differs from what was expected; None where it does not."""
    if expected == "...":
        return None
    if isinstance(expected, dict) and isinstance(found, dict):
        open_ended = "..." in expected
        names = [name for name in expected if name != "..."]
        if not open_ended and set(names) != set(found):
            return f"{where}: members {sorted(found)}, expected {sorted(names)}"
        for name in names:
            if name not in found:
                return f"{where}/{name} is missing"
            if wrong := mismatch(expected[name], found[name], f"{where}/{name}"):
                return wrong
        return None
    if isinstance(expected, list) and isinstance(found, list):
        if len(expected) != len(found):
            return f"{where}: {len(found)} elements, expected {len(expected)}"
        return next((wrong for i, (a, b) in enumerate(zip(expected, found)) if (wrong := mismatch(a, b, f"{where}/{i}"))),
                    None)
    numbers = isinstance(expected, float) and isinstance(found, (int, float))
    if numbers and math.isclose(expected, found, rel_tol=1e-6, abs_tol=1e-9):
        return None
    return None if expected == found else f"{where}: found {found!r}, expected {expected!r}"


class Conversation:
    def __init__(self, file):
        self.name = os.path.basename(file)
        self.daemon, self.options, self.turns = None, [], []
        with open(file, encoding="utf-8") as lines:
            for number, line in enumerate(lines, 1):
                line = line.rstrip("\n")
                if line.startswith("# daemon: "):
                    self.daemon, *self.options = line.split(": ", 1)[1].split()
                elif line[:2] in ("> ", "< "):
                    self.turns.append((number, line[0], line[2:]))
                elif line and not line.startswith("#"):
                    raise ValueError(f"{file}:{number}: what is this?")

    def sent(self):
        """The messages that the peer sends, as bytes."""
        for number, direction, text in self.turns:
            if direction == ">":
                yield number, message_of(text)

    def expected(self):
        for number, direction, text in self.turns:
            if direction == "<":
                yield number, expand(json.loads(text))

    def play(self, connection):
        """Plays the peer; a sentence on the first difference, or None."""
        for number, direction, text in self.turns:
            where = f"{self.name}:{number}"
            if direction == ">":
                connection.send_raw(peer.framed(message_of(text), connection.framing))
                continue
            expected = expand(json.loads(text))
            shown = expected.get("method") == "$/progress"
            found = connection.receive() if shown else connection.receive_answer()
            if wrong := mismatch(expected, found):
                return f"{where}{wrong} in {json.dumps(found)[:600]}"
        return None


def message_of(text):
    return json.dumps(expand(json.loads(text))).encode() if '"@' in text else text.encode()


def all_conversations():
    directory = os.path.dirname(__file__)
    files = sorted(name for name in os.listdir(directory) if name.endswith(".conversation"))
    return [Conversation(os.path.join(directory, name)) for name in files]
