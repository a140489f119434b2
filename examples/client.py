#!/usr/bin/env python3
"""Drives both daemons: compiles a scene, solves it with live progress, moves the basket and solves again.

    python3 examples/client.py examples/throw.scene BasketX 3 [directory of the programs]
"""
import json
import subprocess
import sys


class Daemon:
    """A program that speaks JSON-RPC over its standard input and output, one message a line."""

    def __init__(self, program):
        self.process = subprocess.Popen([program, "serve"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        self.last = 0
        self.ask("initialize", protocol=1, client={"name": "client.py"})

    def ask(self, method, progress=None, **params):
        self.last += 1
        request = {"jsonrpc": "2.0", "id": self.last, "method": method, "params": params}
        self.process.stdin.write(json.dumps(request).encode() + b"\n")
        self.process.stdin.flush()
        for line in self.process.stdout:
            message = json.loads(line)
            if message.get("method") == "$/progress" and progress:
                progress(message["params"]["value"])
            if message.get("id") == self.last:
                if "error" in message:
                    raise RuntimeError(message["error"]["message"])
                return message["result"]
        raise RuntimeError("the daemon has ended")

    def end(self):
        self.process.stdin.close()
        self.process.wait()


def show(iterate):
    print(f"\r{iterate['iteration']:5}  objective {iterate['objective']:<14.8g} "
          f"violation {iterate['violation']:<10.3g}", end="", file=sys.stderr)


def main(scene, constant, value, programs="build/programs/bin"):
    symbolic, optimizer = (Daemon(f"{programs}/spacetime-{name}") for name in ("symbolic", "optimizer"))
    with open(scene, encoding="utf-8") as file:
        compiled = symbolic.ask("scene/compile", text=file.read())
    for mistake in compiled["diagnostics"]:
        print(f"{scene}:{mistake['line']}:{mistake['column']}: {mistake['message']}", file=sys.stderr)
    if "problem" not in compiled:
        return 1
    optimizer.ask("problem/load", problem=compiled["problem"])
    for edit in (None, {"action": "set", "constant": constant, "value": float(value)}):
        if edit:
            optimizer.ask("action/do", action=edit)
        outcome = optimizer.ask("action/do", progress=show, action={"action": "solve"})
        print(f"\r{outcome['status']} after {outcome['iteration']} iterations: {outcome['message']}", file=sys.stderr)
    json.dump(optimizer.ask("motion/get")["motion"], sys.stdout)
    symbolic.end()
    optimizer.end()
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]) if len(sys.argv) in (4, 5) else __doc__)
