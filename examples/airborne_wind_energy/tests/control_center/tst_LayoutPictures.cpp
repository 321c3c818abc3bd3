// SPDX-License-Identifier: Apache-2.0
#include "DemoFlight.h"
#include "Program.h"
#include "Screenshot.h"
#include "kite/WindWindow.h"

#ifdef QTPLC_HAS_GUI3D
#include "kite/KiteView.h"
#endif

#include <QtCore/QFile>
#include <QtCore/QTemporaryDir>
#include <QtGui/QImage>
#include <QtTest/QtTest>
#include <QtWidgets/QAbstractButton>
#include <QtWidgets/QLabel>
#include <QtWidgets/QToolButton>
#include <QtWidgets/QWidget>

namespace {

constexpr QSize smallestPanel(100, 80);  // [px]
const QColor firstCurve(0x00, 0x72, 0xb2);
const QColor secondCurve(0xd5, 0x5e, 0x00);

/// The panels that a person sees, from above to below.
QList<QWidget *> visiblePanels(const QWidget &window)
{
    QList<QWidget *> panels;
    for (QWidget *panel : window.findChildren<QWidget *>()) {
        if (panel->inherits("qplc::PanelFrame") && panel->isVisible())
            panels.append(panel);
    }
    return panels;
}

QRect placeIn(const QWidget &window, const QWidget &part)
{
    return {part.mapTo(&window, QPoint(0, 0)), part.size()};
}

/// Panels that are not wholly within the window, too small to be read, or on one another: none is
/// expected.
QStringList misplaced(const QWidget &window, const QList<QWidget *> &panels)
{
    QStringList names;
    for (const QWidget *panel : panels) {
        const QRect place = placeIn(window, *panel);
        const bool isSmall = place.width() < smallestPanel.width() || place.height() < smallestPanel.height();
        const bool isCovered = std::any_of(panels.begin(), panels.end(), [&](const QWidget *other) {
            return other != panel && placeIn(window, *other).intersects(place);
        });
        if (isSmall || isCovered || !window.rect().contains(place))
            names << panel->accessibleName();
    }
    return names;
}

/// Texts of buttons that have less room than they need.
QStringList cutTexts(const QWidget &window)
{
    QStringList texts;
    for (const QAbstractButton *button : window.findChildren<QAbstractButton *>()) {
        const auto *tool = qobject_cast<const QToolButton *>(button);
        const bool isIcon = tool && !tool->icon().isNull() && tool->toolButtonStyle() == Qt::ToolButtonIconOnly;
        if (button->isVisible() && !isIcon && button->width() < button->minimumSizeHint().width())
            texts << button->text();
    }
    return texts;
}

/// How many columns of the picture have the colour within a place: a curve has most of those over
/// which it goes.
int columnsOf(const QImage &image, const QRect &place, const QColor &color)
{
    int columns = 0;
    for (int x = place.left(); x <= place.right(); ++x) {
        for (int y = place.top(); y <= place.bottom(); ++y) {
            if (image.pixelColor(x, y) == color) {
                ++columns;
                break;
            }
        }
    }
    return columns;
}

/// How many colours a place has: a view that draws nothing has few.
int coloursOf(const QImage &image, const QRect &place)
{
    QSet<QRgb> seen;
    for (int x = place.left(); x <= place.right(); ++x) {
        for (int y = place.top(); y <= place.bottom(); ++y)
            seen.insert(image.pixel(x, y));
    }
    return seen.size();
}

}  // namespace

/// What the layouts of the example show of a flight, compared in structure: what is where, how
/// large, with which texts and curves.
class tst_LayoutPictures : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase();
    void everyPanelShowsTheFlight_data();
    void everyPanelShowsTheFlight();
    void cleanupTestCase();

private:
    QTemporaryDir m_home;  // for the settings of the windows
};

void tst_LayoutPictures::initTestCase()
{
    QVERIFY(qputenv("XDG_CONFIG_HOME", m_home.path().toUtf8()));
}

void tst_LayoutPictures::cleanupTestCase()
{
    QCOMPARE(childrenOf(QCoreApplication::applicationPid()), QList<qint64>());
}

void tst_LayoutPictures::everyPanelShowsTheFlight_data()
{
    QTest::addColumn<QString>("tab");
    QTest::addColumn<QStringList>("panels");
    QTest::addColumn<int>("curves");
    const auto row = [](const char *tab, const char *panels, int curves) {
        QTest::newRow(tab) << QString::fromLatin1(tab) << QString::fromUtf8(panels).split(QStringLiteral(", "))
                           << curves;
    };
    row("Fly", "3D view, Altitude, Speed, Length, Force, Wind window, Power, Keyboard control", 1);
    row("Ground station",
        "Tether speed, Tether length, Tether force, Power over tether length, Power, Mean, Energy, Tether speed, "
        "Pitch rate, Yaw rate",
        3);
    row("Real time", "Node table, Jitter histogram, Master, Nodes, Event log", 2);
}

void tst_LayoutPictures::everyPanelShowsTheFlight()
{
    QFETCH(QString, tab);
    QFETCH(QStringList, panels);
    QFETCH(int, curves);
    QPlcControlCenter window;
    window.addPanel<awe::WindWindow>();
#ifdef QTPLC_HAS_GUI3D
    window.addPanel<awe::KiteView>();
#endif
    QFile layout(QStringLiteral(AWE_LAYOUTS "/airborne_wind_energy.json"));
    QVERIFY(layout.open(QIODevice::ReadOnly) && window.addLayout(QStringLiteral("Kite"), layout.readAll()));
    window.resetLayout();
    window.setTheme(QPlcControlCenter::LightTheme);
    QVERIFY(window.showTab(tab));
    window.resize(1366, 768);
    window.move(0, 0);
    window.show();
    awe::DemoFlight demo(&window);
    QSignalSpy flying(&demo, &awe::DemoFlight::flying);
    QElapsedTimer clock;
    clock.start();
    demo.begin(clock);
    QVERIFY(flying.wait(Program::patience));
    QTest::qWait(4000);  // of flight in the curves

    const QList<QWidget *> shown = visiblePanels(window);
    QStringList titles;
    for (const QWidget *panel : shown)
        titles << panel->accessibleName();
    titles.sort();
    panels.sort();
    QCOMPARE(titles, panels);
    QCOMPARE(misplaced(window, shown), QStringList());
    QCOMPARE(cutTexts(window), QStringList());
    const QString file = QStringLiteral(AWE_SCREENSHOTS "/awe_layout_%1.png")
                             .arg(QString(tab).replace(QLatin1Char(' '), QLatin1Char('_')));
    QString error;
    QVERIFY2(awe::writeScreenshot(&window, file, &error), qPrintable(error));
    const QImage image(file);
    QCOMPARE(image.size(), window.size());
    int plots = 0;
    for (const QPlcTimePlot *plot : window.findChildren<QPlcTimePlot *>()) {
        if (!plot->isVisible())
            continue;
        ++plots;
        const QRect place = placeIn(window, *plot);
        const int columns = std::max(columnsOf(image, place, firstCurve), columnsOf(image, place, secondCurve));
        QVERIFY2(
            columns >= place.width() / 16,
            qPrintable(
                QStringLiteral("%1 columns of a curve in %2 of %3 pixels").arg(columns).arg(tab).arg(place.width())));
    }
    QCOMPARE(plots, curves);
    for (const QWidget *panel : shown)
        QVERIFY2(coloursOf(image, placeIn(window, *panel)) > 20, qPrintable(panel->accessibleName()));
    for (const QLabel *label : window.findChildren<QLabel *>())
        QVERIFY2(!label->isVisible() || !label->text().contains(QLatin1String("There is no signal")),
                 qPrintable(label->text()));
}

QTEST_MAIN(tst_LayoutPictures)
#include "tst_LayoutPictures.moc"
