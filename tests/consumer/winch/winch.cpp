// SPDX-License-Identifier: Apache-2.0
#include <QtPlcCore>

class Winch : public QPlcCompactSlaveNode
{
public:
    Winch() : QPlcCompactSlaveNode(QStringLiteral("Winch")) {}

private:
    QPlcInput<double> m_tetherSpeed{this, "tetherSpeed"};     // [m/s], > 0 reels out
    QPlcOutput<double> m_tetherLength{this, "tetherLength"};  // [m]

    void reset() override { m_tetherLength = 300.0; }  // before every real-time phase
    void step(const QPlcCycle &cycle) override         // once per cycle, real-time
    {
        m_tetherLength = m_tetherLength + m_tetherSpeed * cycle.dt();
    }
};

int main(int argc, char **argv) { return QPlcNodeApplication::run<Winch>(argc, argv); }
