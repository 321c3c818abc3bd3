# SPDX-License-Identifier: Apache-2.0
"""A bad wire between two interfaces, in user space: delay, jitter, loss, duplication, another
order. Linux, root."""
import fcntl
import heapq
import os
import random
import select
import struct
import threading
import time

TUNSETIFF = 0x400454CA
IFF_TUN = 0x0001
IFF_NO_PI = 0x1000


def open_tun(name):
    """A TUN interface; it goes when the descriptor is closed, in whatever namespace it is then."""
    descriptor = os.open("/dev/net/tun", os.O_RDWR | os.O_NONBLOCK | os.O_CLOEXEC)
    fcntl.ioctl(descriptor, TUNSETIFF, struct.pack("16sH22x", name.encode(), IFF_TUN | IFF_NO_PI))
    return descriptor


class Wire(threading.Thread):
    """Carries packets between two TUN interfaces. The faults may be changed at any time: shares of
    0 ... 1, times in s."""

    def __init__(self, one, other, seed):
        super().__init__(daemon=True)
        self.ends = {one: other, other: one}
        self.random = random.Random(seed)
        self.waiting = []  # (due, number, where to, packet)
        self.number = 0
        self.held = {}
        self.stopped = False
        self.mend()

    def mend(self):
        self.delay = self.jitter = self.loss = self.duplicate = self.reorder = 0.0

    def run(self):
        while not self.stopped:
            pause = min(0.05, max(0.0, self.waiting[0][0] - time.monotonic())) if self.waiting else 0.05
            for descriptor in select.select(list(self.ends), [], [], pause)[0]:
                self.take(descriptor)
            self.deliver()

    def take(self, descriptor):
        try:
            packet = os.read(descriptor, 65536)
        except BlockingIOError:
            return
        if self.random.random() < self.loss:
            return
        target = self.ends[descriptor]
        if self.random.random() < self.reorder and target not in self.held:
            self.held[target] = packet
            return
        for _ in range(2 if self.random.random() < self.duplicate else 1):
            self.send(target, packet)
        if target in self.held:
            self.send(target, self.held.pop(target))

    def send(self, target, packet):
        due = time.monotonic() + self.delay + self.random.random() * self.jitter
        heapq.heappush(self.waiting, (due, self.number, target, packet))
        self.number += 1

    def deliver(self):
        while self.waiting and self.waiting[0][0] <= time.monotonic():
            _, _, target, packet = heapq.heappop(self.waiting)
            try:
                os.write(target, packet)
            except (BlockingIOError, OSError):
                pass  # an interface that is down, or full: lost

    def stop(self):
        self.stopped = True
        self.join()
