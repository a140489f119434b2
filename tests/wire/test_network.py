"""Three machines, as network namespaces joined by virtual cables: the client, and a daemon on each of the others, with TLS.

Needs root; elsewhere only what the loopback shows is tested.
"""
import contextlib
import os
import socket
import ssl
import subprocess
import sys
import unittest

from tests.wire import peer

PREFIX = f"st{os.getpid() % 100000}"
HOSTS = {"gui": None, "symbolic": "10.0.3.3", "optimizer": "10.0.4.3"}


def ip(*arguments):
    subprocess.run(["ip", *arguments], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def inside(host, *command):
    return ["ip", "netns", "exec", f"{PREFIX}-{host}", *command]


def listening(arguments):
    """Starts a daemon; the process, or None with what it said."""
    process = subprocess.Popen(arguments, stdin=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    line = process.stderr.readline()
    if "listening on" in line:
        return process, line
    process.wait(peer.PATIENCE)
    rest = process.stderr.read()
    process.stderr.close()
    return None, line + rest


class Refused(unittest.TestCase):
    """What a daemon does not even begin, and whom it does not let in."""

    @classmethod
    def setUpClass(cls):
        cls.certificates = peer.Certificates()
        cls.others = peer.Certificates()

    def test_plain_tcp_off_loopback(self):
        for host in ("0.0.0.0", "[::]", "192.0.2.1"):
            process, said = listening([peer.path_of("optimizer"), "serve", "--listen", f"tcp://{host}:0"])
            self.assertIsNone(process)
            self.assertIn("use tls://", said)

    def test_tls_without_certificates(self):
        process, said = listening([peer.path_of("optimizer"), "serve", "--listen", "tls://127.0.0.1:0"])
        self.assertIsNone(process)
        self.assertIn("--certificate", said)

    def test_who_shows_no_wrong_or_expired_certificate(self):
        with peer.Daemon("symbolic", "tls") as daemon:
            good = peer.Daemon.certificates
            self.expire(good)
            host, port = daemon.address.split("://")[1].rsplit(":", 1)

            def try_with(context):
                plain = socket.create_connection((host, int(port)))
                with context.wrap_socket(plain, server_hostname="localhost") as secured:
                    connection = peer.Peer(secured)
                    connection.greet()

            try_with(good.context())
            none, wrong, expired = good.context(None), self.others.context(), good.context("expired")
            wrong.load_verify_locations(good("authority"))
            for context in (none, wrong, expired):
                with self.assertRaises((ssl.SSLError, peer.Ended, ConnectionError)):
                    try_with(context)
            # A client refuses a daemon that its authority does not know, or that goes by another name.
            for context, name in ((self.others.context(), "localhost"), (good.context(), "elsewhere.example")):
                with self.assertRaises(ssl.SSLCertVerificationError):
                    with socket.create_connection((host, int(port))) as plain:
                        context.wrap_socket(plain, server_hostname=name)
            # One who does not speak TLS at all.
            with socket.create_connection((host, int(port))) as plain, contextlib.suppress(ConnectionError):
                plain.sendall(b'{"jsonrpc": "2.0", "id": 1, "method": "initialize", "params": {"protocol": 1}}\n')
                self.assertNotIn(b"result", plain.recv(4096))
            self.assertEqual(daemon.end(), 0)

    @staticmethod
    def expire(certificates):
        """Signs a client's certificate that ended yesterday."""
        key, request = certificates("expired-key"), certificates("expired-request")
        quiet = {"check": True, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        subprocess.run(["openssl", "req", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes", "-keyout",
                        key, "-out", request, "-subj", "/CN=expired"], **quiet)
        subprocess.run(["openssl", "x509", "-req", "-in", request, "-CA", certificates("authority"), "-CAkey",
                        certificates("authority-key"), "-days", "-1", "-out", certificates("expired")], **quiet)


def may_make_namespaces():
    """Tries all that three machines need: root may lack rights, or a container what `ip` mounts."""
    probe = PREFIX + "-probe"
    try:
        ip("netns", "add", probe)
    except (OSError, subprocess.CalledProcessError):
        return False
    try:
        ip("-n", probe, "link", "set", "lo", "up")
        ip("-n", probe, "link", "add", "probe0", "type", "veth", "peer", "name", "probe1")
        ip("netns", "exec", probe, "true")
    except subprocess.CalledProcessError:
        return False
    finally:
        subprocess.run(["ip", "netns", "del", probe], check=False, stderr=subprocess.DEVNULL)
    return True


class ThreeMachines(unittest.TestCase):
    def setUp(self):
        for host in HOSTS:
            ip("netns", "add", f"{PREFIX}-{host}")
            self.addCleanup(ip, "netns", "del", f"{PREFIX}-{host}")
            ip("-n", f"{PREFIX}-{host}", "link", "set", "lo", "up")
        for number, host in ((3, "symbolic"), (4, "optimizer")):
            ours, theirs = f"{PREFIX[-6:]}a{number}", f"{PREFIX[-6:]}b{number}"
            ip("link", "add", ours, "netns", f"{PREFIX}-gui", "type", "veth", "peer", "name", theirs, "netns", f"{PREFIX}-{host}")
            for name, where, address in ((ours, "gui", f"10.0.{number}.2/24"), (theirs, host, f"10.0.{number}.3/24")):
                ip("-n", f"{PREFIX}-{where}", "addr", "add", address, "dev", name)
                ip("-n", f"{PREFIX}-{where}", "link", "set", name, "up")

    def test_a_scene_is_compiled_on_one_and_solved_on_another(self):
        certificates = peer.Certificates()
        for host in ("symbolic", "optimizer"):
            process, said = listening(inside(host, peer.path_of(host), "serve", "--listen", f"tls://{HOSTS[host]}:7777",
                                             *certificates.options()))
            self.assertIsNotNone(process, said)
            self.addCleanup(process.stderr.close)
            self.addCleanup(process.wait, peer.PATIENCE)
            self.addCleanup(process.terminate)
        run = subprocess.run(inside("gui", sys.executable, "-m", "tests.wire.remote", certificates.directory.name),
                             stdout=subprocess.PIPE, timeout=60, check=True, text=True)
        self.assertEqual(run.stdout.split()[:1], ["converged"])
        # Without TLS nobody listens beyond the machine itself.
        process, said = listening(inside("optimizer", peer.path_of("optimizer"), "serve", "--listen", "tcp://10.0.4.3:7778"))
        self.assertIsNone(process)
        self.assertIn("use tls://", said)


if not may_make_namespaces():
    print("network namespaces cannot be made here: three machines are not tested")
    del ThreeMachines


if __name__ == "__main__":
    unittest.main()
