// SPDX-License-Identifier: Apache-2.0
// Gauges write values with SI prefixes.
#include "QPlcGauge.h"
#include "QPlcSignalIndexTable.h"
#include "gui/gauges/GaugeFeed.h"

#include <QtTest/QtTest>
#include <QtWidgets/QLabel>

using namespace qplc;

namespace {

QPlcSignalTable prefixTable()
{
    return QPlcSignalTable::fromIni(R"(
[energy]
type = Real
unit = J
min = 0
max = 200000
[work]
type = Real
unit = J
[counter]
type = Int32
unit = J
)");
}

/// A feed without a window, to which a test gives values; each gets a text of its own.
class FreeFeed
{
public:
    explicit FreeFeed(const QJsonObject &settings)
        : m_signal(settings.value(QStringLiteral("signal")).toString())
    {
        QPlcSignalIndexTable::setCurrent(prefixTable());
        PanelSettings all = GaugeSettings::emptyJson();
        all.take(settings);
        m_feed.setSettings(GaugeSettings::from(all));
    }
    void add(double value)
    {
        const QPlcSignalIndex index = QPlcSignalIndexTable::index(m_signal);
        const bool isWhole = m_signal == QLatin1String("counter");
        QPlcSignalList list;
        list.insert(index, isWhole ? QPlcValue(qint32(value)) : QPlcValue(float(value)));
        m_feed.setActive(false);
        m_feed.add({list}, index);
        m_feed.setActive(true);
    }
    const GaugePicture &picture() const { return m_feed.picture(); }
    QString text() const { return m_feed.picture().values.first().text; }

private:
    QString m_signal;
    GaugeFeed m_feed;
};

}  // namespace

class tst_GaugePrefix : public QObject
{
    Q_OBJECT
private Q_SLOTS:
    void aRangeHasAPrefixThatStays();
    void aNumberWithoutRangeHasThePrefixOfItsSize();
    void theEditorNamesTheUnitOfTheTable();
};

void tst_GaugePrefix::aRangeHasAPrefixThatStays()
{
    FreeFeed feed({{"signal", "energy"}, {"extremes", true}});
    for (const auto &[value, text] : {std::pair(101108.0f, "101.1"), {500.0f, "0.5"}, {0.0f, "0.0"}, {2.0f, "0.0"}}) {
        feed.add(value);
        QCOMPARE(feed.text(), QString::fromLatin1(text));
        QCOMPARE(feed.picture().prefix.unit(), QStringLiteral("kJ"));
    }
    QCOMPARE(feed.picture().tickText(200000.0), QStringLiteral("200"));
    QCOMPARE(feed.picture().scale, (GaugeScale{0.0, 200000.0}));
    QCOMPARE(feed.picture().values.first().maximum, std::optional<double>(101108.0));  // as the table has it
    QCOMPARE(feed.picture().text(101108.0), QStringLiteral("101.1"));
    QVERIFY(feed.picture().spoken().contains(QStringLiteral("0.0 kJ")));
}

void tst_GaugePrefix::aNumberWithoutRangeHasThePrefixOfItsSize()
{
    for (const char *signal : {"work", "counter"}) {
        FreeFeed feed({{"signal", signal}, {"style", "number"}});
        const auto shown = [&](double value) {
            feed.add(value);
            return feed.text() + QLatin1Char(' ') + feed.picture().prefix.unit();
        };
        QCOMPARE(shown(101108.0), QStringLiteral("101.1 kJ"));
        QCOMPARE(shown(-101108.0), QStringLiteral("−101.1 kJ"));
        QCOMPARE(shown(999.0), QStringLiteral("0.999 kJ"));
        QCOMPARE(shown(30.0), QStringLiteral("0.030 kJ"));  // it may only pass zero
        QCOMPARE(shown(2.0e6), QStringLiteral("2000 kJ"));
        QCOMPARE(shown(20.0e6), QStringLiteral("20.00 MJ"));
        QCOMPARE(shown(0.0), QStringLiteral("0.000 MJ"));
    }
    FreeFeed number({{"signal", "counter"}, {"style", "number"}});
    number.add(8000);
    QCOMPARE(number.text(), QStringLiteral("8000"));  // whole while it has no prefix
    FreeFeed dial({{"signal", "work"}});
    dial.add(101108.0);
    QCOMPARE(dial.picture().prefix.unit(), QStringLiteral("kJ"));
    dial.add(1.0);
    QCOMPARE(dial.picture().prefix.unit(), QStringLiteral("kJ"));  // as its scale
}

void tst_GaugePrefix::theEditorNamesTheUnitOfTheTable()
{
    QPlcSignalIndexTable::setCurrent(prefixTable());
    QPlcGauge gauge;
    gauge.applySettings({{"signal", "energy"}});
    const std::unique_ptr<QWidget> editor(gauge.createSettingsEditor());
    QStringList labels;
    for (const QLabel *label : editor->findChildren<QLabel *>())
        labels << label->text();
    QVERIFY2(labels.contains(QStringLiteral("Scale to [J]")), qPrintable(labels.join(QLatin1Char(','))));
}

QTEST_MAIN(tst_GaugePrefix)
#include "tst_GaugePrefix.moc"
