"""How daemons come and go: sockets and their modes, ends of input, signals, dying parents."""
import fcntl
import os
import resource
import select
import signal
import socket
import stat
import subprocess
import sys
import tempfile
import termios
import time
import unittest

from tests.wire import peer



class Sockets(unittest.TestCase):
    def serve(self, path):
        return subprocess.Popen([peer.path_of("symbolic"), "serve", "--listen", "unix:" + path], stdin=subprocess.DEVNULL,
                                stderr=subprocess.PIPE, text=True)

    def test_the_last_answers_reach_standard_output(self):
        """A daemon that ends at once, many times: what it said last may still be on its way."""
        asked = b"".join(b'{"jsonrpc": "2.0", "id": %d, "method": "%s"%s}\n' % one for one in (
            (1, b"initialize", b', "params": {"protocol": 1}'), (2, b"shutdown", b""), (3, b"exit", b"")))
        for _ in range(150):
            ended = subprocess.run([peer.path_of("symbolic"), "serve"], input=asked, stdout=subprocess.PIPE, timeout=60)
            self.assertEqual((ended.returncode, ended.stdout.count(b"\n")), (0, 3))

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

    def test_of_daemons_that_begin_at_once_one_has_the_path(self):
        with tempfile.TemporaryDirectory() as directory:
            path = os.path.join(directory, "socket")
            for _ in range(12):
                if not os.path.exists(path):  # what a killed one has left
                    with socket.socket(socket.AF_UNIX) as left:
                        left.bind(path)
                daemons = [self.serve(path) for _ in range(6)]
                said = [daemon.stderr.readline() for daemon in daemons]
                self.assertEqual(sum("listening on" in line for line in said), 1, said)
                self.assertEqual(sum("a daemon listens on" in line for line in said), 5, said)
                with socket.socket(socket.AF_UNIX) as connection:
                    connection.connect(path)
                self.assertEqual(os.listdir(directory), ["socket"])
                for daemon in daemons:
                    daemon.kill()
                    daemon.wait(peer.PATIENCE)
                    daemon.stderr.close()

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


class Records(unittest.TestCase):
    def test_one_that_cannot_be_written_is_refused_at_the_beginning(self):
        with tempfile.TemporaryDirectory() as directory:
            for file in ("/dev/full", directory, os.path.join(directory, "nowhere", "record")):
                run = subprocess.run([peer.path_of("symbolic"), "serve", "--record", file], stdin=subprocess.DEVNULL,
                                     capture_output=True, text=True, timeout=peer.PATIENCE)
                self.assertEqual((run.returncode, run.stdout), (1, ""))
                self.assertIn(f"cannot write the record '{file}'", run.stderr)

    def test_one_that_can_be_written_no_further_is_told_of_once(self):
        def small_files():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (300, 300))

        with tempfile.TemporaryDirectory() as directory:
            record = os.path.join(directory, "record")
            ask = '{"jsonrpc": "2.0", "id": %d, "method": "initialize", "params": {"protocol": 1}}\n'
            run = subprocess.run([peer.path_of("symbolic"), "serve", "--record", record],
                                 input="".join(ask % k for k in range(5)), preexec_fn=small_files, capture_output=True,
                                 text=True, timeout=peer.PATIENCE)
            self.assertEqual((run.returncode, len(run.stdout.splitlines())), (0, 5))  # the peer is served all the same
            self.assertEqual(run.stderr.count("cannot be written any further"), 1, run.stderr)


class Ends(unittest.TestCase):
    def test_a_session_without_threads_ends_with_a_sentence(self):
        if peer.sanitizer():
            self.skipTest("sanitizers want more addresses than this leaves")

        def few_threads(most):
            resource.setrlimit(resource.RLIMIT_STACK, (1 << 32, resource.RLIM_INFINITY))
            resource.setrlimit(resource.RLIMIT_AS, (most, most))

        for most in (3 << 30, 7 << 30, 11 << 30):  # bytes of addresses: for none, one and two of three threads
            with subprocess.Popen([peer.path_of("symbolic"), "serve"], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, preexec_fn=lambda most=most: few_threads(most), text=True) as run:
                self.assertIn("the session cannot begin", run.stderr.readline())
                self.assertEqual(run.wait(peer.PATIENCE), 1)

    def running(self, daemon):
        connection = daemon.connect()
        connection.greet()
        connection.ask("problem/load", problem=peer.problem_of("tests/wire/long_throw.scene"))
        run = connection.start("action/do", action=peer.ENDLESS)
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

    def test_a_signal_ends_a_daemon_whose_last_answers_nobody_reads(self):
        request = b'{"jsonrpc": "2.0", "id": 1, "method": "rpc.discover"}\n'
        answer = len(subprocess.run([peer.path_of("symbolic"), "serve"], input=request, stdout=subprocess.PIPE,
                                    check=True).stdout)
        for closes in (False, True):
            with peer.Daemon("symbolic") as daemon:
                # More than a pipe takes, and not so much that the daemon would have to wait until it has passed it on.
                daemon.process.stdin.write(request * (100_000 // answer + 1))
                if closes:
                    daemon.process.stdin.close()
                end = time.monotonic() + peer.PATIENCE
                while self.bytes_in(daemon.process.stdout) < 32768 and time.monotonic() < end:
                    time.sleep(0.002)
                while closes and self.threads_of(daemon) > 2 and time.monotonic() < end:
                    time.sleep(0.002)
                daemon.process.send_signal(signal.SIGTERM)
                self.assertEqual(daemon.process.wait(peer.PATIENCE), 0)

    def bytes_in(self, pipe):
        return int.from_bytes(fcntl.ioctl(pipe, termios.FIONREAD, bytes(4)), sys.byteorder)

    def threads_of(self, daemon):
        spare = 1 if peer.sanitizer() == "thread" else 0  # its own
        return len(os.listdir(f"/proc/{daemon.process.pid}/task")) - spare

    def test_answers_wait_for_whoever_reads_late(self):
        request = b'{"jsonrpc": "2.0", "id": 1, "method": "rpc.discover"}\n'
        with peer.Daemon("symbolic") as daemon:
            daemon.process.stdin.write(request * 40)
            daemon.process.stdin.close()
            self.assertEqual(len(daemon.process.stdout.read().splitlines()), 40)
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
