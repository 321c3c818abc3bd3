// SPDX-License-Identifier: Apache-2.0
#include <QtPlcCore>
#include <cstdio>
using StepResult = QPlcMasterNode::StepResult;

/// Takes the speed from the controller, which is a program of its own.
class Drive : public QPlcCompactSlaveNode
{
public:
    Drive()
        : QPlcCompactSlaveNode(QStringLiteral("Drive"))
    {
    }
    QPlcInput<double> speed{this, "speed", QPlcInputTiming::SameCycle};  // [m/s]
private:
    void step(const QPlcCycle &) override {}
};

/// Gives the controller the length that the simulation has computed.
class Sensor : public QPlcCompactSlaveNode
{
public:
    Sensor()
        : QPlcCompactSlaveNode(QStringLiteral("Sensor"))
    {
    }
    QPlcOutput<double> length{this, "length"};  // [m]
private:
    void step(const QPlcCycle &) override {}
};

/// The simulation. It has no event loop, and no QCoreApplication.
int main(int argc, char **argv)
{
    const quint16 port = argc > 1 ? quint16(QByteArray(argv[1]).toUInt()) : 50000;
    QPlcEmbeddedMaster master;
    master.call([port](QPlcMasterNode &node) {
        node.setSignalTable(QPlcSignalTable::fromIni("[speed]\ntype = Real64\n[length]\ntype = Real64\n"));
        node.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, port));
    });
    Drive *drive = master.addNode<Drive>();
    Sensor *sensor = master.addNode<Sensor>();
    if (!drive || !sensor || !master.start(std::chrono::seconds(10), {QStringLiteral("Controller")})) {
        std::fprintf(stderr, "%s\n", qPrintable(master.errorString()));
        return 1;
    }
    double length = 0.0;  // [m]
    StepResult result = StepResult::Complete;
    for (int cycle = 0; cycle < 1000 && result == StepResult::Complete; ++cycle) {
        sensor->length = length;
        result = master.step();
        length += 0.01 * drive->speed;
    }
    std::printf("%.3f m\n", length);
    return result == StepResult::Complete ? 0 : 1;
}
