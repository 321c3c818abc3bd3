// SPDX-License-Identifier: Apache-2.0
// The same model with the calls of listing 4.16 of the thesis: signals like variables. usage:
// compact_model [PORT]; without it 50000
#include <QtPlc>

#include "LaweModel.h"

class CompactModelNode : public QPlcCompactSlaveNode
{
private:
    QPlcCompactSignal _bodyControlPitchSpeed
        = QPlcCompactSignal("bodyControlPitchSpeed", QPlcCompactSignal::Input, this);
    QPlcCompactSignal _bodyControlYawSpeed = QPlcCompactSignal("bodyControlYawSpeed", QPlcCompactSignal::Input, this);
    QPlcCompactSignal _tetherSpeed = QPlcCompactSignal("tetherSpeed", QPlcCompactSignal::Input, this);

    QPlcCompactSignal _bodyPosition_earth = QPlcCompactSignal("bodyPosition_earth", QPlcCompactSignal::Output, this);
    QPlcCompactSignal _bodyVelocity_earth = QPlcCompactSignal("bodyVelocity_earth", QPlcCompactSignal::Output, this);
    QPlcCompactSignal _windVelocity_earth = QPlcCompactSignal("windVelocity_earth", QPlcCompactSignal::Output, this);

    QPlcCompactSignal _bodyControlOrientation
        = QPlcCompactSignal("bodyControlOrientation", QPlcCompactSignal::Output, this);
    QPlcCompactSignal _bodyPositionOrientation
        = QPlcCompactSignal("bodyPositionOrientation", QPlcCompactSignal::Output, this);

    QPlcCompactSignal _angleOfAttack = QPlcCompactSignal("angleOfAttack", QPlcCompactSignal::Output, this);
    QPlcCompactSignal _dragCoefficient = QPlcCompactSignal("dragCoefficient", QPlcCompactSignal::Output, this);
    QPlcCompactSignal _liftCoefficient = QPlcCompactSignal("liftCoefficient", QPlcCompactSignal::Output, this);
    QPlcCompactSignal _aweCoefficient = QPlcCompactSignal("aweCoefficient", QPlcCompactSignal::Output, this);

    QPlcCompactSignal _aerodynamicForce_earth
        = QPlcCompactSignal("aerodynamicForce_earth", QPlcCompactSignal::Output, this);
    QPlcCompactSignal _tetherForce_earth = QPlcCompactSignal("tetherForce_earth", QPlcCompactSignal::Output, this);
    QPlcCompactSignal _gravitationalForce_earth
        = QPlcCompactSignal("gravitationalForce_earth", QPlcCompactSignal::Output, this);

    QPlcCompactSignal _tetherLength = QPlcCompactSignal("tetherLength", QPlcCompactSignal::Output, this);
    QPlcCompactSignal _power = QPlcCompactSignal("power", QPlcCompactSignal::Output, this);
    QPlcCompactSignal _averagePower = QPlcCompactSignal("averagePower", QPlcCompactSignal::Output, this);
    QPlcCompactSignal _energy = QPlcCompactSignal("energy", QPlcCompactSignal::Output, this);

public:
    CompactModelNode()
        : QPlcCompactSlaveNode("CompactModel", ErrorZeroOrderHold)
    {
        LaweModel_initialize();
    }

protected:
    void compactInitializeOutputSignals()
    {
        LaweModel_initialize();
        LaweModel_step();  // sets the outputs
        collectOutputs();
    }
    void initialized() { collectInputs(); }
    void compactRealTimeout()
    {
        collectInputs();
        LaweModel_step();
        collectOutputs();
    }

private:
    void collectInputs()
    {
        LaweModel_U.bodyControlPitchSpeed = _bodyControlPitchSpeed;
        LaweModel_U.bodyControlYawSpeed = _bodyControlYawSpeed;
        LaweModel_U.tetherSpeed = _tetherSpeed;
    }
    void collectOutputs()
    {
        _bodyPosition_earth = LaweModel_Y.bodyPosition_earth;
        _bodyVelocity_earth = LaweModel_Y.bodyVelocity_earth;
        _windVelocity_earth = LaweModel_Y.windVelocity_earth;

        _bodyControlOrientation = LaweModel_Y.bodyControlOrientation;
        _bodyPositionOrientation = LaweModel_Y.bodyPositionOrientation;

        _angleOfAttack = LaweModel_Y.angleOfAttack;
        _dragCoefficient = LaweModel_Y.dragCoefficient;
        _liftCoefficient = LaweModel_Y.liftCoefficient;
        _aweCoefficient = LaweModel_Y.aweCoefficient;

        _aerodynamicForce_earth = LaweModel_Y.aerodynamicForce_earth;
        _tetherForce_earth = LaweModel_Y.tetherForce_earth;
        _gravitationalForce_earth = LaweModel_Y.gravitationalForce_earth;

        _tetherLength = LaweModel_Y.tetherLength;
        _power = LaweModel_Y.power;
        _averagePower = LaweModel_Y.averagePower;
        _energy = LaweModel_Y.energy;
    }
};

int main(int argc, char **argv)
{
    QPlcCoreApplication application(argc, argv);
    const QString port = application.arguments().value(1, "50000");

    QPlcSignalIndexTable signalIndexTable;
    signalIndexTable.initializeFromIniFile(application.applicationDirPath() + "/../../Signals/SignalIndexTable.ini");

    CompactModelNode compactModelNode;
    compactModelNode.activateWorkloadMeasurement("modelWorkload");
    compactModelNode.activateWatchdog(0.015);
    if (!compactModelNode.connectToMasterAndWaitForConnected(
            QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, port.toUShort())))
        return 2;  // the listing returns 0, but a program that has failed should say so

    return application.exec();
}
