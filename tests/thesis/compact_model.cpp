// SPDX-License-Identifier: Apache-2.0
// The same model in the form of listing 4.16 of the thesis: signals like variables. usage: compact_model PORT
#include <QtPlc>

#include "TankModel.h"

class CompactModelNode : public QPlcCompactSlaveNode
{
private:
    QPlcCompactSignal _speed = QPlcCompactSignal("speed", QPlcCompactSignal::Input, this);
    QPlcCompactSignal _valve = QPlcCompactSignal("valve", QPlcCompactSignal::Input, this);

    QPlcCompactSignal _level = QPlcCompactSignal("level", QPlcCompactSignal::Output, this);
    QPlcCompactSignal _flow = QPlcCompactSignal("flow", QPlcCompactSignal::Output, this);
    QPlcCompactSignal _volume = QPlcCompactSignal("volume", QPlcCompactSignal::Output, this);
    QPlcCompactSignal _time = QPlcCompactSignal("modelTime", QPlcCompactSignal::Output, this);

public:
    CompactModelNode()
        : QPlcCompactSlaveNode("CompactModel", ErrorZeroOrderHold)
    {
        TankModel_initialize();
    }

protected:
    void compactInitializeOutputSignals()
    {
        TankModel_initialize();
        TankModel_step();  // sets the outputs
        takeModelOutputs();
    }
    void initialized() { setModelInputs(); }
    void compactRealTimeout()
    {
        setModelInputs();
        TankModel_step();
        takeModelOutputs();
    }

private:
    void setModelInputs()
    {
        TankModel_U.speed = _speed;
        TankModel_U.valve = _valve;
    }
    void takeModelOutputs()
    {
        _level = TankModel_Y.level;
        _flow = TankModel_Y.flow;
        _volume = TankModel_Y.volume;
        _time = TankModel_Y.time;
    }
};

int main(int argc, char **argv)
{
    QPlcCoreApplication application(argc, argv);

    QPlcSignalIndexTable signalIndexTable;
    signalIndexTable.initializeFromIniFile(application.applicationDirPath() + "/../signals/tank.ini");

    CompactModelNode compactModelNode;
    compactModelNode.activateWorkloadMeasurement("modelWorkload");
    compactModelNode.activateWatchdog(0.150);
    if (!compactModelNode.connectToMasterAndWaitForConnected(
            QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, application.arguments().value(1).toUShort())))
        return 2;

    return application.exec();
}
