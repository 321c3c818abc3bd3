# SPDX-License-Identifier: Apache-2.0
"""The programs that are compared: ours, and reference programs with the same command line in a
folder of their own."""
import os
import re
from dataclasses import dataclass
from pathlib import Path

REFERENCE, SECOND = "udp/blocking", "zmq/router"
TRANSPORTS = ("udp", "udp-multicast", "tcp", "local", "inprocess")

# name, file, most slaves
PEERS = (
    ("udp/blocking", "peer_udp", 64),
    ("udp/mmsg", "peer_udp", 64),
    ("udp/multicast", "peer_udp", 64),
    ("tcp/epoll", "peer_tcp", 64),
    ("unix/seqpacket", "peer_local", 64),
    ("shm/futex", "peer_local", 64),
    ("qt/notifier", "peer_qt", 64),
    ("qt/udp", "peer_qt", 64),
    ("qt/tcp", "peer_qt", 64),
    ("zmq/router", "peer_zmq", 64),
    ("cyclone/reliable", "peer_cyclone", 64),
    ("fastdds/udp", "peer_fastdds", 64),
    ("lcm/per-slave", "peer_lcm", 10),
)


@dataclass(frozen=True)
class Program:
    name: str
    command: tuple
    most: int

    @property
    def is_ours(self):
        return self.name.startswith("qtplc/")


def own_programs(bench, wanted):
    programs = [Program(f"qtplc/{transport}", (str(bench), "--transport", transport), 250) for transport in TRANSPORTS]
    return [program for program in programs if re.search(wanted, program.name)]


def peer_programs(folder, wanted):
    """Those in a folder that were built."""
    if folder is None:
        return []
    found = []
    for name, file, most in PEERS:
        path = Path(folder) / file
        if os.access(path, os.X_OK) and re.search(wanted, name):
            found.append(Program(name, (str(path), "--variant", name.split("/")[1]), most))
    return found
