// SPDX-License-Identifier: Apache-2.0
// A master with the calls of listing 4.12 of the thesis. usage: master [PORT]; without it 50000, 0:
// a free one
#include <QtPlc>

int main(int argc, char **argv)
{
    QPlcCoreApplication application(argc, argv);
    const QString port = application.arguments().value(1, "50000");

    QPlcSignalIndexTable signalIndexTable;
    signalIndexTable.initializeFromIniFile(application.applicationDirPath() + "/../../Signals/SignalIndexTable.ini");

    QPlcMasterNode master;
    master.activateWorkloadMeasurement("masterWorkload");
    master.activateJitterMeasurement("masterJitter");
    master.setTimeSignal("masterTime");
    master.setInterval(0.010);
    if (!master.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::Any, port.toUShort())))
        return 2;  // the listing returns 0, but a program that has failed should say so

    return application.exec();
}
