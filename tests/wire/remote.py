"""The client of test_network: python3 -m tests.wire.remote CERTIFICATES compiles the throw on one host, solves it on another."""
import os
import socket
import ssl
import sys

from tests.wire import peer


def connect(host, certificates):
    context = ssl.create_default_context(ssl.Purpose.SERVER_AUTH, cafile=os.path.join(certificates, "authority.pem"))
    context.load_cert_chain(os.path.join(certificates, "client.pem"), os.path.join(certificates, "client-key.pem"))
    plain = socket.create_connection((host, 7777))
    connection = peer.Peer(context.wrap_socket(plain, server_hostname=host), "headers")
    connection.greet()
    return connection


def main(certificates):
    symbolic, optimizer = connect("10.0.3.3", certificates), connect("10.0.4.3", certificates)
    with open(os.path.join(peer.SOURCE, "examples/throw.scene"), encoding="utf-8") as scene:
        compiled = symbolic.ask("scene/compile", text=scene.read())
    optimizer.ask("problem/load", problem=compiled["problem"])
    iterates = []
    outcome = optimizer.ask("action/do", progress=iterates.append, action={"action": "solve"})
    print(outcome["status"], outcome["iteration"], len(iterates))


if __name__ == "__main__":
    main(sys.argv[1])
