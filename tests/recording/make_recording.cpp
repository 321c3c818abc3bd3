// SPDX-License-Identifier: Apache-2.0
// Makes a recording in the file that is the argument, and prints the digest of the flight.
#include "RecordedFlight.h"

#include <cstdio>

/// Anna sets the second of the values that the next cycle adopts.
static void tellNextValue(RecordedFlight *flight)
{
    qplc::RecordedText text;
    text.cycle = flight->number > 0 ? std::uint64_t(flight->number - 1) : 0;
    text.settings = flight->cycle.settingsGiven() + 2;
    text.topic = qplc::RecordedText::Command;
    flight->ring->addText(text,
                          R"({"by":"Anna","signal":"position_x","to":")" + QByteArray::number(flight->number) + "\"}");
}

int main(int argc, char **argv)
{
    RecordedFlight flight(1 << 20, 1 << 16);
    if (argc != 2 || !flight.begin(qplc::mcap::FileSink::create(QString::fromLocal8Bit(argv[1]), &flight.error))
        || !flight.start())
        return 2;
    for (int chunk = 0; chunk < 4; ++chunk) {
        tellNextValue(&flight);
        flight.step(200);
        flight.recorder.proceed(&flight.error);
        flight.recorder.save(false, &flight.error);
    }
    flight.cycle.stop();
    flight.ring->endTexts();
    if (flight.recorder.proceed(&flight.error) != qplc::PlantRecorder::Ended || !flight.recorder.finish(&flight.error))
        return 1;
    std::printf("%016llx\n", static_cast<unsigned long long>(flight.digest()));
    return 0;
}
