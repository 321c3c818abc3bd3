// SPDX-License-Identifier: Apache-2.0
#include "QPlcValue.h"
#include "signals/PayloadRules.h"

#include <QtTest/QtTest>

#include <limits>
#include <vector>

using qplc::PayloadLayout;
using qplc::PayloadRules;
using qplc::ValueFault;

Q_DECLARE_METATYPE(ValueFault::Kind)

namespace {

PayloadLayout layoutOfAll(const QPlcSignalTable &table)
{
    QVector<QPlcSignalIndex> all;
    for (int i = 0; i < table.size(); ++i)
        all.append(QPlcSignalIndex(i));
    return {table, all};
}

/// A signal under test between two neighbours of its type that allow everything.
struct Case
{
    explicit Case(const QByteArray &type, const QByteArray &keys)
        : table(QPlcSignalTable::fromIni("[before]\ntype = " + type + "\n[s]\ntype = " + type + '\n' + keys
                                         + "[after]\ntype = " + type + '\n'))
        , layout(layoutOfAll(table))
        , rules(table, layout)
        , payload(layout.size(), 0)
    {
    }
    void set(const QPlcValue &value)
    {
        value.convertedTo(table.at(1).type).toBytes(payload.data() + layout.fields().at(1).offset);
    }

    QPlcSignalTable table;
    PayloadLayout layout;
    PayloadRules rules;
    std::vector<char> payload;
};

}  // namespace

class tst_PayloadRules : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void numbersAreCheckedAgainstTheirLimits_data();
    void numbersAreCheckedAgainstTheirLimits();
    void realsHaveToBeFinite_data();
    void realsHaveToBeFinite();
    void allowingNanDoesNotAllowInfinity();
    void everyElementIsChecked();
    void integersTextsAndTimesMayHaveAnyBits();
    void aPayloadWithoutValuesIsAllowed();
};

void tst_PayloadRules::numbersAreCheckedAgainstTheirLimits_data()
{
    QTest::addColumn<QByteArray>("type");
    QTest::addColumn<QByteArray>("limits");
    QTest::addColumn<QPlcValue>("value");
    QTest::addColumn<ValueFault::Kind>("fault");
    const auto row
        = [](const QByteArray &type, const QByteArray &limits, const QPlcValue &value, ValueFault::Kind fault) {
              QTest::newRow((type + ' ' + limits.simplified() + ": " + value.toString().toUtf8()).constData())
                  << type << limits << value << fault;
          };
    for (const QByteArray type : {"Int8", "Int16", "Int32", "Int64", "Real32", "Real64"}) {
        row(type, "min = -10\nmax = 10\n", -10, ValueFault::None);
        row(type, "min = -10\nmax = 10\n", 10, ValueFault::None);
        row(type, "min = -10\nmax = 10\n", -11, ValueFault::BelowMinimum);
        row(type, "min = -10\nmax = 10\n", 11, ValueFault::AboveMaximum);
        row(type, "min = -10\n", 127, ValueFault::None);
        row(type, "min = -10\n", -127, ValueFault::BelowMinimum);
        row(type, "max = 10\n", -127, ValueFault::None);
        row(type, "max = 10\n", 127, ValueFault::AboveMaximum);
        row(type, "", 127, ValueFault::None);
    }
    for (const QByteArray type : {"UInt8", "UInt16", "UInt32", "UInt64"}) {
        const QByteArray limits = "min = 5\nmax = 200\ninitial = 5\n";
        row(type, limits, 5, ValueFault::None);
        row(type, limits, 200, ValueFault::None);
        row(type, limits, 4, ValueFault::BelowMinimum);
        row(type, limits, 201, ValueFault::AboveMaximum);
    }
    const quint64 most = std::numeric_limits<quint64>::max();
    row("UInt64", "max = 18446744073709551614\n", most, ValueFault::AboveMaximum);
    row("UInt64", "max = 18446744073709551614\n", most - 1, ValueFault::None);
    row("UInt64", "min = 1\ninitial = 1\n", most, ValueFault::None);
    const qint64 largest = std::numeric_limits<qint64>::max();
    row("Int64", "max = 9223372036854775806\n", largest, ValueFault::AboveMaximum);
    row("Int64", "max = 9223372036854775806\n", largest - 1, ValueFault::None);
    row("Real64", "max = inf\n", std::numeric_limits<double>::max(), ValueFault::None);
    row("Real64", "max = inf\n", std::numeric_limits<double>::infinity(), ValueFault::NotFinite);
    row("Real64", "min = 1\nmax = 1\ninitial = 1\n", std::nextafter(1.0, 2.0), ValueFault::AboveMaximum);
    row("Real32", "max = 1e30\n", double(std::numeric_limits<float>::max()), ValueFault::AboveMaximum);
}

void tst_PayloadRules::numbersAreCheckedAgainstTheirLimits()
{
    QFETCH(QByteArray, type);
    QFETCH(QByteArray, limits);
    QFETCH(QPlcValue, value);
    QFETCH(ValueFault::Kind, fault);
    Case c(type, limits);
    QCOMPARE(c.table.size(), 3);
    c.set(value);
    QCOMPARE(c.rules.allow(c.payload.data()), fault == ValueFault::None);
    QCOMPARE(c.rules.fault(1, c.payload.data()).kind, fault);
    QVERIFY(!c.rules.fault(0, c.payload.data()) && !c.rules.fault(2, c.payload.data()));
    if (fault != ValueFault::None)
        QCOMPARE(c.rules.fault(1, c.payload.data()).value, value.toReal());
}

void tst_PayloadRules::realsHaveToBeFinite_data()
{
    QTest::addColumn<QByteArray>("type");
    QTest::addColumn<QByteArray>("limits");
    QTest::addColumn<double>("value");
    for (const char *type : {"Real32", "Real64"}) {
        for (const char *limits : {"", "min = -1\nmax = 1\n", "max = 1\n"}) {
            for (const double value : {qQNaN(), qInf(), -qInf()})
                QTest::newRow(qPrintable(QStringLiteral("%1 %2 %3").arg(type, limits).arg(value)))
                    << QByteArray(type) << QByteArray(limits) << value;
        }
    }
}

void tst_PayloadRules::realsHaveToBeFinite()
{
    QFETCH(QByteArray, type);
    QFETCH(QByteArray, limits);
    QFETCH(double, value);
    Case c(type, limits);
    QVERIFY(c.rules.allow(c.payload.data()));
    c.set(value);
    QVERIFY(!c.rules.allow(c.payload.data()));
    QCOMPARE(c.rules.fault(1, c.payload.data()).kind, ValueFault::NotFinite);
    QVERIFY(!c.rules.fault(0, c.payload.data()) && !c.rules.fault(2, c.payload.data()));
}

void tst_PayloadRules::allowingNanDoesNotAllowInfinity()
{
    for (const char *type : {"Real32", "Real64"}) {
        Case c(type, "nan = allowed\nmax = 5\n");
        c.set(qQNaN());
        QVERIFY(c.rules.allow(c.payload.data()));
        QVERIFY(!c.rules.fault(1, c.payload.data()));
        c.set(6.0);
        QCOMPARE(c.rules.fault(1, c.payload.data()).kind, ValueFault::AboveMaximum);
        c.set(-qInf());
        QVERIFY(!c.rules.allow(c.payload.data()));
        QCOMPARE(c.rules.fault(1, c.payload.data()).kind, ValueFault::NotFinite);
    }
}

void tst_PayloadRules::everyElementIsChecked()
{
    for (int element = 0; element < 3; ++element) {
        Case c("Real32Triple", "max = 5\n");
        std::array<float, 3> values{1.0f, 2.0f, 3.0f};
        values[std::size_t(element)] = 5.5f;
        c.set(QPlcValue(values));
        QVERIFY(!c.rules.allow(c.payload.data()));
        QCOMPARE(c.rules.fault(1, c.payload.data()).value, 5.5);
        values[std::size_t(element)] = std::numeric_limits<float>::quiet_NaN();
        c.set(QPlcValue(values));
        QCOMPARE(c.rules.fault(1, c.payload.data()).kind, ValueFault::NotFinite);
        values[std::size_t(element)] = 5.0f;
        c.set(QPlcValue(values));
        QVERIFY(c.rules.allow(c.payload.data()));
    }
}

void tst_PayloadRules::integersTextsAndTimesMayHaveAnyBits()
{
    for (const char *type : {"UInt32", "Int64", "DateTime", "String(8)"}) {
        Case c(type, "");
        std::fill(c.payload.begin(), c.payload.end(), char(0xff));
        QVERIFY(c.rules.allow(c.payload.data()));
        for (std::size_t field = 0; field < 3; ++field)
            QVERIFY(!c.rules.fault(field, c.payload.data()));
    }
}

void tst_PayloadRules::aPayloadWithoutValuesIsAllowed()
{
    QVERIFY(PayloadRules().allow(nullptr));
}

QTEST_APPLESS_MAIN(tst_PayloadRules)
#include "tst_PayloadRules.moc"
