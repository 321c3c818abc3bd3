// SPDX-License-Identifier: Apache-2.0
#include <QtPlcCore>

/// The vane as a model: the wind turns once in ten minutes.
class WeatherModel : public QPlcCompactSlaveNode
{
public:
    WeatherModel()
        : QPlcCompactSlaveNode(QStringLiteral("WeatherModel"))
    {
    }

private:
    QPlcOutput<double> m_direction{this, "windDirection"};  // [deg]

    void reset() override { m_direction = 180.0; }
    void step(const QPlcCycle &cycle) override
    {
        const double next = m_direction + 0.6 * cycle.dt();
        m_direction = next < 360.0 ? next : 0.0;
    }
};

int main(int argc, char **argv)
{
    return QPlcNodeApplication::run<WeatherModel>(argc, argv);
}
