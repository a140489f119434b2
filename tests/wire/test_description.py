"""PROTOCOL.md, the OpenRPC documents and the daemons say the same."""
import json
import os
import re
import tempfile
import unittest

from tests.wire import peer, schema
from tests.wire.conversation import Conversation, all_conversations

GENERAL = ["initialize", "shutdown", "exit", "$/cancelRequest", "rpc.discover"]


def protocol():
    with open(os.path.join(peer.SOURCE, "protocol", "PROTOCOL.md"), encoding="utf-8") as file:
        return file.read()


class Description(unittest.TestCase):
    def setUp(self):
        self.described = {name: schema.document(name + ".openrpc.json") for name in ("symbolic", "optimizer")}

    def test_methods_and_limits_are_those_of_the_daemons(self):
        text = protocol()
        for name, document in self.described.items():
            with peer.Daemon(name) as daemon:
                connection = daemon.connect()
                greeting = connection.greet()
                self.assertEqual(connection.ask("rpc.discover"), document)
            methods = [method["name"] for method in document["methods"]]
            self.assertEqual(methods, GENERAL + greeting["methods"])
            for method in methods:
                self.assertIn(f"`{method}`", text)
            table = dict(re.findall(r"^\| `(\w+)` \| -\d+ \| (\d+) \|", text, re.M))
            self.assertEqual({limit: int(most) for limit, most in table.items()}, greeting["limits"])
            self.assertTrue(all(isinstance(most, int) for most in greeting["limits"].values()), greeting["limits"])

    def test_a_description_refers_to_nothing_outside_it(self):
        for name, document in self.described.items():
            found = set(schema.references(document))
            self.assertIn("#/components/schemas/problem", found)
            for reference in found:
                self.assertTrue(reference.startswith("#/"), reference)
                self.assertIsInstance(schema.resolved(reference, document)[0], dict)

    def test_error_codes_are_those_of_the_source(self):
        with open(os.path.join(peer.SOURCE, "protocol", "rpc.h"), encoding="utf-8") as file:
            source = {name: int(code) for name, code in re.findall(r"^  (\w+) = (-\d+),", file.read(), re.M)}
        self.assertEqual(len(source), 21)
        for document in self.described.values():
            errors = document["components"]["errors"]
            self.assertEqual({name: error["code"] for name, error in errors.items()}, source)
            for method in document["methods"]:
                for error in method.get("errors", []):
                    self.assertIn(error["$ref"].removeprefix("#/components/errors/"), errors)
        told = {int(code) for code in re.findall(r"\| (-\d+) \|", protocol())}
        self.assertEqual(told, set(source.values()))

    def test_what_is_sent_and_answered_is_as_described(self):
        answered = set()
        for conversation in all_conversations():
            with tempfile.TemporaryDirectory() as directory:
                record = os.path.join(directory, "record.jsonl")
                with peer.Daemon(conversation.daemon, "stdio", ["--record", record]) as daemon:
                    self.assertIsNone(conversation.play(daemon.connect()))
                    self.assertEqual(daemon.end(), 0)
                with open(record, encoding="utf-8") as lines:
                    messages = [json.loads(line) for line in lines]
            answered |= self.judge(conversation, messages)
        everything = {m["name"] for d in self.described.values() for m in d["methods"] if "result" in m}
        everything.add("$/progress")
        self.assertEqual(everything - answered, set())

    def judge(self, conversation, messages):
        document = self.described[conversation.daemon]
        methods = {method["name"]: method for method in document["methods"]}
        asked, answered = {}, set()
        for entry in messages:
            message = entry.get("message")
            if not isinstance(message, dict):
                continue
            if entry["from"] == "peer" and "method" in message and not isinstance(message.get("id"), list):
                asked[message.get("id")] = message
            elif entry["from"] == "daemon" and "method" in message:
                described = {each["name"]: each for each in document["x-notifications"]}[message["method"]]
                params = {param["name"]: param for param in described["params"]}
                self.assertLessEqual(set(message["params"]), set(params))
                for name, param in params.items():
                    self.assertTrue(name in message["params"] or not param.get("required"), name)
                    if name in message["params"]:
                        self.assertIsNone(schema.fault(message["params"][name], param["schema"], document), name)
                answered.add(message["method"])
            elif entry["from"] == "daemon" and "result" in message:
                request = asked[message["id"]]
                method = methods[request["method"]]
                answered.add(method["name"])
                described = method.get("result", {"schema": {"maxProperties": 0}})  # of a notification with an id
                wrong = schema.fault(message["result"], described["schema"], document)
                self.assertIsNone(wrong, request["method"])
                params = request.get("params", {})
                known = {param["name"]: param for param in method["params"]}
                self.assertLessEqual(set(params), set(known))
                for name, param in known.items():
                    self.assertTrue(name in params or not param.get("required"), name)
                    if name in params:
                        self.assertIsNone(schema.fault(params[name], param["schema"], document), name)
        return answered

    def test_the_printed_conversations_are_some(self):
        found = re.findall(r"```conversation\n(.*?)```", protocol(), re.S)
        self.assertEqual(len(found), 2)
        for printed in found:
            self.play(printed)

    def play(self, printed):
        with tempfile.TemporaryDirectory() as directory:
            file = os.path.join(directory, "printed.conversation")
            with open(file, "w", encoding="utf-8") as out:
                out.write("# daemon: optimizer\n" + printed)
            conversation = Conversation(file)
            with peer.Daemon("optimizer") as daemon:
                self.assertIsNone(conversation.play(daemon.connect()))
                self.assertEqual(daemon.end(), 0)


if __name__ == "__main__":
    unittest.main()
