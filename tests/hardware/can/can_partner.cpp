// SPDX-License-Identifier: Apache-2.0
// can_partner DEVICE: sends each data frame back with the next id, until it gets the id 0x7FF. Says
// "ready" when it is on the bus.
#include "hardware/can/CanBus.h"

#include <array>
#include <cstdio>
#include <poll.h>

int main(int argc, char **argv)
{
    QString error;
    const auto bus = argc == 2 ? qplc::CanBus::make(QString::fromLocal8Bit(argv[1]), &error) : nullptr;
    qplc::CanBus::Options options;
    options.receivesAll = true;
    if (!bus || !bus->open(options)) {
        std::fprintf(stderr, "%s\n", qPrintable(bus ? bus->errorString() : error));
        return 1;
    }
    std::puts("ready");
    std::fflush(stdout);
    std::array<qplc::CanFrame, 64> frames;
    for (;;) {
        pollfd descriptor{bus->descriptor(), POLLIN, 0};
        poll(&descriptor, 1, 1000);
        const int count = bus->receive(frames.data(), int(frames.size()));
        for (int i = 0; i < count; ++i) {
            if (frames[std::size_t(i)].id == qplc::CanFrame::StandardIds)
                return 0;
            ++frames[std::size_t(i)].id;
        }
        if (count < 0 || bus->send(frames.data(), count) < 0)
            return 1;
    }
}
