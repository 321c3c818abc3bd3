// SPDX-License-Identifier: Apache-2.0
#include <QtPlcCore>

class Operator : public QPlcCompactSlaveNode
{
public:
    Operator() : QPlcCompactSlaveNode(QStringLiteral("Operator")) {}

private:
    static constexpr double shortest = 300.0, longest = 310.0;  // [m]
    static constexpr double outwards = 4.0, inwards = -8.0;     // [m/s]

    QPlcInput<double> m_tetherLength{this, "tetherLength"};  // [m]
    QPlcOutput<double> m_tetherSpeed{this, "tetherSpeed"};   // [m/s], > 0 reels out

    void reset() override { m_tetherSpeed = outwards; }
    void step(const QPlcCycle &) override
    {
        if (m_tetherLength >= longest)
            m_tetherSpeed = inwards;
        else if (m_tetherLength <= shortest)
            m_tetherSpeed = outwards;
    }
};

int main(int argc, char **argv) { return QPlcNodeApplication::run<Operator>(argc, argv); }
