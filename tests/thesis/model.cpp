// SPDX-License-Identifier: Apache-2.0
// A model in the form of listing 4.14 of the thesis: lists of values. usage: model PORT
#include <QtPlc>

#include "TankModel.h"

class ModelNode : public QPlcSlaveNode
{
private:
    QPlcSignalIndex _speedIndex;
    QPlcSignalIndex _valveIndex;

    QPlcSignalIndex _levelIndex;
    QPlcSignalIndex _flowIndex;
    QPlcSignalIndex _volumeIndex;
    QPlcSignalIndex _timeIndex;

public:
    ModelNode()
        : QPlcSlaveNode("Model", ErrorZeroOrderHold)
    {
        TankModel_initialize();
    }

protected:
    QPlcSignalIndexList declareInputSignals()
    {
        QPlcSignalIndexList list;
        _speedIndex = list.insert("speed");
        _valveIndex = list.insert("valve");
        return list;
    }
    QPlcSignalIndexList declareOutputSignals()
    {
        QPlcSignalIndexList list;
        _levelIndex = list.insert("level");
        _flowIndex = list.insert("flow");
        _volumeIndex = list.insert("volume");
        _timeIndex = list.insert("modelTime");
        return list;
    }

protected:
    QPlcSignalList initialOutputSignals()
    {
        TankModel_initialize();
        TankModel_step();  // sets the outputs
        return modelOutputs();
    }
    void initialize(const QPlcSignalList &initialSignals) { setModelInputs(initialSignals); }
    QPlcSignalList realTimeout(const QPlcSignalList &inputSignals)
    {
        setModelInputs(inputSignals);
        TankModel_step();
        return modelOutputs();
    }

private:
    void setModelInputs(const QPlcSignalList &inputs)
    {
        TankModel_U.speed = inputs.value(_speedIndex).toReal();
        TankModel_U.valve = inputs.value(_valveIndex).toReal();
    }
    QPlcSignalList modelOutputs()
    {
        QPlcSignalList outputs;
        outputs.insert(_levelIndex, TankModel_Y.level);
        outputs.insert(_flowIndex, TankModel_Y.flow);
        outputs.insert(_volumeIndex, TankModel_Y.volume);
        outputs.insert(_timeIndex, TankModel_Y.time);
        return outputs;
    }
};

int main(int argc, char **argv)
{
    QPlcCoreApplication application(argc, argv);

    QPlcSignalIndexTable signalIndexTable;
    signalIndexTable.initializeFromIniFile(application.applicationDirPath() + "/../signals/tank.ini");

    ModelNode modelNode;
    modelNode.activateWorkloadMeasurement("modelWorkload");
    modelNode.activateWatchdog(0.150);
    if (!modelNode.connectToMasterAndWaitForConnected(
            QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, application.arguments().value(1).toUShort())))
        return 2;

    return application.exec();
}
