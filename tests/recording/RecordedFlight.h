// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "RingFixtures.h"
#include "node/cycle/MasterCycle.h"
#include "node/cycle/RingDescription.h"
#include "recording/PlantRecorder.h"

#include <QtCore/QTemporaryDir>

#include <algorithm>
#include <cmath>

/// A master without nodes, whose program turns the clock and sets the signals, and its recorder.
struct RecordedFlight
{
    /// \param more  of the signal table, behind ini()
    explicit RecordedFlight(std::size_t capacity = 1 << 20, std::size_t textCapacity = 0, const QByteArray &more = {})
        : table(QPlcSignalTable::fromIni(ini() + more))
    {
        description.plant = "kite";
        description.version = "test";
        description.session = 0xabcdef;
        description.phase = 1;
        description.period = 10'000'000;
        description.clock = "external";
        description.table = ini() + more;
        static int count = 0;
        ringFile = qplc::RingMemory::folder() + "/qtplc-test-" + QByteArray::number(::getpid()) + "-flight-"
            + QByteArray::number(++count);
        ring = std::make_shared<qplc::RecordRing>();
        if (!ring->create(ringFile, capacity, description.toText(), &error, textCapacity)
            || !recorder.attach(ringFile, &error) || !folder.isValid())
            qFatal("%s", qPrintable(error));
        phase.period = std::chrono::milliseconds(10);
        phase.clock = QPlcClock::external();
        phase.timeSignal = 0;
        phase.ring = ring;
    }
    ~RecordedFlight() { QFile::remove(QFile::decodeName(ringFile)); }
    RecordedFlight(const RecordedFlight &) = delete;
    RecordedFlight &operator=(const RecordedFlight &) = delete;

    static QByteArray ini()
    {
        return "[time]\ntype = DateTime\n[position.x]\ntype = Real64\nunit = m\ndescription = \"of the kite\"\n"
               "[force]\ntype = Real32[3]\nunit = N\n[position_x]\ntype = Int16\n[phase]\ntype = String(12)\n"
               "[on]\ntype = UInt8\n";
    }
    bool begin(const QString &name = "flight.mcap")
    {
        file = folder.filePath(name);
        return begin(qplc::mcap::FileSink::create(file, &error));
    }
    bool begin(std::unique_ptr<qplc::mcap::FileSink> sink) { return sink && recorder.begin(std::move(sink), &error); }
    bool start() { return cycle.start(phase); }
    void step(int cycles = 1)
    {
        for (int i = 0; i < cycles; ++i, ++number) {
            const double x = std::sin(0.1 * number);
            cycle.setValues({{1, QPlcValue(x), QPlcQuality::Good},
                             {3, QPlcValue(qint16(number)), QPlcQuality::Good},
                             {4, QPlcValue(QString(number % 7, QLatin1Char('a'))), QPlcQuality::Good}});
            cycle.step();
        }
    }
    /// Records \a cycles with a chunk for each hundred of them. \return the file
    QString record(int cycles, bool isFinished = true)
    {
        const auto require = [this](bool isDone) {
            if (!isDone)
                qFatal("%s", qPrintable(error));
        };
        require(begin() && start());
        for (int i = 0; i < cycles; i += 100) {
            step(std::min(100, cycles - i));
            recorder.proceed(&error);
            require(recorder.save(false, &error));
        }
        if (!isFinished)
            return file;
        cycle.stop();
        recorder.proceed(&error);
        require(recorder.finish(&error));
        return file;
    }
    quint64 digest() const { return cycle.statistics().imageDigest; }

    qplc::RingDescription description;
    QPlcSignalTable table;
    QTemporaryDir folder;
    QByteArray ringFile;
    QString file;
    QString error;
    std::shared_ptr<qplc::RecordRing> ring;
    qplc::CyclicHub hub;
    qplc::MasterCycle cycle{table, hub, false};
    qplc::MasterCycle::Phase phase;
    qplc::PlantRecorder recorder;
    int number = 0;
};
