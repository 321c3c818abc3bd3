// SPDX-License-Identifier: Apache-2.0
// A master in the form of listing 4.12 of the thesis. usage: master PORT (0: a free one)
#include <QtPlc>

int main(int argc, char **argv)
{
    QPlcCoreApplication application(argc, argv);

    QPlcSignalIndexTable signalIndexTable;
    signalIndexTable.initializeFromIniFile(application.applicationDirPath() + "/../signals/tank.ini");

    QPlcMasterNode master;
    master.activateWorkloadMeasurement("masterWorkload");
    master.activateJitterMeasurement("masterJitter");
    master.setTimeSignal("masterTime");
    master.setInterval(0.010);
    if (!master.startServer(
            QPlcUnderlyingProtocol::tcp(QHostAddress::Any, application.arguments().value(1).toUShort())))
        return 2;

    return application.exec();
}
