"""How daemons come and go: sockets and their modes, ends of input, signals, dying parents."""
import os
import select
import signal
import socket
import stat
import subprocess
import sys
import tempfile
import time
import unittest

from tests.wire import peer

ENDLESS = {"action": "solve", "tolerance": 1e-300}


class Sockets(unittest.TestCase):
    def serve(self, path):
        return subprocess.Popen([peer.path_of("symbolic"), "serve", "--listen", "unix:" + path], stdin=subprocess.DEVNULL,
                                stderr=subprocess.PIPE, text=True)

    def test_a_unix_socket_is_private_and_does_not_stay_behind(self):
        with tempfile.TemporaryDirectory() as directory:
            path = os.path.join(directory, "socket")
            for _ in range(2):  # the second finds what the first, killed, has left
                with self.serve(path) as first:
                    self.assertIn("listening on", first.stderr.readline())
                    status = os.stat(path)
                    self.assertTrue(stat.S_ISSOCK(status.st_mode))
                    self.assertEqual(stat.S_IMODE(status.st_mode), 0o600)
                    with self.serve(path) as second:
                        self.assertIn("listens on", second.stderr.readline())
                        self.assertEqual(second.wait(peer.PATIENCE), 1)
                    first.kill()
            self.assertTrue(os.path.exists(path))
            with self.serve(path) as third:
                self.assertIn("listening on", third.stderr.readline())
                third.terminate()
                self.assertEqual(third.wait(peer.PATIENCE), 0)
            self.assertFalse(os.path.exists(path))

    def test_a_socket_that_has_been_replaced_is_left_alone(self):
        with tempfile.TemporaryDirectory() as directory:
            path = os.path.join(directory, "socket")
            with self.serve(path) as first:
                first.stderr.readline()
                os.rename(path, path + ".old")
                with self.serve(path) as second:
                    second.stderr.readline()
                    first.terminate()
                    self.assertEqual(first.wait(peer.PATIENCE), 0)
                    self.assertTrue(os.path.exists(path))
                    second.terminate()

    def test_a_file_is_not_taken_for_a_socket(self):
        with tempfile.NamedTemporaryFile() as file, self.serve(file.name) as daemon:
            self.assertIn("no socket", daemon.stderr.readline())
            self.assertEqual(daemon.wait(peer.PATIENCE), 1)

    def test_addresses_that_are_none(self):
        for address in ("here", "unix:", "tcp://", "tcp://127.0.0.1", "tcp://127.0.0.1:x", "http://127.0.0.1:80", "tls://:1"):
            run = subprocess.run([peer.path_of("symbolic"), "serve", "--listen", address], stderr=subprocess.PIPE, text=True,
                                 timeout=peer.PATIENCE, stdin=subprocess.DEVNULL)
            self.assertEqual((run.returncode, "expected unix:/path" in run.stderr), (1, True), run.stderr)


class Ends(unittest.TestCase):
    def running(self, daemon):
        connection = daemon.connect()
        connection.greet()
        connection.ask("problem/load", problem=peer.problem_of("tests/wire/long_throw.scene"))
        run = connection.start("action/do", action=ENDLESS)
        while connection.receive().get("method") != "$/progress":
            pass
        return connection, run

    def test_a_shell_can_pipe_a_file_through_a_daemon(self):
        with tempfile.TemporaryFile() as requests, tempfile.TemporaryFile() as answers:
            requests.write(b'{"jsonrpc": "2.0", "id": 1, "method": "initialize", "params": {"protocol": 1}}\n'
                           b'{"jsonrpc": "2.0", "id": 2, "method": "scene/compile", "params": {"text": "time [0, 1]"}}\n')
            requests.seek(0)
            subprocess.run([peer.path_of("symbolic"), "serve"], stdin=requests, stdout=answers, check=True,
                           timeout=peer.PATIENCE)
            answers.seek(0)
            self.assertEqual(len(answers.read().splitlines()), 2)

    def test_a_signal_ends_a_run_with_its_outcome(self):
        for number in (signal.SIGTERM, signal.SIGINT):
            for transport in peer.TRANSPORTS:
                with peer.Daemon("optimizer", transport) as daemon:
                    connection, run = self.running(daemon)
                    daemon.process.send_signal(number)
                    self.assertEqual(connection.answer(run)["result"]["status"], "stopped")
                    self.assertEqual(connection.rest(), [])
                    self.assertEqual(daemon.process.wait(peer.PATIENCE), 0)

    def test_a_signal_ends_a_daemon_whose_output_nobody_reads(self):
        with peer.Daemon("symbolic") as daemon:
            requests = b'{"jsonrpc": "2.0", "id": 1, "method": "rpc.discover"}\n' * 1000
            os.set_blocking(daemon.process.stdin.fileno(), False)
            while select.select([], [daemon.process.stdin], [], 0.5)[1]:  # until the daemon reads no more
                daemon.process.stdin.write(requests)
            daemon.process.send_signal(signal.SIGTERM)
            self.assertEqual(daemon.process.wait(peer.PATIENCE), 0)

    def test_a_peer_that_vanishes_ends_its_run_alone(self):
        with peer.Daemon("optimizer", "tcp", ["--limit-sessions", "2"]) as daemon:
            stays, _ = self.running(daemon)
            vanishes, _ = self.running(daemon)
            vanishes.stream.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, b"\1\0\0\0\0\0\0\0")
            vanishes.close()  # with a reset
            end = time.monotonic() + peer.PATIENCE
            while time.monotonic() < end:
                with daemon.connect() as next_one:
                    if "result" in next_one.answer(next_one.start("initialize", protocol=1)):
                        break
            else:
                self.fail("its session goes on")
            self.assertEqual(stays.receive()["method"], "$/progress")
            stays.close()

    def test_a_dying_parent_takes_its_daemon_along(self):
        script = ("import json, sys, time\n"
                  "from tests.wire import peer\n"
                  "from tests.wire.test_transports import Ends\n"
                  "daemon = peer.Daemon('optimizer')\n"
                  "Ends().running(daemon)\n"
                  "print(daemon.process.pid, flush=True)\n"
                  "time.sleep(60)\n")
        with subprocess.Popen([sys.executable, "-c", script], cwd=peer.SOURCE, stdout=subprocess.PIPE) as parent:
            daemon = int(parent.stdout.readline())
            os.kill(daemon, 0)
            parent.kill()
        end = time.monotonic() + peer.PATIENCE
        while os.path.exists(f"/proc/{daemon}/exe") and time.monotonic() < end:
            time.sleep(0.005)
        self.assertFalse(os.path.exists(f"/proc/{daemon}/exe"))


if __name__ == "__main__":
    unittest.main()
