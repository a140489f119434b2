"""The conversations of this directory with the real daemons, over every transport and in both framings."""
import os
import time
import unittest

from tests.wire import peer
from tests.wire.conversation import all_conversations


def everything(daemon, data, framing, pieces):
    """All that the daemon answers to bytes sent in pieces, but for what times it took."""
    with daemon.connect(framing) as connection:
        for piece in pieces(data):
            connection.send_raw(piece)
        connection.half_close()
        return connection.rest()


def cut_at(k):
    def pieces(data):
        yield data[:k]
        time.sleep(0.0003)  # so that they arrive apart; where they do not, this cut is one that was tried elsewhere
        yield data[k:]
    return pieces


class Conversations(unittest.TestCase):
    def test_each_over_every_transport_and_in_both_framings(self):
        conversations = all_conversations()
        self.assertGreaterEqual(len(conversations), 4)
        for transport in peer.TRANSPORTS:
            for conversation in conversations:
                for framing in peer.FRAMINGS:
                    with self.subTest(f"{conversation.name} over {transport} by {framing}"):
                        with peer.Daemon(conversation.daemon, transport, conversation.options) as daemon:
                            with daemon.connect(framing) as connection:
                                self.assertIsNone(conversation.play(connection))
                            self.assertEqual(daemon.end(), 0)

    def test_a_stream_cut_at_every_byte_gives_the_same_answers(self):
        for conversation in all_conversations():
            if conversation.name not in ("beginning.conversation", "malformed.conversation"):
                continue  # the others are long, and differ in nothing that a cut could reach
            with peer.Daemon(conversation.daemon, "unix", conversation.options) as daemon:
                for framing in peer.FRAMINGS:
                    data = b"".join(peer.framed(message, framing) for _, message in conversation.sent())
                    whole = everything(daemon, data, framing, lambda data: [data])
                    self.assertGreaterEqual(len(whole), 9)
                    for k in range(1, len(data)):
                        found = everything(daemon, data, framing, cut_at(k))
                        self.assertCountEqual(map(str, found), map(str, whole), f"{conversation.name} {framing} {k}")

    def test_a_stream_that_ends_at_any_byte_is_answered_as_far_as_it_goes(self):
        conversation = next(c for c in all_conversations() if c.name == "beginning.conversation")
        with peer.Daemon(conversation.daemon, "unix") as daemon:
            for framing in peer.FRAMINGS:
                data = b"".join(peer.framed(message, framing) for _, message in conversation.sent())
                whole = [str(m) for m in everything(daemon, data, framing, lambda data: [data])]
                for k in range(0, len(data), 7):
                    found = [str(m) for m in everything(daemon, data[:k], framing, lambda data: [data])]
                    told = [message for message in found if "'id': None" in message and "'code': -32700" in message]
                    self.assertLessEqual(len(told), 1)  # what is cut short
                    found = [message for message in found if message not in told]
                    self.assertEqual(found, whole[:len(found)])
            self.assertEqual(daemon.end(), 0)


if __name__ == "__main__":
    unittest.main()
