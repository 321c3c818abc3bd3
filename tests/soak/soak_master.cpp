// SPDX-License-Identifier: Apache-2.0
// soak_master: the master of the soak's plant, as a process.
#include "SoakMaster.h"

#include <cstdio>
#include <malloc.h>

namespace {

/// What the heap has lent, for a leak that does not show in resident memory as long as the heap has
/// a reserve.
void weigh(soak::HistoryWriter &history, quint64 cycle)
{
#if defined(__GLIBC__) && __GLIBC_PREREQ(2, 33)
    const struct mallinfo2 heap = ::mallinfo2();
    history.append(soak::Record::Heap, soak::Record::Nobody,
                   {heap.uordblks + heap.hblkhd, heap.arena + heap.hblkhd, heap.keepcost}, cycle);
#endif
}

}  // namespace

int main(int argc, char **argv)
{
    QPlcCoreApplication application(argc, argv);
    soak::addShapeOptions(application);
    application.addOption(
        {QStringLiteral("period-us"), QStringLiteral("Period [us]."), QStringLiteral("US"), QStringLiteral("10000")});
    application.addOption({QStringLiteral("port"), QStringLiteral("Port to listen on. 0: a free one."),
                           QStringLiteral("PORT"), QStringLiteral("0")});
    application.addRealTimeOptions();
    application.addSecurityOptions(QPlcSecurity::MasterSide);
    soak::NodeOptions options;
    soak::HistoryFile history;
    QPlcRealTimeOptions realTime;
    QPlcSecurity security;
    qint64 period = 0, port = 0;
    if (!application.parseOptions() || !application.integer(QStringLiteral("period-us"), 100, 1'000'000, &period)
        || !application.integer(QStringLiteral("port"), 0, 65535, &port) || !application.readRealTimeOptions(&realTime)
        || !application.readSecurityOptions(QPlcSecurity::MasterSide, &security)
        || !soak::readShapeOptions(application, &options, &history))
        return application.exitCode();
    history.append(soak::Record::Born, soak::Record::Nobody, {quint64(QCoreApplication::applicationPid())});
    soak::SoakMaster master(options, history);
    master.setRealTimeOptions(realTime);
    master.setSecurity(security);
    if (!master.start(std::chrono::microseconds(period),
                      QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, quint16(port))))
        return application.usageError(master.errorString());
    std::printf("port %d\n", int(master.serverPort()));
    std::fflush(stdout);
    QTimer heapTimer;
    QObject::connect(&heapTimer, &QTimer::timeout, &master, [&] { weigh(history, master.cycle()); });
    heapTimer.start(1000);
    application.quitOnSignals();
    const int code = QCoreApplication::exec();
    master.stop();
    master.stopServer();
    return code;
}
