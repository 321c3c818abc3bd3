// SPDX-License-Identifier: Apache-2.0
#include "BenchOptions.h"

namespace {

const QStringList transports{QStringLiteral("udp"), QStringLiteral("udp-multicast"), QStringLiteral("tcp"),
                             QStringLiteral("local"), QStringLiteral("inprocess")};

void addOption(QPlcCoreApplication &application, const char *name, const char *description, const char *valueName,
               const char *value)
{
    application.addOption(QCommandLineOption(QString::fromLatin1(name), QString::fromLatin1(description),
                                             QString::fromLatin1(valueName), QString::fromLatin1(value)));
}

bool readInteger(QPlcCoreApplication &application, const char *option, qint64 minimum, qint64 maximum, int *result)
{
    qint64 number = 0;
    if (!application.integer(QString::fromLatin1(option), minimum, maximum, &number))
        return false;
    *result = int(number);
    return true;
}

bool refuse(QPlcCoreApplication &application, const QString &text)
{
    application.usageError(text);
    return false;
}

bool isPeriodPossible(QPlcCoreApplication &application, const BenchOptions &options)
{
    return options.isBackToBack() || options.periodUs >= 10
        || refuse(application,
                  QStringLiteral("--period-us %1: use 10 or more, or 0 for back to back").arg(options.periodUs));
}

bool isTablePossible(QPlcCoreApplication &application, const BenchOptions &options)
{
    const int count = options.slaves * (options.inputs + options.outputs);
    return count <= QPlcSignalTable::MaximumSignals
        || refuse(application,
                  QStringLiteral("%1 signals are too many for a table of %2; use fewer slaves, or fewer --out")
                      .arg(count)
                      .arg(QPlcSignalTable::MaximumSignals));
}

}  // namespace

QStringList BenchOptions::slaveArguments(int index, const QString &address, const QString &keysFile) const
{
    return {QStringLiteral("--bench-keys"), keysFile,
            QStringLiteral("--slave"),      QString::number(index),
            QStringLiteral("--master"),     address,
            QStringLiteral("--in"),         QString::number(inputs),
            QStringLiteral("--out"),        QString::number(outputs),
            QStringLiteral("--spin-us"),    QString::number(spinUs)};
}

bool readBenchOptions(QPlcCoreApplication &application, BenchOptions *options)
{
    application.setDescription(
        QStringLiteral("Measures the cycle of one master process with N slave processes and prints one line of JSON."));
    application.setExamples(
        {QStringLiteral("taskset -c 0 qtplc_cycle_bench --transport udp --slaves 10"),
         QStringLiteral("timeout -s KILL 60 chrt -f 49 qtplc_cycle_bench --slaves 10 --period-us 1000")});
    addOption(application, "transport", "udp, udp-multicast, tcp, local or inprocess.", "KIND", "udp");
    addOption(application, "slaves", "Number of slaves.", "N", "1");
    addOption(application, "in", "Real32 signals from the master to each slave.", "N", "3");
    addOption(application, "out", "Real32 signals from each slave to the master.", "N", "32");
    addOption(application, "description", "Characters of the description of each signal.", "N", "0");
    addOption(application, "period-us", "Period [us]; 0: the next cycle as soon as all answers are there.", "P", "0");
    addOption(application, "seconds", "Measured time.", "S", "1");
    addOption(application, "warmup", "Time before it.", "S", "0.2");
    addOption(application, "idle-latency-us",
              "Time that processors may need to wake up [us]; -1: as the system is set.", "US", "-1");
    addOption(application, "spin-us", "Time that master and slaves look again before they sleep [us].", "US", "0");
    application.addOption(QCommandLineOption(
        QStringLiteral("sealed"), QStringLiteral("Master and slaves have keys: frames are sealed (udp, tcp).")));
    addOption(application, "bench-keys", "With --slave: file with its key.", "FILE", "");
    addOption(application, "slave", "Be a slave: what the master starts.", "INDEX", "-1");
    addOption(application, "master", "With --slave: where the master is.", "ADDRESS", "");
    if (!application.parseOptions())
        return false;
    options->master = application.value(QStringLiteral("master"));
    options->keys = application.value(QStringLiteral("bench-keys"));
    options->isSealed = application.isSet(QStringLiteral("sealed"));
    options->transport = application.value(QStringLiteral("transport"));
    if (!transports.contains(options->transport))
        return refuse(application,
                      QStringLiteral("--transport %1: use one of %2")
                          .arg(options->transport, transports.join(QStringLiteral(", "))));
    if (options->isSealed && options->transport != QLatin1String("udp") && options->transport != QLatin1String("tcp"))
        return refuse(
            application,
            QStringLiteral("--sealed: frames over %1 are not sealed; use udp or tcp").arg(options->transport));
    return readInteger(application, "slave", -1, 249, &options->slaveIndex)
        && readInteger(application, "slaves", 1, 250, &options->slaves)
        && readInteger(application, "in", 1, 1000, &options->inputs)
        && readInteger(application, "out", 1, QPlcSignalTable::MaximumSignals - 1, &options->outputs)
        && readInteger(application, "description", 0, 1000, &options->description)
        && readInteger(application, "period-us", 0, 10'000'000, &options->periodUs)
        && readInteger(application, "idle-latency-us", -1, 1'000'000, &options->idleLatencyUs)
        && readInteger(application, "spin-us", 0, 1000, &options->spinUs)
        && application.number(QStringLiteral("seconds"), 0.01, 86400.0, &options->seconds)
        && application.number(QStringLiteral("warmup"), 0.0, 3600.0, &options->warmup)
        && isPeriodPossible(application, *options) && isTablePossible(application, *options);
}
