#!/usr/bin/env python3
"""Replays what `serve --record FILE` has recorded, session by session, and compares the answers.

    python3 examples/replay.py FILE PROGRAM

Requests are sent again in the order in which they were answered, actions as their answers logged them, so that edits fall
between the same two iterations as they did. What was measured in seconds is left out, why runs were stopped, and what was
asked while one went on. Exits with 1 where an answer differs.
"""
import json
import sys

from client import Daemon

MEASURED = {"seconds", "milliseconds", "derived", "message", "status"}
COMPARED = {"scene/compile", "action/parse", "expression/query", "motion/get", "sample"}
REPEATED = COMPARED | {"problem/load", "problem/update", "motion/set"}


def settled(value):
    """The value without what differs from run to run."""
    if isinstance(value, dict):
        return {name: settled(member) for name, member in value.items() if name not in MEASURED}
    return [settled(element) for element in value] if isinstance(value, list) else value


def replay(messages, program):
    """Replays one session; how many answers were compared, and those that differ."""
    daemon, asked, running, compared, different = Daemon(program), {}, set(), 0, []
    for entry in messages:
        message = entry.get("message")
        if not isinstance(message, dict):
            continue
        if entry["from"] == "peer":
            asked[message.get("id")] = message
            if message.get("method") == "action/do":
                running.add(message.get("id"))
            continue
        running.discard(message.get("id"))
        request = asked.get(message.get("id"), {})
        method, params = request.get("method"), request.get("params") or {}
        params = {name: value for name, value in params.items() if name not in ("revision", "progress")}
        if "result" not in message or "method" in message:
            continue
        recorded = {name: value for name, value in message["result"].items() if name != "revision"}
        for action in recorded.get("log", []):
            daemon.ask("action/do", action=action)
        if method in REPEATED:
            found = daemon.ask(method, **params)
            if method in COMPARED and not running:
                compared += 1
                if settled(found) != settled(recorded):
                    different.append(message["id"])
    daemon.end()
    return compared, different


def main(file, program):
    sessions = {}
    with open(file, encoding="utf-8") as lines:
        for line in lines:
            entry = json.loads(line)
            sessions.setdefault(entry["session"], []).append(entry)
    failed = False
    for number, messages in sessions.items():
        compared, different = replay(messages, program)
        print(f"session {number}: {compared} answers compared, {len(different)} differ", *different)
        failed = failed or bool(different)
    return failed


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]) if len(sys.argv) == 3 else __doc__)
