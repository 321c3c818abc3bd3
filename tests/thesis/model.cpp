// SPDX-License-Identifier: Apache-2.0
// A model with the calls of listing 4.14 of the thesis: lists of values. usage: model [PORT];
// without it 50000
#include <QtPlc>

#include "LaweModel.h"

class ModelNode : public QPlcSlaveNode
{
private:
    QPlcSignalIndex _bodyControlPitchSpeedIndex;
    QPlcSignalIndex _bodyControlYawSpeedIndex;
    QPlcSignalIndex _tetherSpeedIndex;

    QPlcSignalIndex _bodyPosition_earth_index;
    QPlcSignalIndex _bodyVelocity_earth_index;
    QPlcSignalIndex _windVelocity_earth_index;

    QPlcSignalIndex _bodyControlOrientationIndex;
    QPlcSignalIndex _bodyPositionOrientationIndex;

    QPlcSignalIndex _angleOfAttackIndex;
    QPlcSignalIndex _dragCoefficientIndex;
    QPlcSignalIndex _liftCoefficientIndex;
    QPlcSignalIndex _aweCoefficientIndex;

    QPlcSignalIndex _aerodynamicForce_earth_index;
    QPlcSignalIndex _tetherForce_earth_index;
    QPlcSignalIndex _gravitationalForce_earth_index;

    QPlcSignalIndex _tetherLengthIndex;
    QPlcSignalIndex _powerIndex;
    QPlcSignalIndex _averagePowerIndex;
    QPlcSignalIndex _energyIndex;

public:
    ModelNode()
        : QPlcSlaveNode("Model", ErrorZeroOrderHold)
    {
        LaweModel_initialize();
    }

protected:
    QPlcSignalIndexList declareInputSignals()
    {
        QPlcSignalIndexList list;
        _bodyControlPitchSpeedIndex = list.insert("bodyControlPitchSpeed");
        _bodyControlYawSpeedIndex = list.insert("bodyControlYawSpeed");
        _tetherSpeedIndex = list.insert("tetherSpeed");
        return list;
    }
    QPlcSignalIndexList declareOutputSignals()
    {
        QPlcSignalIndexList list;
        _bodyPosition_earth_index = list.insert("bodyPosition_earth");
        _bodyVelocity_earth_index = list.insert("bodyVelocity_earth");
        _windVelocity_earth_index = list.insert("windVelocity_earth");

        _bodyControlOrientationIndex = list.insert("bodyControlOrientation");
        _bodyPositionOrientationIndex = list.insert("bodyPositionOrientation");

        _angleOfAttackIndex = list.insert("angleOfAttack");
        _dragCoefficientIndex = list.insert("dragCoefficient");
        _liftCoefficientIndex = list.insert("liftCoefficient");
        _aweCoefficientIndex = list.insert("aweCoefficient");

        _aerodynamicForce_earth_index = list.insert("aerodynamicForce_earth");
        _tetherForce_earth_index = list.insert("tetherForce_earth");
        _gravitationalForce_earth_index = list.insert("gravitationalForce_earth");

        _tetherLengthIndex = list.insert("tetherLength");
        _powerIndex = list.insert("power");
        _averagePowerIndex = list.insert("averagePower");
        _energyIndex = list.insert("energy");
        return list;
    }

protected:
    QPlcSignalList initialOutputSignals()
    {
        LaweModel_initialize();
        LaweModel_step();  // sets the outputs
        return collectModelOutputs();
    }
    void initialize(const QPlcSignalList &initialSignals) { distributeModelInputs(initialSignals); }
    QPlcSignalList realTimeout(const QPlcSignalList &inputSignals)
    {
        distributeModelInputs(inputSignals);
        LaweModel_step();
        return collectModelOutputs();
    }

private:
    void distributeModelInputs(const QPlcSignalList &inputSignals)
    {
        LaweModel_U.bodyControlPitchSpeed = inputSignals.value(_bodyControlPitchSpeedIndex).toReal();
        LaweModel_U.bodyControlYawSpeed = inputSignals.value(_bodyControlYawSpeedIndex).toReal();
        LaweModel_U.tetherSpeed = inputSignals.value(_tetherSpeedIndex).toReal();
    }
    QPlcSignalList collectModelOutputs()
    {
        QPlcSignalList outputs;
        outputs.insert(_bodyPosition_earth_index, LaweModel_Y.bodyPosition_earth);
        outputs.insert(_bodyVelocity_earth_index, LaweModel_Y.bodyVelocity_earth);
        outputs.insert(_windVelocity_earth_index, LaweModel_Y.windVelocity_earth);

        outputs.insert(_bodyControlOrientationIndex, LaweModel_Y.bodyControlOrientation);
        outputs.insert(_bodyPositionOrientationIndex, LaweModel_Y.bodyPositionOrientation);

        outputs.insert(_angleOfAttackIndex, LaweModel_Y.angleOfAttack);
        outputs.insert(_dragCoefficientIndex, LaweModel_Y.dragCoefficient);
        outputs.insert(_liftCoefficientIndex, LaweModel_Y.liftCoefficient);
        outputs.insert(_aweCoefficientIndex, LaweModel_Y.aweCoefficient);

        outputs.insert(_aerodynamicForce_earth_index, LaweModel_Y.aerodynamicForce_earth);
        outputs.insert(_tetherForce_earth_index, LaweModel_Y.tetherForce_earth);
        outputs.insert(_gravitationalForce_earth_index, LaweModel_Y.gravitationalForce_earth);

        outputs.insert(_tetherLengthIndex, LaweModel_Y.tetherLength);
        outputs.insert(_powerIndex, LaweModel_Y.power);
        outputs.insert(_averagePowerIndex, LaweModel_Y.averagePower);
        outputs.insert(_energyIndex, LaweModel_Y.energy);
        return outputs;
    }
};

int main(int argc, char **argv)
{
    QPlcCoreApplication application(argc, argv);
    const QString port = application.arguments().value(1, "50000");

    QPlcSignalIndexTable signalIndexTable;
    signalIndexTable.initializeFromIniFile(application.applicationDirPath() + "/../../Signals/SignalIndexTable.ini");

    ModelNode modelNode;
    modelNode.activateWorkloadMeasurement("modelWorkload");
    modelNode.activateWatchdog(0.015);
    if (!modelNode.connectToMasterAndWaitForConnected(
            QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, port.toUShort())))
        return 2;  // the listing returns 0, but a program that has failed should say so

    return application.exec();
}
