// SPDX-License-Identifier: Apache-2.0
#include "NodeOptions.h"

namespace soak {

namespace {

QCommandLineOption option(const char *name, const char *description, const char *valueName, const char *value)
{
    return QCommandLineOption(QString::fromLatin1(name), QString::fromLatin1(description),
                              QString::fromLatin1(valueName), QString::fromLatin1(value));
}

bool readInteger(QPlcCoreApplication &application, const char *name, qint64 minimum, qint64 maximum, qint64 *result)
{
    return application.integer(QString::fromLatin1(name), minimum, maximum, result);
}

}  // namespace

void addShapeOptions(QPlcCoreApplication &application)
{
    application.addOption(option("nodes", "Nodes of the plant.", "N", "12"));
    application.addOption(option("signal-count", "Signals that each node writes.", "N", "100"));
    application.addOption(option("hold", "Cycles that a drive is held when its writer is silent.", "CYCLES", "3"));
    application.addOption(option("life", "Number of this process among those of its kind.", "N", "1"));
    application.addOption(option("history", "File to which this process writes what it sees and does.", "FILE", ""));
}

void addNodeOptions(QPlcCoreApplication &application)
{
    addShapeOptions(application);
    application.addOption(option("node", "Number of this node.", "N", "0"));
}

bool readShapeOptions(QPlcCoreApplication &application, NodeOptions *options, HistoryFile *history)
{
    qint64 nodes = 0, signalCount = 0, hold = 0, life = 0;
    if (!readInteger(application, "nodes", 2, 254, &nodes)
        || !readInteger(application, "signal-count", GroupHead + 1, 1000, &signalCount)
        || !readInteger(application, "hold", 1, 100, &hold) || !readInteger(application, "life", 1, 1'000'000, &life))
        return false;
    options->shape = {int(nodes), int(signalCount), int(hold), 0};
    options->life = quint32(life);
    QString error;
    if (history->open(application.value(QStringLiteral("history")), &error))
        return true;
    application.usageError(error);
    return false;
}

bool readNodeOptions(QPlcCoreApplication &application, NodeOptions *options, HistoryFile *history)
{
    qint64 node = 0;
    if (!readInteger(application, "node", 0, 253, &node) || !readShapeOptions(application, options, history))
        return false;
    options->node = int(node);
    return true;
}

QStringList shapeArguments(const PlantShape &shape, quint32 life, const QString &historyFile)
{
    return {QStringLiteral("--nodes"),        QString::number(shape.nodes),
            QStringLiteral("--signal-count"), QString::number(shape.signalCount),
            QStringLiteral("--hold"),         QString::number(shape.hold),
            QStringLiteral("--life"),         QString::number(life),
            QStringLiteral("--history"),      historyFile};
}

}  // namespace soak
