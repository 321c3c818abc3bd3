// SPDX-License-Identifier: Apache-2.0
// qtplc_can_cycle: a CAN driver in a cycle and a partner process exchange frames; prints one line
// of JSON. Rounds with and without CAN take turns.
#include "CanCycles.h"
#include "CanPartner.h"
#include "QPlcCoreApplication.h"

#include <QtCore/QJsonDocument>
#include <QtCore/QProcess>
#include <QtCore/QThread>

#include <cstdio>

namespace {

struct Options
{
    QString device;
    int frames = 20;
    qint64 period = 1'000'000;  // [ns]
    double seconds = 10.0;
    double round = 2.0;
};

bool readOptions(QPlcCoreApplication &application, Options *options)
{
    application.setDescription(QStringLiteral(
        "Exchanges frames with a partner process over a CAN bus in each cycle, and prints one line of JSON."));
    application.setExamples({QStringLiteral("qtplc_can_cycle --seconds 60"),
                             QStringLiteral("qtplc_can_cycle --device vcan0 --period-us 20000")});
    const auto add
        = [&application](const char *name, const char *description, const char *valueName, const char *value) {
              application.addOption(QCommandLineOption(QString::fromLatin1(name), QString::fromLatin1(description),
                                                       QString::fromLatin1(valueName), QString::fromLatin1(value)));
          };
    add("device", "The bus.", "DEVICE", "fake:bench");
    add("frames", "Frames in each cycle, both ways.", "N", "20");
    add("period-us", "Period of the cycles [us].", "P", "1000");
    add("seconds", "Time with CAN; as much goes by without.", "S", "10");
    add("round", "Time of a round.", "S", "2");
    application.addOption(
        QCommandLineOption(QStringLiteral("partner"), QStringLiteral("Be the partner: what the benchmark starts.")));
    qint64 frames = 0;
    qint64 period = 0;
    if (!application.parseOptions() || !application.integer(QStringLiteral("frames"), 1, 200, &frames)
        || !application.integer(QStringLiteral("period-us"), 100, 1'000'000, &period)
        || !application.number(QStringLiteral("seconds"), 0.1, 86400.0, &options->seconds)
        // Counts of frames have 24 bits.
        || !application.number(QStringLiteral("round"), 0.1, 1600.0, &options->round))
        return false;
    options->device = application.value(QStringLiteral("device"));
    options->frames = int(frames);
    options->period = period * 1000;
    return true;
}

bool fail(const QString &error)
{
    QPlcCoreApplication::printError(error);
    return false;
}

void sleep(double seconds)
{
    QThread::msleep(static_cast<unsigned long>(seconds * 1e3));
}

// One round with CAN; adds the figures of the partner to `sums`.
bool runWithCan(const Options &options, CanCycles &cycles, QJsonObject *sums)
{
    QProcess partner;
    partner.setProcessChannelMode(QProcess::ForwardedErrorChannel);
    partner.start(QCoreApplication::applicationFilePath(),
                  {QStringLiteral("--partner"), QStringLiteral("--device"), options.device, QStringLiteral("--frames"),
                   QString::number(options.frames), QStringLiteral("--period-us"),
                   QString::number(options.period / 1000)});
    if (!partner.waitForReadyRead())
        return fail(QStringLiteral("the partner process does not start"));
    partner.readAllStandardOutput();
    if (!cycles.begin(true))
        return fail(cycles.errorString());
    sleep(options.round);
    partner.closeWriteChannel();
    const bool isFinished = partner.waitForFinished();
    cycles.end();
    if (!isFinished || partner.exitCode() != 0)
        return fail(QStringLiteral("the partner process has failed"));
    const QJsonObject fields = QJsonDocument::fromJson(partner.readAllStandardOutput()).object();
    for (auto field = fields.begin(); field != fields.end(); ++field)
        sums->insert(field.key(), sums->value(field.key()).toDouble() + field.value().toDouble());
    // All that it has sent has to have arrived.
    sums->insert(QStringLiteral("arrived"),
                 sums->value(QStringLiteral("arrived")).toDouble() + double(cycles.received()));
    return true;
}

bool run(const Options &options)
{
    CanCycles cycles(options.device, options.frames, options.period);
    QJsonObject sums;
    for (double time = 0.0; time < options.seconds; time += options.round) {
        if (!cycles.begin(false))
            return fail(cycles.errorString());
        sleep(options.round);
        cycles.end();
        if (!runWithCan(options, cycles, &sums))
            return false;
    }
    QJsonObject result = cycles.result();
    const auto sum = [&](const char *a) { return sums.value(QLatin1String(a)).toDouble(); };
    const auto here = [&](const char *a) { return result.value(QLatin1String(a)).toDouble(); };
    result.insert(QStringLiteral("frames_in"), sum("arrived"));
    result.insert(QStringLiteral("frames_out"), sum("received"));
    result.insert(QStringLiteral("lost"), sum("lost") + sum("sent") - sum("arrived"));
    result.insert(QStringLiteral("unsent"), sum("unsent") + here("unsent_here"));
    result.insert(QStringLiteral("reordered"), sum("reordered") + here("reordered_here"));
    std::puts(QJsonDocument(result).toJson(QJsonDocument::Compact).constData());
    return true;
}

}  // namespace

int main(int argc, char **argv)
{
    QPlcCoreApplication application(argc, argv);
    Options options;
    if (!readOptions(application, &options))
        return application.exitCode();
    if (!application.isSet(QStringLiteral("partner")))
        return run(options) ? QPlcCoreApplication::Success : QPlcCoreApplication::Failure;
    CanPartner partner(options.device, options.frames, options.period);
    if (!partner.run()) {
        QPlcCoreApplication::printError(partner.errorString());
        return QPlcCoreApplication::Failure;
    }
    std::puts(QJsonDocument(partner.result()).toJson(QJsonDocument::Compact).constData());
    return QPlcCoreApplication::Success;
}
