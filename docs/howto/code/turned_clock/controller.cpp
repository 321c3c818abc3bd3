// SPDX-License-Identifier: Apache-2.0
#include <QtPlcCore>

/// Moves the drive to 10 m, the faster the farther away.
class Controller : public QPlcCompactSlaveNode
{
public:
    Controller()
        : QPlcCompactSlaveNode(QStringLiteral("Controller"))
    {
    }

private:
    QPlcInput<double> m_length{this, "length"};  // [m]
    QPlcOutput<double> m_speed{this, "speed"};   // [m/s]
    void reset() override { m_speed = 0.0; }
    void step(const QPlcCycle &) override { m_speed = 0.1 * (10.0 - m_length); }
};

int main(int argc, char **argv)
{
    return QPlcNodeApplication::run<Controller>(argc, argv);
}
