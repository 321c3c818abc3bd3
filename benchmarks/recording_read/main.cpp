// SPDX-License-Identifier: Apache-2.0
// recording_read FOLDER [DAYS]: makes a recording of 420 signals at 10 Hz in FOLDER, if that has
// none yet, and prints how long it takes to open it, to find a moment, to read one signal over an
// hour, and to get the extremes of all days. DAYS: default 1. Ten days take 11 GB.
#include "recording/McapWriter.h"
#include "recording/Recording.h"

#include <QtCore/QCoreApplication>
#include <QtCore/QDir>

#include <chrono>
#include <cmath>
#include <cstdio>

namespace {

using namespace qplc;

constexpr int Signals = 420;
constexpr RecordedTime Second = 1'000'000'000;
constexpr RecordedTime Period = Second / 10;
constexpr std::uint64_t CyclesOfAChunk = 10;  // a recorder writes one each second
constexpr std::uint64_t CyclesOfAFile = 36'000;
constexpr RecordedTime Start = RecordedTime(1'700'000'000) * Second;
constexpr int Pixels = 2000;  // of a wide plot

double valueAt(int signal, std::uint64_t cycle)
{
    const double t = 0.1 * double(cycle);
    return std::sin(t / (1.0 + 0.37 * signal)) * signal + 0.01 * double((cycle * 2654435761U) >> 22 & 1023U);
}

/// \return false when a file cannot be written
bool makeFile(const QString &name, const RingDescription &description, std::uint64_t first, std::uint64_t end,
              QString *error)
{
    const QPlcSignalTable table = QPlcSignalTable::fromIni(description.table);
    PlantMessage message(table);
    ProcessImage image(table);
    overview::Builder overview(image);
    std::unique_ptr<mcap::FileSink> sink = mcap::FileSink::create(name, error);
    if (!sink)
        return false;
    mcap::Writer writer(std::move(sink));
    if (!writer.begin("QtPLC", error)
        || !writer.addAttachment("recording.txt", "text/plain", description.toText(), std::uint64_t(Start), error))
        return false;
    const std::uint16_t plant
        = writer.addChannel("/plant", "ros1", PlantMessage::schemaName(), "ros1msg", message.schema());
    for (int i = 0; i < Signals; ++i)
        image.setQuality(QPlcSignalIndex(i), QPlcQuality::Good);
    QByteArray body;
    for (std::uint64_t cycle = first; cycle < end; ++cycle) {
        for (int i = 0; i < Signals; ++i)
            storeLittle(float(valueAt(i, cycle)), image.data() + image.offset(QPlcSignalIndex(i)));
        const auto time = std::uint64_t(Start) + cycle * std::uint64_t(Period);
        message.encode({cycle, 0, 0, 0}, image.data(), &body);
        overview.add(cycle, Start, image.data());
        writer.addMessage(plant, std::uint32_t(cycle), time, time, body.constData(), std::size_t(body.size()));
        if ((cycle + 1) % CyclesOfAChunk == 0 && !writer.flush(error))
            return false;
    }
    return writer.flush(error)
        && writer.addAttachment(overview::Name, overview::MediaType, overview.bytes(), std::uint64_t(Start), error)
        && writer.finish(error);
}

bool makeRecording(const QDir &folder, std::uint64_t cycles, QString *error)
{
    RingDescription description;
    description.plant = QStringLiteral("power station");
    description.version = QStringLiteral("benchmark");
    description.session = 1;
    description.phase = 1;
    description.period = Period;
    description.clock = QStringLiteral("real-time");
    for (int i = 0; i < Signals; ++i)
        description.table += "[s" + QByteArray::number(i) + "]\ntype = Real32\n";
    for (std::uint64_t first = 0; first < cycles; first += CyclesOfAFile) {
        const QString name = QStringLiteral("%1.mcap").arg(first, 10, 10, QLatin1Char('0'));
        if (!makeFile(folder.filePath(name), description, first, std::min(first + CyclesOfAFile, cycles), error))
            return false;
    }
    return true;
}

double secondsOf(const std::function<void()> &work)
{
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// \return the largest difference from the formula; -1: cycles are missing
double readAll(Recording &recording, int signal, RecordedTime begin, RecordedTime end)
{
    RecordedRows rows(recording, {signal}, begin, end);
    double difference = 0.0;
    auto cycle = std::uint64_t((begin - Start + Period - 1) / Period);
    for (; rows.next(); ++cycle) {
        if (rows.cycle().number != cycle)
            return -1.0;
        difference = std::max(difference, std::abs(rows.number(0) - double(float(valueAt(signal, cycle)))));
    }
    return RecordedTime(cycle) * Period + Start > end ? difference : -1.0;
}

int measure(Recording &recording, double openTime)
{
    const RecordedTime middle = recording.begin() + (recording.end() - recording.begin()) / 2;
    const RecordedTime end = std::min(middle + 3600 * Second, recording.end());
    bool isFound = false;
    const double seek = secondsOf([&] {
        RecordedRows rows(recording, {217}, middle, recording.end());
        isFound = rows.next() && rows.time() - middle < Period;
    });
    double difference = -1.0;
    const double hour = secondsOf([&] { difference = readAll(recording, 217, middle, end); });
    std::vector<overview::Bucket> buckets;
    const double all
        = secondsOf([&] { buckets = recording.overview(217, 0, recording.begin(), recording.end() + Period, Pixels); });
    bool isCovered = true;
    for (const overview::Bucket &bucket : buckets)
        isCovered = isCovered && (bucket.flags & overview::HasValue);
    std::printf("%.2f days, %zu files, %.2f GB\n",
                double(recording.end() - recording.begin() + Period) / double(86400 * Second), recording.files().size(),
                double(recording.bytes()) * 1e-9);
    std::printf("open %.1f ms, seek %.1f ms, one signal over %.2f h %.1f ms, overview of %d intervals %.1f ms\n",
                1e3 * openTime, 1e3 * seek, double(end - middle) / double(3600 * Second), 1e3 * hour, Pixels,
                1e3 * all);
    if (isFound && isCovered && difference >= 0.0 && difference < 1e-9)
        return 0;
    std::fprintf(stderr, "what was read is not what was written\n");
    return 1;
}

}  // namespace

int main(int argc, char **argv)
{
    const QCoreApplication application(argc, argv);
    const QStringList arguments = QCoreApplication::arguments();
    bool isNumber = true;
    const double days = arguments.size() > 2 ? arguments.at(2).toDouble(&isNumber) : 1.0;
    if (arguments.size() < 2 || arguments.size() > 3 || !isNumber || !(days > 0.0 && days <= 100.0)) {
        std::fprintf(stderr, "usage: recording_read FOLDER [DAYS], DAYS up to 100\n");
        return 2;
    }
    const QDir folder(arguments.at(1));
    QString error;
    const bool isThere = !folder.entryList({QStringLiteral("*.mcap")}, QDir::Files).isEmpty();
    if (!QDir().mkpath(folder.path())
        || (!isThere && !makeRecording(folder, std::uint64_t(days * 864'000.0), &error))) {
        std::fprintf(stderr, "%s\n", qPrintable(error));
        return 1;
    }
    Recording recording;
    bool isOpen = false;
    const double openTime = secondsOf([&] { isOpen = recording.open({folder.path()}, &error); });
    if (!isOpen) {
        std::fprintf(stderr, "%s\n", qPrintable(error));
        return 1;
    }
    return measure(recording, openTime);
}
