// SPDX-License-Identifier: Apache-2.0
#include <QtPlcRecording>

#include <algorithm>
#include <cstdio>

int main(int argc, char **argv)
{
    QPlcRecording recording;
    if (argc != 2 || !recording.open(QString::fromLocal8Bit(argv[1]))) {
        std::fprintf(stderr, "usage: largest_power FILE|FOLDER; %s\n", qPrintable(recording.errorString()));
        return 2;
    }
    QPlcRecordedRows rows(recording, {QStringLiteral("power")}, recording.begin(), recording.end());
    int count = 0;
    double largest = 0.0;  // [W]
    while (rows.next()) {
        if (!rows.quality(0).isGood())
            continue;
        largest = std::max(largest, rows.number(0));
        ++count;
    }
    std::printf("%d cycles, largest power %.17g W\n", count, largest);
    return rows.isValid() && rows.damages() == 0 ? 0 : 1;
}
