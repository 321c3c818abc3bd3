// SPDX-License-Identifier: Apache-2.0
#include "QPlcGauge.h"
#include "QPlcSignalIndexTable.h"

#include <QtGui/QImage>
#include <QtTest/QtTest>

namespace {

const QColor paper(Qt::white);

/// Where something is drawn between two lines of the picture.
QRect drawnIn(const QImage &image, const QRect &part)
{
    QRect drawn;
    for (int y = part.top(); y <= part.bottom(); ++y) {
        for (int x = part.left(); x <= part.right(); ++x) {
            if (image.pixelColor(x, y).lightness() < paper.lightness() - 100)
                drawn |= QRect(x, y, 1, 1);
        }
    }
    return drawn;
}

}  // namespace

/// What a person sees of the figures of gauges.
class tst_GaugeNumbers : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init();
    void figuresKeepTheirHeightWhileTheirDigitsChange_data();
    void figuresKeepTheirHeightWhileTheirDigitsChange();
    void dialsSideBySideHaveFiguresOfOneSize();

private:
    /// The height of the figures of \a gauge, which stand within \a part of it.
    static int heightOfFigures(QPlcGauge *gauge, const char *signal, const QPlcValue &value, const QRect &part);
};

void tst_GaugeNumbers::init()
{
    QPlcSignalIndexTable::setCurrent(QPlcSignalTable::fromIni(R"(
[open]
type = Real
[closed]
type = Real
min = -100
max = 100
[count]
type = Int32
[work]
type = Real
unit = J
)"));
}

int tst_GaugeNumbers::heightOfFigures(QPlcGauge *gauge, const char *signal, const QPlcValue &value, const QRect &part)
{
    QPlcSignalList list;
    list.insert(QString::fromLatin1(signal), value);
    gauge->realTimeout({list});
    gauge->hide();  // texts, too
    gauge->show();
    return drawnIn(gauge->grab().toImage().convertToFormat(QImage::Format_RGB32), part).height();
}

void tst_GaugeNumbers::figuresKeepTheirHeightWhileTheirDigitsChange_data()
{
    QTest::addColumn<QByteArray>("signal");
    QTest::addColumn<QVector<double>>("numbers");
    // Round digits have the same height: 0, 8.
    QTest::addRow("open") << QByteArray("open") << QVector<double>{8, 80, 880, 8888, 88000, 880000, 8000000, 0, 88.8};
    QTest::addRow("limits") << QByteArray("closed") << QVector<double>{8, 80, 0, 88, 0.8, 8.88};
    QTest::addRow("prefix") << QByteArray("work")
                            << QVector<double>{8, 80, 880, 8888, 88000, 880000, 8e6, 8.8e7, 88, 0, 8e9};
    QTest::addRow("integer") << QByteArray("count") << QVector<double>{8, 80, 880, 8888, 88000, 880000, 0};
}

void tst_GaugeNumbers::figuresKeepTheirHeightWhileTheirDigitsChange()
{
    QFETCH(QByteArray, signal);
    QFETCH(QVector<double>, numbers);
    QPlcGauge gauge;
    gauge.applySettings({{"signal", QString::fromLatin1(signal)}, {"style", "number"}, {"title", "x"}});
    gauge.resize(200, 90);
    const bool isInteger = signal == "count";
    int height = 0;
    for (const double number : numbers) {
        const QPlcValue value = isInteger ? QPlcValue(qint32(number)) : QPlcValue(float(number));
        const int now = heightOfFigures(&gauge, signal.constData(), value, QRect(2, 2, 196, 60));
        if (height == 0)
            height = now;
        QVERIFY2(height > 8 && now == height, qPrintable(QStringLiteral("%1: %2 px").arg(number).arg(now)));
    }
}

void tst_GaugeNumbers::dialsSideBySideHaveFiguresOfOneSize()
{
    int height = 0;
    for (const double maximum : {100.0, 40.0, 250.0, 4000.0}) {
        QPlcGauge dial;
        dial.applySettings(
            {{"signal", "open"}, {"style", "dial"}, {"minimum", 0}, {"maximum", maximum}, {"title", "x"}});
        dial.resize(152, 140);
        const int now = heightOfFigures(&dial, "open", QPlcValue(8.0f), QRect(52, 50, 48, 38));
        if (height == 0)
            height = now;
        QVERIFY2(height > 8 && now == height, qPrintable(QStringLiteral("%1: %2 px").arg(maximum).arg(now)));
    }
}

QTEST_MAIN(tst_GaugeNumbers)
#include "tst_GaugeNumbers.moc"
