// SPDX-License-Identifier: Apache-2.0
#include "Trajectory.h"

#include "Near.h"

#include <algorithm>

using awe::Trajectory;

/// Four flights that independent implementations of the same equations agree on to about 1e-13.
class tst_ReferenceFlights : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void plantReproducesEveryColumn_data();
    void plantReproducesEveryColumn();
    void snatchFlightHasSlackTether();
};

void tst_ReferenceFlights::plantReproducesEveryColumn_data()
{
    QTest::addColumn<QString>("name");
    for (const char *name : {"s1_straight", "s3_reel_out_eights", "s5_slack_snatch", "s8_negative_alpha"})
        QTest::newRow(name) << QString::fromLatin1(name);
}

void tst_ReferenceFlights::plantReproducesEveryColumn()
{
    QFETCH(QString, name);
    Trajectory recorded;
    const std::string complaint = recorded.load(std::string(AWE_REFERENCE "/") + name.toStdString() + ".csv");
    QVERIFY2(complaint.empty(), complaint.c_str());
    const Trajectory flown = recorded.replayed();
    QCOMPARE(flown.rows().size(), recorded.rows().size());

    Trajectory::Columns largest{}, worst{};
    for (std::size_t k = 0; k < recorded.rows().size(); ++k) {
        const auto expected = Trajectory::toColumns(recorded.rows()[k]), seen = Trajectory::toColumns(flown.rows()[k]);
        for (std::size_t c = 0; c < Trajectory::columnCount; ++c) {
            largest[c] = std::max(largest[c], std::abs(expected[c]));
            worst[c] = std::max(worst[c], std::abs(seen[c] - expected[c]));
        }
    }
    for (std::size_t c = 0; c < Trajectory::columnCount; ++c)
        QVERIFY2(worst[c] <= 1e-9 * largest[c], Trajectory::columnNames()[c]);
}

void tst_ReferenceFlights::snatchFlightHasSlackTether()
{
    Trajectory recorded;
    QVERIFY(recorded.load(AWE_REFERENCE "/s5_slack_snatch.csv").empty());
    const Trajectory flown = recorded.replayed();
    const auto slack = std::count_if(flown.rows().begin(), flown.rows().end(), [](const Trajectory::Row &row) {
        return row.outputs.tetherForce.norm() == 0.0 && row.outputs.tetherLength > row.outputs.position.norm();
    });
    QCOMPARE(slack, 58);
}

QTEST_APPLESS_MAIN(tst_ReferenceFlights)
#include "tst_ReferenceFlights.moc"
