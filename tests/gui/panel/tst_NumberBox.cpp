// SPDX-License-Identifier: Apache-2.0
#include "gui/panel/NumberBox.h"

#include <QtTest/QtTest>

using namespace qplc;

class tst_NumberBox : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void init() { m_box = std::make_unique<NumberBox>(-1e12, 1e12); }
    void numbersOfAnySizeAreShown_data();
    void numbersOfAnySizeAreShown();
    void valueKeepsFullPrecisionUntilTheUserEditsIt();
    void completeNumbersAreAccepted_data();
    void completeNumbersAreAccepted();
    void unitsAreNotParsedAsNumber();
    void typedValueStaysWithinTheRange();
    void stepsAreATenthOfTheFirstDigit_data();
    void stepsAreATenthOfTheFirstDigit();

private:
    void write(const QString &text)
    {
        m_box->selectAll();
        QTest::keyClicks(m_box.get(), text);
        QTest::keyClick(m_box.get(), Qt::Key_Return);
    }

    std::unique_ptr<NumberBox> m_box;
};

void tst_NumberBox::numbersOfAnySizeAreShown_data()
{
    QTest::addColumn<double>("value");
    QTest::addColumn<QString>("text");
    QTest::newRow("zero") << 0.0 << QStringLiteral("0");
    QTest::newRow("small") << 0.0003 << QStringLiteral("0.0003");
    QTest::newRow("tiny") << -1e-9 << QStringLiteral("-1e-09");
    QTest::newRow("large") << 250000.5 << QStringLiteral("250000.5");
    QTest::newRow("many digits") << 1.0 / 3.0 << QStringLiteral("0.3333333333");
}

void tst_NumberBox::numbersOfAnySizeAreShown()
{
    QFETCH(double, value);
    QFETCH(QString, text);
    m_box->setValue(value);
    QCOMPARE(m_box->text(), text);
    QVERIFY(m_box->value() == value);
}

void tst_NumberBox::valueKeepsFullPrecisionUntilTheUserEditsIt()
{
    m_box->setValue(1.0 / 3.0);
    QSignalSpy changes(m_box.get(), qOverload<double>(&NumberBox::valueChanged));
    m_box->interpretText();
    QTest::keyClick(m_box.get(), Qt::Key_Return);
    QVERIFY(m_box->value() == 1.0 / 3.0);
    QCOMPARE(changes.count(), 0);
    write(QStringLiteral("0.25"));
    QCOMPARE(m_box->value(), 0.25);
    QCOMPARE(changes.count(), 1);
}

void tst_NumberBox::completeNumbersAreAccepted_data()
{
    QTest::addColumn<QString>("text");
    QTest::addColumn<double>("value");
    QTest::newRow("small") << QStringLiteral("0.00025") << 0.00025;
    QTest::newRow("with an exponent") << QStringLiteral("-2.5e-7") << -2.5e-7;
    QTest::newRow("large") << QStringLiteral("3E5") << 3e5;
    QTest::newRow("unfinished") << QStringLiteral("2e") << 7.0;
    QTest::newRow("nothing") << QStringLiteral("-") << 7.0;
    QTest::newRow("letters are not taken") << QStringLiteral("a5x") << 5.0;
}

void tst_NumberBox::completeNumbersAreAccepted()
{
    QFETCH(QString, text);
    QFETCH(double, value);
    m_box->setValue(7.0);
    write(text);
    QCOMPARE(m_box->value(), value);
}

void tst_NumberBox::unitsAreNotParsedAsNumber()
{
    m_box->setPrefix(QStringLiteral("T "));
    m_box->setSuffix(QStringLiteral(" m/s"));
    m_box->setValue(0.0003);
    QCOMPARE(m_box->text(), QStringLiteral("T 0.0003 m/s"));
    write(QStringLiteral("1e-4"));
    QCOMPARE(m_box->value(), 1e-4);
    QCOMPARE(m_box->text(), QStringLiteral("T 0.0001 m/s"));
}

void tst_NumberBox::typedValueStaysWithinTheRange()
{
    m_box->setRange(0.0, 100.0);
    m_box->setValue(20.0);
    write(QStringLiteral("1e5"));
    QVERIFY(m_box->value() <= 100.0);
    write(QStringLiteral("-3"));
    QVERIFY(m_box->value() >= 0.0);
}

void tst_NumberBox::stepsAreATenthOfTheFirstDigit_data()
{
    QTest::addColumn<double>("value");
    QTest::addColumn<int>("steps");
    QTest::addColumn<double>("then");
    QTest::newRow("from zero") << 0.0 << 1 << 0.001;
    QTest::newRow("to zero") << 0.001 << -1 << 0.0;
    QTest::newRow("small") << 0.0003 << 1 << 0.00031;
    QTest::newRow("middle") << 0.3 << 1 << 0.31;
    QTest::newRow("large") << -4500.0 << 10 << -3500.0;
}

void tst_NumberBox::stepsAreATenthOfTheFirstDigit()
{
    QFETCH(double, value);
    QFETCH(int, steps);
    QFETCH(double, then);
    m_box->setValue(value);
    m_box->stepBy(steps);
    QVERIFY2(m_box->value() == then, qPrintable(QString::number(m_box->value(), 'g', 17)));
}

QTEST_MAIN(tst_NumberBox)
#include "tst_NumberBox.moc"
