// SPDX-License-Identifier: Apache-2.0
#include <QtPlcCore>

#include <cstdio>

int main(int argc, char **argv)
{
    QPlcCoreApplication application(argc, argv);
    application.setDescription("The master of the winch.");
    application.addOption({"signals", "Signal table.", "FILE", "winch.ini"});
    application.addOption({"port", "Port to listen on.", "PORT", "50000"});
    application.addProfileOption();
    qint64 port = 0;
    QPlcProfile::Value profile = QPlcProfile::Automatic;
    if (!application.parseOptions() || !application.integer("port", 0, 65535, &port)
        || !application.readProfile(&profile))
        return application.exitCode();

    QPlcSignalIndexTable table;
    if (!table.initializeFromIniFile(application.value("signals")))
        return application.usageError(table.errorString());

    QPlcMasterNode master;
    master.setInterval(std::chrono::milliseconds(10));
    master.setProfile(profile);
    master.setTimeSignal("masterTime");
    if (!master.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, quint16(port))))
        return application.usageError(master.errorString());
    std::printf("port %d\n", int(master.serverPort()));
    std::fflush(stdout);
    application.quitOnSignals();
    return QPlcCoreApplication::exec();
}
