// SPDX-License-Identifier: Apache-2.0
// A library with a plant in it, as a simulator loads it: its functions have types of C alone.
#include <QtPlcCore>

namespace {

class Command : public QPlcCompactSlaveNode
{
public:
    Command()
        : QPlcCompactSlaveNode(QStringLiteral("Command"))
    {
    }
    QPlcOutput<double> value{this, "command"};

private:
    void step(const QPlcCycle &) override {}
};

class Sum : public QPlcCompactSlaveNode
{
public:
    Sum()
        : QPlcCompactSlaveNode(QStringLiteral("Sum"))
    {
    }
    double value() const { return m_sum; }

private:
    QPlcInput<double> m_command{this, "command", QPlcInputTiming::SameCycle};
    QPlcOutput<double> m_sum{this, "sum"};

    void reset() override { m_sum = 0.0; }
    void step(const QPlcCycle &) override { m_sum = m_sum + m_command; }
};

struct Plant
{
    QPlcEmbeddedMaster master;
    Command *command = nullptr;
    Sum *sum = nullptr;
};

}  // namespace

extern "C" {

Q_DECL_EXPORT void *plant_open()
{
    auto plant = std::make_unique<Plant>();
    plant->master.call([](QPlcMasterNode &master) {
        master.setSignalTable(
            QPlcSignalTable::fromIni("[command]\ntype = Real64\n[sum]\ntype = Real64\n[unused]\ntype = Int32\n"));
        master.startServer(QPlcUnderlyingProtocol::tcp(QHostAddress::LocalHost, 0));
    });
    plant->command = plant->master.addNode<Command>();
    plant->sum = plant->master.addNode<Sum>();
    const bool isReady = plant->command && plant->sum && plant->master.start(std::chrono::seconds(20));
    return isReady ? plant.release() : nullptr;
}

/// \return 0: the step is complete
Q_DECL_EXPORT int plant_step(void *plant, double command, double *sum)
{
    auto *open = static_cast<Plant *>(plant);
    open->command->value = command;
    const QPlcMasterNode::StepResult result = open->master.step();
    *sum = open->sum->value();
    return int(result);
}

Q_DECL_EXPORT void plant_close(void *plant)
{
    delete static_cast<Plant *>(plant);
}
}
