// SPDX-License-Identifier: Apache-2.0
// Makes a recording in the file that is the argument, and prints the digest of the flight.
#include "RecordedFlight.h"

#include <cstdio>

int main(int argc, char **argv)
{
    RecordedFlight flight;
    if (argc != 2 || !flight.begin(qplc::mcap::FileSink::create(QString::fromLocal8Bit(argv[1]), &flight.error))
        || !flight.start())
        return 2;
    for (int chunk = 0; chunk < 4; ++chunk) {
        flight.step(200);
        flight.recorder.proceed(&flight.error);
        flight.recorder.save(false, &flight.error);
    }
    flight.cycle.stop();
    if (flight.recorder.proceed(&flight.error) != qplc::PlantRecorder::Ended || !flight.recorder.finish(&flight.error))
        return 1;
    std::printf("%016llx\n", static_cast<unsigned long long>(flight.digest()));
    return 0;
}
