// SPDX-License-Identifier: Apache-2.0
#include "node/cycle/TemporaryValues.h"

#include <QtTest/QtTest>

using qplc::SignalSetting;
using qplc::TemporaryValues;

// Layers of values on signals, with instants and owners as the test says.
class tst_TemporaryValues : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { m_values = TemporaryValues(); }
    void nothingIsDueWhereNothingWasSet();
    void baseValueIsRestoredExactlyAtTheDeadline();
    void baseValueIsRestoredWhenTheOwnerEnds();
    void layersAreRestoredInOrder();
    void expiredLowerLayerChangesNoValue();
    void laterLayerOfTheSameOwnerReplacesTheFormerOne();
    void forgottenSignalKeepsItsValue();
    void signalsOfOneOwnerEndTogether();

private:
    static SignalSetting setting(QPlcSignalIndex signal, double value) { return {signal, QPlcValue(value)}; }
    /// "3 = 1.5; 4 = 2"
    static QString text(const std::vector<SignalSetting> &settings)
    {
        QStringList texts;
        for (const SignalSetting &item : settings)
            texts << QStringLiteral("%1 = %2").arg(item.signal).arg(item.value.toString());
        return texts.join(QStringLiteral("; "));
    }
    static constexpr std::int64_t never = INT64_MAX;
    const int m_owners[2] = {0, 0};
    const void *const a = &m_owners[0];
    const void *const b = &m_owners[1];
    TemporaryValues m_values;
};

void tst_TemporaryValues::nothingIsDueWhereNothingWasSet()
{
    QVERIFY(!m_values.nextDeadline());
    QVERIFY(m_values.endDue(never).empty());
    QVERIFY(m_values.endAllOf(a).empty());
    QVERIFY(m_values.signalIndices().empty());
    m_values.forget(3);
}

void tst_TemporaryValues::baseValueIsRestoredExactlyAtTheDeadline()
{
    m_values.set(a, setting(3, 5.0), 1.5, 100);
    QVERIFY(m_values.contains(3));
    QCOMPARE(m_values.nextDeadline().value(), std::int64_t(100));
    QCOMPARE(text(m_values.endDue(99)), QString());
    QCOMPARE(text(m_values.endDue(100)), QStringLiteral("3 = 1.5"));
    QVERIFY(!m_values.contains(3));
    QCOMPARE(text(m_values.endDue(never)), QString());  // once
}

void tst_TemporaryValues::baseValueIsRestoredWhenTheOwnerEnds()
{
    m_values.set(a, setting(3, 5.0), 1.5, 100);
    QCOMPARE(text(m_values.endAllOf(b)), QString());
    QCOMPARE(text(m_values.endAllOf(a)), QStringLiteral("3 = 1.5"));
    QVERIFY(!m_values.nextDeadline());
}

void tst_TemporaryValues::layersAreRestoredInOrder()
{
    m_values.set(a, setting(3, 5.0), 1.5, 200);
    m_values.set(b, setting(3, 6.0), 5.0, 100);
    QCOMPARE(m_values.nextDeadline().value(), std::int64_t(100));
    QCOMPARE(text(m_values.endDue(150)), QStringLiteral("3 = 5"));
    QCOMPARE(text(m_values.endDue(200)), QStringLiteral("3 = 1.5"));
}

void tst_TemporaryValues::expiredLowerLayerChangesNoValue()
{
    m_values.set(a, setting(3, 5.0), 1.5, 100);
    m_values.set(b, setting(3, 6.0), 5.0, 200);
    QCOMPARE(text(m_values.endDue(100)), QString());  // 6 is still to be seen
    QCOMPARE(text(m_values.endAllOf(b)), QStringLiteral("3 = 1.5"));
    m_values.set(a, setting(3, 5.0), 1.5, 100);
    m_values.set(b, setting(3, 6.0), 5.0, 100);
    QCOMPARE(text(m_values.endDue(100)), QStringLiteral("3 = 1.5"));  // both at once
}

void tst_TemporaryValues::laterLayerOfTheSameOwnerReplacesTheFormerOne()
{
    m_values.set(a, setting(3, 5.0), 1.5, 100);
    m_values.set(a, setting(3, 7.0), 5.0, 300);
    QCOMPARE(text(m_values.endDue(100)), QString());
    QCOMPARE(text(m_values.endDue(300)), QStringLiteral("3 = 1.5"));
    // It also comes to lie on top of the others.
    m_values.set(a, setting(3, 5.0), 1.5, 100);
    m_values.set(b, setting(3, 6.0), 5.0, 200);
    m_values.set(a, setting(3, 7.0), 6.0, 300);
    QCOMPARE(text(m_values.endAllOf(a)), QStringLiteral("3 = 6"));
}

void tst_TemporaryValues::forgottenSignalKeepsItsValue()
{
    m_values.set(a, setting(3, 5.0), 1.5, 100);
    m_values.set(a, setting(4, 5.0), 2.5, 100);
    m_values.forget(3);
    QCOMPARE(m_values.signalIndices(), std::vector<QPlcSignalIndex>{4});
    QCOMPARE(text(m_values.endAllOf(a)), QStringLiteral("4 = 2.5"));
}

void tst_TemporaryValues::signalsOfOneOwnerEndTogether()
{
    m_values.set(a, setting(4, 5.0), 2.5, 100);
    m_values.set(a, setting(3, 5.0), 1.5, never);
    m_values.set(b, setting(5, 5.0), 0.5, never);
    QCOMPARE(text(m_values.endAllOf(a)), QStringLiteral("3 = 1.5; 4 = 2.5"));
    QCOMPARE(m_values.signalIndices(), std::vector<QPlcSignalIndex>{5});
}

QTEST_APPLESS_MAIN(tst_TemporaryValues)
#include "tst_TemporaryValues.moc"
