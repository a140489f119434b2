"""Daemons as processes and peers that talk to them, over every transport and in both framings.

Standard library only: what is tested here is also that a stranger can write a client in a page.
"""
import atexit
import functools
import json
import os
import re
import select
import socket
import ssl
import subprocess
import tempfile
import time

SOURCE = os.environ.get("SPACETIME_SOURCE_DIR", os.path.join(os.path.dirname(__file__), "..", ".."))
PROGRAMS = os.environ.get("SPACETIME_BIN_DIR", os.path.join(SOURCE, "build", "dev", "bin"))
PATIENCE = 30  # seconds for any one answer; never reached unless something is wrong

# On the long throw it goes on until it is ended: steps by this method become ever smaller.  By Newton's the throw is as
# good as numbers can be after 225 iterations, some tenths of a second, in which a peer may have had no turn.
ENDLESS = {"action": "solve", "method": "sqp92", "tolerance": 1e-300, "iterations": 1000000000}

TRANSPORTS = ("stdio", "unix", "tcp", "tls")
FRAMINGS = ("lines", "headers")


def path_of(name):
    return os.path.join(PROGRAMS, "spacetime-" + name)


@functools.cache
def sanitizer():
    """With which the programs were built: address, thread, or none."""
    with open(path_of("symbolic"), "rb") as program:
        found = re.search(rb"__([at])san_init", program.read())
    return {b"a": "address", b"t": "thread"}[found[1]] if found else None


def framed(message, framing):
    if framing == "lines":
        return message + b"\n"
    return b"Content-Length: %d\r\n\r\n%s" % (len(message), message)


def problem_of(scene):
    """The problem document of a scene in the source tree, as the batch program makes it."""
    compiled = subprocess.run([path_of("symbolic"), "compile", os.path.join(SOURCE, scene)], check=True,
                              stdout=subprocess.PIPE)
    return json.loads(compiled.stdout)


def motion_of(scene):
    """The motion of a scene in the source tree, likewise."""
    solved = subprocess.run([path_of("optimizer"), "solve", "-q"], input=json.dumps(problem_of(scene)).encode(), check=True,
                            stdout=subprocess.PIPE)
    return json.loads(solved.stdout)


class Certificates:
    """An authority, what it has signed for each side, and what nobody should accept."""

    def __init__(self):
        self.directory = tempfile.TemporaryDirectory()
        atexit.register(self.directory.cleanup)
        subprocess.run([os.path.join(SOURCE, "protocol", "certificates.sh"), self.directory.name, "localhost",
                        "127.0.0.1", "10.0.3.3", "10.0.4.3"], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def __call__(self, name):
        return os.path.join(self.directory.name, name + ".pem")

    def options(self, who="daemon"):
        return ["--certificate", self(who), "--key", self(who + "-key"), "--authority", self("authority")]

    def context(self, who="client", authority="authority"):
        context = ssl.create_default_context(ssl.Purpose.SERVER_AUTH, cafile=self(authority))
        if who:
            context.load_cert_chain(self(who), self(who + "-key"))
        return context


class Daemon:
    """A daemon; with a transport other than stdio it serves any number of peers."""

    certificates = None  # made when first needed, for all

    def __init__(self, name, transport="stdio", options=()):
        self.transport, self.directory, self.opened = transport, None, []
        arguments = [path_of(name), "serve", *options]
        if transport == "stdio":
            self.process = subprocess.Popen(arguments, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                            stderr=subprocess.DEVNULL, bufsize=0)
            return
        self.directory = tempfile.TemporaryDirectory()
        self.log = os.path.join(self.directory.name, "log")
        if transport == "tls":
            Daemon.certificates = Daemon.certificates or Certificates()
            arguments += Daemon.certificates.options()
        where = {"unix": "unix:" + self.directory.name + "/socket", "tcp": "tcp://127.0.0.1:0",
                 "tls": "tls://127.0.0.1:0"}[transport]
        with open(self.log, "wb") as log:
            self.process = subprocess.Popen(arguments + ["--listen", where], stdin=subprocess.DEVNULL, stderr=log)
        self.address = self._wait_for_address()

    def _wait_for_address(self):
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end and self.process.poll() is None:
            with open(self.log, encoding="utf-8") as log:
                for line in log:
                    if "listening on " in line and line.endswith("\n"):
                        return line.split("listening on ")[1].strip()
            time.sleep(0.002)
        with open(self.log, encoding="utf-8") as log:
            raise RuntimeError("the daemon does not listen: " + log.read())

    def connect(self, framing="lines"):
        if self.transport == "stdio":
            return Peer(PipeStream(self.process), framing)
        return Peer(self.open_socket(), framing)

    def open_socket(self):
        """A connection; closed with the daemon at the latest."""
        opened = self._open_socket()
        self.opened.append(opened)
        return opened

    def _open_socket(self):
        if self.transport == "unix":
            plain = socket.socket(socket.AF_UNIX)
            plain.connect(self.address[len("unix:"):])
            return plain
        host, port = self.address.split("://")[1].rsplit(":", 1)
        plain = socket.create_connection((host, int(port)))
        plain.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        if self.transport == "tcp":
            return plain
        return Daemon.certificates.context().wrap_socket(plain, server_hostname="localhost")

    def end(self):
        """Ends it politely; its exit code."""
        if self.transport == "stdio":
            if not self.process.stdin.closed:
                self.process.stdin.close()
        else:
            self.process.terminate()
        code = self.process.wait(PATIENCE)
        if self.transport == "stdio":
            self.process.stdout.close()
        return code

    def resident_bytes(self):
        with open(f"/proc/{self.process.pid}/status", encoding="utf-8") as status:
            held = int(next(line for line in status if line.startswith("VmRSS")).split()[1]) * 1024
        # Beside each byte the thread sanitizer keeps four and more on who has used it.
        return held / 6 if sanitizer() == "thread" else held

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        for stream in self.opened:
            stream.close()
        if self.directory:
            self.directory.cleanup()
        if self.transport == "stdio":
            self.process.stdin.close()
            self.process.stdout.close()


class PipeStream:
    """A process's standard input and output with the functions of a socket."""

    def __init__(self, process):
        self.process = process

    def sendall(self, data):
        view = memoryview(data)
        while view:
            view = view[self.process.stdin.write(view):]

    def recv(self, most):
        return self.process.stdout.read(most) or b""

    def fileno(self):
        return self.process.stdout.fileno()

    def half_close(self):
        self.process.stdin.close()

    def close(self):
        if not self.process.stdin.closed:
            self.process.stdin.close()


class Ended(Exception):
    """The daemon has ended the connection."""


class Peer:
    def __init__(self, stream, framing="lines"):
        self.stream, self.framing = stream, framing
        self.buffer, self.last, self.waiting = b"", 0, []
        self.arrived = lambda message: None  # is called with each message in the order in which they come

    def send_raw(self, data):
        self.stream.sendall(data)

    def send(self, message):
        self.send_raw(framed(json.dumps(message).encode(), self.framing))

    def receive(self):
        """The next message of any kind."""
        if self.waiting:
            return self.waiting.pop(0)
        while True:
            message = self._cut()
            if message is not None:
                message = json.loads(message)
                self.arrived(message)
                return message
            self._more()

    def _more(self):
        pending = isinstance(self.stream, ssl.SSLSocket) and self.stream.pending()
        if not pending and not select.select([self.stream], [], [], PATIENCE)[0]:
            raise TimeoutError("the daemon does not answer")
        try:
            data = self.stream.recv(1 << 16)
        except (ConnectionError, ssl.SSLError):
            data = b""
        if not data:
            raise Ended()
        self.buffer += data

    def _cut(self):
        if self.framing == "lines":
            line, end, rest = self.buffer.partition(b"\n")
            if not end:
                return None
            self.buffer = rest
            return line
        headers, end, rest = self.buffer.partition(b"\r\n\r\n")
        if not end:
            return None
        name, length = headers.split(b": ")
        assert name == b"Content-Length", headers
        if len(rest) < int(length):
            return None
        self.buffer = rest[int(length):]
        return rest[:int(length)]

    def receive_answer(self):
        """The next message that is no progress."""
        while True:
            message = self.receive()
            if message.get("method") != "$/progress":
                return message

    def start(self, method, **params):
        """Sends a request; its id."""
        self.last += 1
        self.send({"jsonrpc": "2.0", "id": self.last, "method": method, "params": params})
        return self.last

    def start_together(self, *requests):
        """Sends requests (method, params) so that they arrive at once; their ids."""
        ids = range(self.last + 1, self.last + 1 + len(requests))
        self.last += len(requests)
        messages = [{"jsonrpc": "2.0", "id": number, "method": method, "params": params}
                    for number, (method, params) in zip(ids, requests)]
        self.send_raw(b"".join(framed(json.dumps(message).encode(), self.framing) for message in messages))
        return ids

    def notify(self, method, **params):
        self.send({"jsonrpc": "2.0", "method": method, "params": params})

    def answer(self, number, progress=None):
        """The whole answer to a request; other messages wait for their turn."""
        aside = []
        while True:
            message = self.receive()
            if message.get("id") == number and "method" not in message:
                self.waiting = aside + self.waiting
                return message
            if message.get("method") == "$/progress":
                if progress:
                    progress(message["params"])
            else:
                aside.append(message)

    def ask(self, method, progress=None, **params):
        message = self.answer(self.start(method, **params), progress)
        if "error" in message:
            raise RuntimeError(message["error"])
        return message["result"]

    def greet(self):
        return self.ask("initialize", protocol=1)

    def half_close(self):
        if isinstance(self.stream, PipeStream):
            self.stream.half_close()
        else:
            self.stream.shutdown(socket.SHUT_WR)

    def rest(self):
        """Everything until the daemon ends the connection."""
        messages = []
        try:
            while True:
                messages.append(self.receive())
        except Ended:
            return messages

    def close(self):
        self.stream.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()
