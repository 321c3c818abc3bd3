// SPDX-License-Identifier: Apache-2.0
#include "transport/DelayLine.h"

#include <QtTest/QtTest>

using qplc::DelayLine;

// Frames that wait for their time, by a clock of the test.
class tst_DelayLine : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void framesComeWhenTheyAreDue();
    void framesOfTheSameTimeComeInTheirOrder();
    void manyFramesComeInTheOrderOfTheirTimes();
    void aFrameOfTheLargestSizeFits();
    void aFullLineTakesNothing();
    void framesOfAnOwnerAreForgotten();

private:
    static char *put(DelayLine &line, std::int64_t due, const QByteArray &bytes, void *owner = nullptr)
    {
        return line.put(due, owner, bytes.constData(), std::size_t(bytes.size()));
    }
    static QByteArray take(DelayLine &line, std::int64_t now)
    {
        DelayLine::Frame frame;
        return line.take(now, &frame) ? QByteArray(frame.bytes, int(frame.size)) : QByteArray("none");
    }
};

void tst_DelayLine::framesComeWhenTheyAreDue()
{
    DelayLine line(4, 8);
    QCOMPARE(line.nextDue(), DelayLine::Never);
    QCOMPARE(take(line, 1000), QByteArray("none"));
    put(line, 30, "late");
    put(line, 10, "early");
    put(line, 20, "middle");
    QCOMPARE(line.nextDue(), std::int64_t(10));
    QCOMPARE(take(line, 9), QByteArray("none"));
    QCOMPARE(take(line, 10), QByteArray("early"));
    QCOMPARE(take(line, 10), QByteArray("none"));
    QCOMPARE(take(line, 100), QByteArray("middle"));
    QCOMPARE(take(line, 100), QByteArray("late"));
    QCOMPARE(line.nextDue(), DelayLine::Never);
}

void tst_DelayLine::framesOfTheSameTimeComeInTheirOrder()
{
    DelayLine line(8, 8);
    for (const char *frame : {"a", "b", "c", "d", "e"})
        put(line, 5, frame);
    for (const char *frame : {"a", "b", "c", "d", "e"})
        QCOMPARE(take(line, 5), QByteArray(frame));
}

void tst_DelayLine::manyFramesComeInTheOrderOfTheirTimes()
{
    constexpr int count = 100;
    DelayLine line(count, 8);
    for (int i = 0; i < count; ++i) {
        const int due = i * 37 % count;  // each time once
        QVERIFY(put(line, due, QByteArray::number(due)));
    }
    for (int due = 0; due < count; ++due)
        QCOMPARE(take(line, count), QByteArray::number(due));
}

void tst_DelayLine::aFrameOfTheLargestSizeFits()
{
    DelayLine line(2, 8);
    QVERIFY(!put(line, 0, QByteArray(9, 'x')));
    QVERIFY(put(line, 0, QByteArray(8, 'x')));
    QVERIFY(put(line, 0, QByteArray(8, 'y')));
    QCOMPARE(take(line, 0), QByteArray(8, 'x'));
    QCOMPARE(take(line, 0), QByteArray(8, 'y'));
}

void tst_DelayLine::aFullLineTakesNothing()
{
    DelayLine line(2, 8);
    QVERIFY(put(line, 0, "a") && put(line, 0, "b"));
    QVERIFY(!put(line, 0, "c"));
    QCOMPARE(take(line, 0), QByteArray("a"));
    QVERIFY(!put(line, 0, "c"));  // the one that was taken is still read
    QCOMPARE(take(line, 0), QByteArray("b"));
    QVERIFY(put(line, 0, "c"));
    QCOMPARE(take(line, 0), QByteArray("c"));
}

void tst_DelayLine::framesOfAnOwnerAreForgotten()
{
    int kept = 0;
    int gone = 0;
    DelayLine line(4, 8);
    put(line, 4, "a", &kept);
    put(line, 1, "b", &gone);
    put(line, 3, "c", &gone);
    put(line, 2, "d", &kept);
    line.forget(&gone);
    QVERIFY(put(line, 5, "e") && put(line, 6, "f"));  // there is room again
    for (const char *frame : {"d", "a", "e", "f", "none"})
        QCOMPARE(take(line, 10), QByteArray(frame));
}

QTEST_APPLESS_MAIN(tst_DelayLine)
#include "tst_DelayLine.moc"
