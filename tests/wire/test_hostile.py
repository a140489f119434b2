"""Hostile peers: each is refused or served, memory stays bounded, and a session beside them notices nothing."""
import contextlib
import json
import random
import socket
import threading
import time
import unittest

from tests.wire import peer

# What one daemon may hold beyond what it holds idle, with any of these at work: twice the message limit and some.
MEMORY = 64 << 20
OPTIONS = ["--limit-message", "4000000", "--limit-sessions", "20"]


class Hostile(unittest.TestCase):
    def setUp(self):
        self.daemon = self.enterContext(peer.Daemon("optimizer", "unix", OPTIONS))
        self.problem = peer.problem_of("examples/throw.scene")
        self.beside = self.daemon.connect()
        self.beside.greet()
        self.beside.ask("problem/load", problem=self.problem)
        self.beside.ask("action/do", action={"action": "solve"})
        self.idle_bytes = self.daemon.resident_bytes()

    def tearDown(self):
        # The session beside is served, the daemon's memory is bounded, and it ends cleanly.
        self.beside.ask("action/do", action={"action": "set", "constant": "BasketX", "value": 2.7})
        self.assertEqual(self.beside.ask("action/do", action={"action": "solve"})["status"], "converged")
        grown = self.daemon.resident_bytes() - self.idle_bytes
        print(f"{self._testMethodName}: {grown / 1e6:.1f} MB more", flush=True)
        self.assertLess(grown, MEMORY)
        self.beside.close()
        self.assertEqual(self.daemon.end(), 0)

    def test_a_reader_that_never_reads(self):
        stream = self.daemon.open_socket()
        stream.setblocking(False)
        times = [2 * k / 2000 for k in range(2001)]  # answered with as many rows of everything, about a megabyte
        messages = [{"method": "initialize", "params": {"protocol": 1}}, {"method": "problem/load", "params": {"problem": self.problem}}]
        messages += [{"method": "sample", "params": {"times": times}}] * 200
        data = b"".join(json.dumps({"jsonrpc": "2.0", "id": i, **m}).encode() + b"\n" for i, m in enumerate(messages))
        sent, still, held = 0, 0, 0
        while still < 50:  # until it takes and makes nothing more
            still += 1
            with contextlib.suppress(BlockingIOError):
                while sent < len(data):
                    sent += stream.send(data[sent:sent + 65536])
                    still = 0
            before, held = held, self.daemon.resident_bytes() - self.idle_bytes
            self.assertLess(held, MEMORY)
            if held > before + 100_000:
                still = 0
            time.sleep(0.01)
        self.addCleanup(stream.close)

    def test_a_writer_that_stops_inside_a_message(self):
        for beginning in (b"{", b'{"jsonrpc": "2.0", "id": 1, "meth', b"Content-Length: 100\r\n", b"Content-Length: 100\r\n\r\n{",
                          b"{" + b" " * 3_000_000):
            stream = self.daemon.open_socket()
            stream.sendall(beginning)
            self.addCleanup(stream.close)

    def test_two_hundred_connections(self):
        with contextlib.ExitStack() as stack:
            served = refused = 0
            peers = []
            for _ in range(200):
                with contextlib.suppress(ConnectionError, BlockingIOError):
                    peers.append(stack.enter_context(self.daemon.connect()))
            for each in peers:
                try:
                    answer = each.answer(each.start("initialize", protocol=1))
                    served += "result" in answer
                    refused += answer.get("error", {}).get("code") == -32015
                except (peer.Ended, ConnectionError, BrokenPipeError):
                    refused += 1
            self.assertEqual(served, 19)  # and the one beside
            self.assertEqual(served + refused, len(peers))
        # When they have gone there is room again.
        deadline = time.monotonic() + peer.PATIENCE
        while time.monotonic() < deadline:
            with self.daemon.connect() as again, contextlib.suppress(peer.Ended, ConnectionError):
                if "result" in again.answer(again.start("initialize", protocol=1)):
                    return
        self.fail("no room")

    def test_one_session_too_many_is_told_so(self):
        with contextlib.ExitStack() as stack:
            for _ in range(19):
                stack.enter_context(self.daemon.connect()).greet()
            for framing in peer.FRAMINGS:
                with self.daemon.connect(framing) as late:
                    error = late.answer(late.start("initialize", protocol=1))["error"]
                    self.assertEqual((error["code"], error["data"]["limit"]), (-32015, "sessions"))
                    self.assertEqual(late.rest(), [])

    def test_ten_gigabytes_claimed(self):
        with self.daemon.connect("headers") as claimer:
            claimer.send_raw(b"Content-Length: 10000000000\r\n\r\n{")
            error = claimer.receive()["error"]
            self.assertEqual((error["code"], error["data"]["most"]), (-32010, 4000000))
            self.assertEqual(claimer.rest(), [])

    def test_who_goes_on_sending_still_hears_why_it_is_refused(self):
        for transport in ("unix", "tcp", "tls"):
            with peer.Daemon("optimizer", transport, OPTIONS) as daemon:
                for _ in range(10):
                    with daemon.connect("headers") as claimer:
                        claimer.send_raw(b"Content-Length: 10000000000\r\n\r\n" + b"x" * 100_000)
                        self.assertEqual(claimer.receive()["error"]["code"], -32010)
                        self.assertEqual(claimer.stream.recv(1), b"")  # an end, and no reset, which may overtake the error
                self.assertEqual(daemon.end(), 0)

    def test_ten_gigabytes_in_one_line(self):
        with self.daemon.connect() as writer:
            writer.greet()
            for _ in range(300):  # a line that goes on for 30 MB is skipped to its end
                writer.send_raw(b"[" * 100_000)
            writer.send_raw(b"\n")
            self.assertEqual(writer.receive()["error"]["code"], -32010)
            self.assertEqual(writer.answer(writer.start("motion/get"))["error"]["code"], -32003)

    def test_a_hundred_thousand_brackets(self):
        with self.daemon.connect() as nested:
            nested.greet()
            for text in (b"[" * 100_000, b'{"a":' * 100_000, b"[" * 100_000 + b"]" * 100_000):
                nested.send_raw(text + b"\n")
                self.assertEqual(nested.receive()["error"]["code"], -32011)

    def test_a_million_random_bytes(self):
        seed = 1992
        print("seed", seed)
        chance = random.Random(seed)
        for _ in range(20):
            stream = self.daemon.open_socket()

            def drain(stream=stream):
                with contextlib.suppress(OSError):
                    while stream.recv(65536):
                        pass
            reader = threading.Thread(target=drain)
            reader.start()
            with contextlib.suppress(OSError):
                stream.sendall(chance.randbytes(50_000))
                stream.shutdown(socket.SHUT_WR)
            reader.join(peer.PATIENCE)
            self.assertFalse(reader.is_alive())
            stream.close()

    def test_requests_with_a_byte_changed(self):
        seed = 1994
        print("seed", seed)
        chance = random.Random(seed)
        message = bytearray(json.dumps({"jsonrpc": "2.0", "id": 1, "method": "problem/load",
                                        "params": {"problem": self.problem}}).encode())
        with self.daemon.connect() as changer:
            changer.greet()
            for k in range(60):
                changed = bytearray(message)
                changed[chance.randrange(len(changed))] = chance.choice([b for b in range(256) if b != 10])
                changer.send_raw(bytes(changed) + b"\n")
                changer.send({"jsonrpc": "2.0", "id": f"after {k}", "method": "action/do", "params": {"action": {"action": "iterate", "iterations": 0}}})
                self.assertIsNotNone(changer.answer(f"after {k}"))

    def test_more_requests_than_may_wait(self):
        with self.daemon.connect() as eager:
            eager.greet()
            eager.ask("problem/load", problem=self.problem)
            eager.ask("action/do", action={"action": "solve", "tolerance": 1e-300, "iterations": 1})
            for _ in range(1500):
                eager.start("action/do", action={"action": "solve"})
            codes = [eager.receive_answer().get("error", {}).get("code") for _ in range(1500)]
            self.assertIn(-32018, codes)
            self.assertTrue(set(codes) <= {None, -32018})


class Limits(unittest.TestCase):
    def test_each_limit_has_its_error(self):
        load = {"method": "problem/load", "problem": peer.problem_of("examples/throw.scene")}
        large = {"method": "problem/load", "problem": peer.problem_of("tests/wire/long_throw.scene")}
        for limit, most, code, requests in (
                ("operations", 100, -32012, [load]),
                ("unknowns", 20, -32014, [load]),
                ("samples", 10, -32013, [load, {"method": "sample", "times": [0, 0.5, 1, 1.5]}]),
                ("message", 2000, -32010, [load]),
                ("memory", 1000000, -32017, [large])):
            with self.subTest(limit):
                with peer.Daemon("optimizer", "stdio", [f"--limit-{limit}", str(most)]) as daemon:
                    connection = daemon.connect()
                    self.assertEqual(connection.greet()["limits"][limit], most)
                    for request in requests:
                        number = connection.start(**request)
                        answer = connection.receive_answer()
                    self.assertIn(answer["id"], (number, None))
                    self.assertEqual((answer["error"]["code"], answer["error"]["data"]["limit"]), (code, limit))

    def test_a_problem_that_is_too_fine_is_refused_where_it_is_and_takes_no_memory(self):
        problem = peer.problem_of("examples/throw.scene")
        start, end = problem["time"]

        def scoped(scope):
            return dict(problem, constraints=[dict(problem["constraints"][0], scope=scope), *problem["constraints"][1:]])

        knots = [start] * 4 + [start + (end - start) * k / (1 << 18) for k in range(1, 1 << 18)] + [end] * 4
        basis = dict(problem["dofs"][0]["basis"], knots=knots)
        too_fine = [(scoped({"kind": "every", "from": start, "to": end, "step": 1e-8}), "/problem/constraints/0/scope",
                     "more than 4000000 residuals"),
                    (scoped({"kind": "count", "from": start, "to": end, "count": 1 << 30}), "/problem/constraints/0/scope/count",
                     "an integer from 2 to 4000000"),
                    (dict(problem, dofs=[dict(problem["dofs"][0], basis=basis), *problem["dofs"][1:]]),
                     "/problem/dofs/0/basis/knots", "more than the limit of 131079")]
        unknowns = sum(len(dof["basis"]["knots"]) - 4 for dof in problem["dofs"]) + len(problem["parameters"])
        with peer.Daemon("optimizer", options=["--limit-unknowns", str(unknowns)]) as daemon:
            connection = daemon.connect()
            connection.greet()
            self.assertEqual(connection.ask("problem/load", problem=problem)["unknowns"], unknowns)
            held = daemon.resident_bytes()
            for method in ("problem/load", "problem/update"):
                for finer, path, words in too_fine:
                    error = connection.answer(connection.start(method, problem=finer))["error"]
                    self.assertEqual((error["code"], error["data"]), (-32602, {"path": path}))
                    self.assertIn(words, error["message"])
                more = dict(problem, parameters=[*problem["parameters"], {"name": "one more", "start": 0}])
                error = connection.answer(connection.start(method, problem=more))["error"]
                self.assertEqual((error["code"], error["data"]["limit"]), (-32014, "unknowns"))
            self.assertLess(daemon.resident_bytes() - held, 64 << 20)
            self.assertEqual(connection.ask("action/do", action={"action": "solve"})["status"], "converged")

    def test_a_refinement_is_held_to_the_limit_before_it_takes_memory(self):
        problem = peer.problem_of("examples/throw.scene")
        whole = {"action": "refine", "times": 20}
        part = {"action": "refine", "from": 0.013, "to": 0.4, "times": 20}
        with peer.Daemon("optimizer") as daemon:
            connection = daemon.connect()
            connection.greet()
            before = connection.ask("problem/load", problem=problem)["unknowns"]
            held = daemon.resident_bytes()
            for action in (whole, part, {"action": "refine", "times": 52}):
                error = connection.answer(connection.start("action/do", action=action))["error"]
                self.assertEqual((error["code"], error["data"]["limit"]), (-32014, "unknowns"), error)
            self.assertLess(daemon.resident_bytes() - held, 16 << 20)
            self.assertEqual(len(connection.ask("motion/get")["motion"]["dofs"][0]["coefficients"]),
                             len(problem["dofs"][0]["basis"]["knots"]) - 4)
        # The count is exact: one unknown less than a refinement makes is too few.
        for action in ({"action": "refine", "from": 0.013, "to": 0.4, "times": 3}, {"action": "refine", "times": 2}):
            with peer.Daemon("optimizer") as daemon:
                connection = daemon.connect()
                connection.greet()
                connection.ask("problem/load", problem=problem)
                connection.ask("action/do", action=action)
                made = sum(len(dof["coefficients"]) for dof in connection.ask("motion/get")["motion"]["dofs"])
                made += len(problem["parameters"])
            self.assertGreater(made, before)
            for most in (made, made - 1):
                with peer.Daemon("optimizer", options=["--limit-unknowns", str(most)]) as daemon:
                    connection = daemon.connect()
                    connection.greet()
                    connection.ask("problem/load", problem=problem)
                    answer = connection.answer(connection.start("action/do", action=action))
                    self.assertEqual("result" in answer, most == made, answer)

    def test_an_idle_session_ends_and_a_busy_one_does_not(self):
        with peer.Daemon("optimizer", "unix", ["--limit-idle", "0.9"]) as daemon:
            idle, stopped = daemon.connect(), daemon.connect()
            idle.greet()
            stopped.greet()
            stopped.send_raw(b'{"jsonrpc"')
            sentences = []
            for each in (idle, stopped):
                told = each.rest()
                self.assertEqual([m["error"]["code"] for m in told], [-32016])
                sentences.append(told[0]["error"]["message"])
                each.close()
            self.assertRegex(sentences[0], "without a request")
            self.assertRegex(sentences[1], "half-way, after 10 bytes, .* for 0.9 seconds")

    def test_what_the_end_of_the_input_cuts_short_is_told(self):
        asked = b'{"jsonrpc": "2.0", "id": 1, "method": "initialize", "params": {"protocol": 1}}'
        for transport in ("stdio", "unix"):
            for framing, end in (("lines", asked), ("lines", asked[:-1]), ("headers", peer.framed(asked, "headers")[:-1]),
                                 ("headers", b"Content-Le")):
                with peer.Daemon("symbolic", transport) as daemon:
                    with daemon.connect(framing) as connection:
                        connection.send_raw(peer.framed(asked.replace(b"1,", b"0,"), framing) + end)
                        connection.half_close()
                        told = {message["id"]: message for message in connection.rest()}
                        self.assertEqual(set(told), {0, 1 if end == asked else None})
                        if end == asked:
                            self.assertIn("once", told[1]["error"]["message"])
                        else:
                            self.assertEqual(told[None]["error"]["code"], -32700)

    def test_framings_are_not_mixed(self):
        asked = b'{"jsonrpc": "2.0", "id": 1, "method": "rpc.discover"}'
        with peer.Daemon("symbolic", "unix") as daemon:
            with daemon.connect("headers") as connection:
                connection.send_raw(peer.framed(asked, "headers") + b"{")
                told = next(m["error"] for m in connection.rest() if m["id"] is None)
                self.assertEqual(told["code"], -32700)
                self.assertRegex(told["message"], "found '{': this connection has headers")
            with daemon.connect("lines") as connection:
                connection.send_raw(asked + b"\n" + peer.framed(b"{}", "headers") + b"\n" + asked + b"\n")
                answers = [connection.receive() for _ in range(4)]
                told = [m["error"] for m in answers if m["id"] is None]
                self.assertEqual([error["code"] for error in told], [-32700, -32600])
                self.assertRegex(told[0]["message"], "found 'Content-Length: 2': this connection has one message a line")


if __name__ == "__main__":
    unittest.main()
