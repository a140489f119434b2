"""Client libraries of editors drive both daemons: Debian's python3-pylsp-jsonrpc, and vscode-jsonrpc from npm."""
import json
import os
import shutil
import subprocess
import tempfile
import unittest

from tests.wire import peer

SCENE = os.path.join(peer.SOURCE, "examples/throw.scene")

# Runs under Debian's own interpreter, which has the package.
PYLSP = r'''
import json, subprocess, sys, threading
from pylsp_jsonrpc.dispatchers import MethodDispatcher
from pylsp_jsonrpc.endpoint import Endpoint
from pylsp_jsonrpc.streams import JsonRpcStreamReader, JsonRpcStreamWriter

programs, scene, problem = sys.argv[1:]
iterates, begun = [], threading.Event()

class Progress(dict):
    def __missing__(self, method):
        if method != "$/progress":
            raise KeyError(method)
        def handle(params):
            iterates.append(params["token"])
            if params["token"] == "endless":
                begun.set()
        return handle

def start(name):
    process = subprocess.Popen([f"{programs}/spacetime-{name}", "serve"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    endpoint = Endpoint(Progress(), JsonRpcStreamWriter(process.stdin).write)
    threading.Thread(target=JsonRpcStreamReader(process.stdout).listen, args=[endpoint.consume], daemon=True).start()
    endpoint.request("initialize", {"protocol": 1, "client": {"name": "pylsp-jsonrpc"}}).result(30)
    return process, endpoint

def end(process, endpoint):
    endpoint.request("shutdown", {}).result(30)
    endpoint.notify("exit")
    return process.wait(30)

symbolic, optimizer = start("symbolic"), start("optimizer")
compiled = symbolic[1].request("scene/compile", {"text": open(scene, encoding="utf-8").read()}).result(30)
ask = optimizer[1].request
ask("problem/load", {"problem": compiled["problem"]}).result(30)
outcome = ask("action/do", {"action": {"action": "solve"}, "progress": "solving"}).result(30)
ask("problem/load", {"problem": json.load(open(problem))}).result(30)
endless = ask("action/do", {"action": {"action": "solve", "tolerance": 1e-300}, "progress": "endless"})
assert begun.wait(30)
optimizer[1].notify("$/cancelRequest", {"id": next(iter(optimizer[1]._server_request_futures))})
cancelled = endless.result(30)
try:
    ask("motion/get", {"oops": 1}).result(30)
    mistake = None
except Exception as error:
    mistake = error.code
print(json.dumps({"diagnostics": compiled["diagnostics"], "iterates": iterates.count("solving"),
                  "status": outcome["status"], "cancelled": cancelled["status"], "mistake": mistake,
                  "codes": [end(*symbolic), end(*optimizer)]}))
'''


class Libraries(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = directory.name
        self.problem = os.path.join(self.directory, "problem.json")
        with open(self.problem, "w", encoding="utf-8") as file:
            json.dump(peer.problem_of("tests/wire/long_throw.scene"), file)

    def judge(self, command, **options):
        run = subprocess.run(command + [peer.PROGRAMS, SCENE, self.problem], stdout=subprocess.PIPE, timeout=100,
                             check=True, **options)
        found = json.loads(run.stdout)
        self.assertGreater(found.pop("iterates"), 0)
        self.assertEqual(found, {"diagnostics": [], "status": "converged", "cancelled": "stopped", "mistake": -32602,
                                 "codes": [0, 0]})

    def test_pylsp_jsonrpc(self):
        self.judge(["/usr/bin/python3", "-c", PYLSP])

    def test_vscode_jsonrpc(self):
        npm = shutil.which("npm")
        if npm is None:
            self.skipTest("npm is not installed")
        try:
            subprocess.run([npm, "install", "--prefix", self.directory, "--no-audit", "--no-fund", "--silent",
                            "vscode-jsonrpc@8.2.1"], check=True, timeout=100)
        except (subprocess.CalledProcessError, subprocess.TimeoutExpired) as failure:
            self.skipTest(f"vscode-jsonrpc cannot be fetched here: {failure}")
        self.judge(["node", os.path.join(peer.SOURCE, "tests/wire/vscode.cjs")],
                   env={**os.environ, "NODE_PATH": os.path.join(self.directory, "node_modules")})


if __name__ == "__main__":
    unittest.main()
