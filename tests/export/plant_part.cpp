// SPDX-License-Identifier: Apache-2.0
// plant_part --part tank|display [--signal NAME]: a node of a plant that a host holds. It prints
// "registered" when the master has accepted it; a display prints the last value of its signal.
#include <QtPlcCore>

#include <cstdio>
#include <stdexcept>

namespace {

class Tank : public QPlcCompactSlaveNode
{
public:
    Tank()
        : QPlcCompactSlaveNode(QStringLiteral("Tank"))
    {
    }
    ~Tank() override { disconnectFromMaster(); }

private:
    using Triple = std::array<float, 3>;
    QPlcInput<double> m_command{this, "command", QPlcInputTiming::SameCycle};  // [m/s]
    QPlcInput<Triple> m_triple{this, "triple", QPlcInputTiming::SameCycle};
    QPlcOutput<double> m_level{this, "level"};  // [m]
    QPlcOutput<double> m_began{this, "began"};  // [m/s]
    QPlcOutput<Triple> m_tripleOut{this, "tripleOut"};
    double m_first = 0.0;

    void reset() override
    {
        m_level = 5.0;
        m_began = 0.0;
        m_tripleOut = Triple{};
    }
    void initialized() override { m_first = m_command; }
    void step(const QPlcCycle &) override
    {
        if (m_command <= -100.0)
            throw std::runtime_error("the outlet is too small");
        m_level = m_level + m_command;
        m_began = m_first;
        m_tripleOut = m_triple.value();
    }
};

class Display : public QPlcCompactSlaveNode
{
public:
    explicit Display(const QString &signal)
        : QPlcCompactSlaveNode(QStringLiteral("Display"))
        , m_value(this, signal.toUtf8().constData())
    {
    }
    ~Display() override { disconnectFromMaster(); }

private:
    QPlcInput<double> m_value;
    double m_shown = 0.0;
    void step(const QPlcCycle &) override
    {
        m_shown = m_value;
        if (m_shown == 104.0)
            throw std::runtime_error("not on the scale");
    }
    void stopped() override
    {
        std::printf("%.17g\n", m_shown);
        std::fflush(stdout);
    }
};

}  // namespace

int main(int argc, char **argv)
{
    QPlcNodeApplication application(argc, argv);
    application.addOption({"part", "tank or display.", "PART", "tank"});
    application.addOption({"signal", "That the display shows.", "NAME", "level"});
    if (!application.parseNodeOptions())
        return application.exitCode();
    std::unique_ptr<QPlcSlaveNode> node;
    if (application.value("part") == "tank")
        node = std::make_unique<Tank>();
    else
        node = std::make_unique<Display>(application.value("signal"));
    QObject::connect(node.get(), &QPlcSlaveNode::connectedToMaster, [] {
        std::puts("registered");
        std::fflush(stdout);
    });
    return application.run(*node);
}
