// SPDX-License-Identifier: Apache-2.0
#include "Commands.h"
#include "TerminalText.h"
#include "WaitLine.h"
#include "node/session/MasterFinder.h"

#include <QtCore/QJsonArray>
#include <QtCore/QTimer>

#include <cmath>

namespace tools {

namespace {

using qplc::FoundMaster;

QString place(const FoundMaster &master)
{
    return master.isLocal ? QStringLiteral("this computer") : QStringLiteral("network");
}

void printMasters(const QVector<FoundMaster> &masters)
{
    TextTable table;
    for (const char *title : {"address", "name", "where", "security", "table"})
        table.addColumn(QString::fromLatin1(title));
    for (const FoundMaster &master : masters)
        table.addRow({master.address, master.name, place(master),
                      master.isSecured ? QStringLiteral("secured") : QStringLiteral("insecure"),
                      QPlcMessage::fromHex64(master.tableHash)});
    table.print();
}

void printMastersAsJson(const QVector<FoundMaster> &masters)
{
    QJsonArray array;
    for (const FoundMaster &master : masters)
        array.append(QJsonObject{{QStringLiteral("address"), master.address},
                                 {QStringLiteral("name"), master.name},
                                 {QStringLiteral("local"), master.isLocal},
                                 {QStringLiteral("secured"), master.isSecured},
                                 {QStringLiteral("tableHash"), QPlcMessage::fromHex64(master.tableHash)}});
    printJson(QJsonDocument(array));
}

/// Until the application quits. A person sees how long that takes.
void waitForMasters(double seconds)
{
    constexpr double each = 0.5;  // [s]
    WaitLine line;
    double waited = 0.0;
    QTimer timer;
    QObject::connect(&timer, &QTimer::timeout, &timer, [&] {
        waited += each;
        line.show(QStringLiteral("listens for masters: %1 of %2 s").arg(waited).arg(seconds));
    });
    timer.start(std::chrono::milliseconds(std::llround(each * 1e3)));
    QCoreApplication::exec();
}

}  // namespace

int findMasters(const CommandCall &call)
{
    double seconds = 2.5;  // a beacon comes every 2 s
    if (!call.readNumber("seconds", 0.1, 3600.0, &seconds))
        return call.exitCode();
    const auto endIsWanted = call.quitOnSignals();
    qplc::MasterFinder finder;
    finder.start();
    QTimer::singleShot(std::chrono::milliseconds(std::llround(seconds * 1e3)), Qt::PreciseTimer, &finder,
                       [] { QCoreApplication::quit(); });
    if (!*endIsWanted)
        waitForMasters(seconds);
    finder.look();
    const QVector<FoundMaster> masters = finder.masters();
    if (call.isJson())
        printMastersAsJson(masters);
    else if (!masters.isEmpty())
        printMasters(masters);
    if (!masters.isEmpty())
        return QPlcCoreApplication::Success;
    QPlcCoreApplication::printError(QStringLiteral("found no master in %1 s; start one, or give one on the network the "
                                                   "option --beacon")
                                        .arg(seconds));
    return QPlcCoreApplication::Failure;
}

}  // namespace tools
