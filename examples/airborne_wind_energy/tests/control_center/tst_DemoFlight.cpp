// SPDX-License-Identifier: Apache-2.0
#include "DemoFlight.h"
#include "Program.h"
#include "Screenshot.h"

#include <QtCore/QTemporaryDir>
#include <QtGui/QClipboard>
#include <QtTest/QtTest>
#include <QtWidgets/QAbstractButton>
#include <QtWidgets/QLabel>

#include <algorithm>
#include <csignal>

namespace {

/// The button that a person sees; null when there is none of this text.
QAbstractButton *visibleButton(const QWidget &window, const QString &text)
{
    for (QAbstractButton *button : window.findChildren<QAbstractButton *>()) {
        if (button->isVisible() && button->text().remove(QLatin1Char('&')).startsWith(text))
            return button;
    }
    return nullptr;
}

}  // namespace

/// The demo in the window, by a person with a mouse.
class tst_DemoFlight : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase();
    void cleanup();
    void oneClickOnTheStartPageFliesTheKite();
    void startPageOffersThePlants();
    void killedProgramIsReportedAndOneClickRestartsTheFlight_data();
    void killedProgramIsReportedAndOneClickRestartsTheFlight();
    void hintShowsTheProgramsOfTheDemo();
    void plantOfTheDemoIsForgottenWhenTheWindowCloses();

private:
    QTemporaryDir m_home;  // for the settings of the window
};

void tst_DemoFlight::initTestCase()
{
    QVERIFY(qputenv("XDG_CONFIG_HOME", m_home.path().toUtf8()));
}

void tst_DemoFlight::cleanup()
{
    QCOMPARE(childrenOf(QCoreApplication::applicationPid()), QList<qint64>());
}

void tst_DemoFlight::oneClickOnTheStartPageFliesTheKite()
{
    QPlcControlCenter window;
    awe::DemoFlight demo(&window);
    QSignalSpy flying(&demo, &awe::DemoFlight::flying);
    window.resize(1366, 768);
    window.show();
    QVERIFY(QTest::qWaitForWindowExposed(&window));
    QVERIFY(window.isStartPageShown());
    QAbstractButton *button = visibleButton(window, QStringLiteral("Fly the demo kite"));
    QVERIFY(button);
    QTest::mouseClick(button, Qt::LeftButton);
    QVERIFY(flying.wait(Program::patience));
    QVERIFY(!window.isStartPageShown());
    QCOMPARE(window.plants(), QStringList{QStringLiteral("demo")});
    QVERIFY(window.isConnected(QStringLiteral("demo")));
}

/// All three programs get the plant.
void tst_DemoFlight::startPageOffersThePlants()
{
    QPlcControlCenter window;
    awe::DemoFlight demo(&window);
    QSignalSpy flying(&demo, &awe::DemoFlight::flying);
    window.resize(1366, 768);
    window.show();
    QVERIFY(QTest::qWaitForWindowExposed(&window));
    QVERIFY(visibleButton(window, QStringLiteral("Fly the plant 'drag'")));
    QVERIFY(visibleButton(window, QStringLiteral("Fly the plant 'mast'")));
    QVERIFY(!visibleButton(window, QStringLiteral("Fly the plant 'thesis'")));
    QAbstractButton *button = visibleButton(window, QStringLiteral("Fly the plant 'realistic'"));
    QVERIFY(button);
    QString error;
    QVERIFY2(awe::writeScreenshot(&window, QStringLiteral(AWE_SCREENSHOTS "/awe_start_page.png"), &error),
             qPrintable(error));
    QTest::mouseClick(button, Qt::LeftButton);
    QVERIFY(flying.wait(Program::patience));
    QAbstractButton *parts = visibleButton(window, QStringLiteral("What is this built of?"));
    QVERIFY(parts);
    QTest::mouseClick(parts, Qt::LeftButton);
    int plants = 0;
    for (const QLabel *label : window.findChildren<QLabel *>())
        plants = std::max(plants, label->text().count(QStringLiteral("--plant=realistic")));
    QCOMPARE(plants, 3);
}

void tst_DemoFlight::killedProgramIsReportedAndOneClickRestartsTheFlight_data()
{
    QTest::addColumn<QByteArray>("victim");
    for (const char *name : {"awe_master", "awe_model", "awe_autopilot"})
        QTest::newRow(name) << QByteArray(name);
}

void tst_DemoFlight::killedProgramIsReportedAndOneClickRestartsTheFlight()
{
    QFETCH(QByteArray, victim);
    QPlcControlCenter window;
    awe::DemoFlight demo(&window);
    QSignalSpy flying(&demo, &awe::DemoFlight::flying);
    QSignalSpy failed(&demo, &awe::DemoFlight::failed);
    window.resize(1366, 768);
    window.show();
    QElapsedTimer clock;
    clock.start();
    demo.begin(clock);
    QVERIFY(flying.wait(Program::patience));
    ::kill(pid_t(childNamed(victim)), SIGKILL);
    QVERIFY(failed.wait(Program::patience));
    QVERIFY2(failed.at(0).at(0).toString().contains(QString::fromLatin1(victim)),
             qPrintable(failed.at(0).at(0).toString()));
    QTRY_VERIFY_WITH_TIMEOUT(!window.isLive(QStringLiteral("demo")), Program::patience);
    QAbstractButton *button = visibleButton(window, QStringLiteral("Restart the demo kite"));
    QVERIFY(button);
    QString error;
    QVERIFY2(
        awe::writeScreenshot(
            &window, QStringLiteral(AWE_SCREENSHOTS "/awe_restart_%1.png").arg(QString::fromLatin1(victim)), &error),
        qPrintable(error));
    QTest::mouseClick(button, Qt::LeftButton);
    QTRY_COMPARE_WITH_TIMEOUT(flying.size(), 2, Program::patience);
    QCOMPARE(window.plants(), QStringList{QStringLiteral("demo")});
    QCOMPARE(failed.size(), 1);
}

void tst_DemoFlight::hintShowsTheProgramsOfTheDemo()
{
    QPlcControlCenter window;
    awe::DemoFlight demo(&window);
    QSignalSpy flying(&demo, &awe::DemoFlight::flying);
    window.resize(1366, 768);
    window.show();
    QElapsedTimer clock;
    clock.start();
    demo.begin(clock);
    QVERIFY(flying.wait(Program::patience));
    const auto click = [&window](const char *text) {
        QAbstractButton *button = visibleButton(window, QString::fromLatin1(text));
        if (button)
            QTest::mouseClick(button, Qt::LeftButton);
        return button != nullptr;
    };
    QVERIFY(click("What is this built of?"));
    QVERIFY(visibleButton(window, QStringLiteral("Copy the commands")));
    const QLabel *hint = nullptr;
    for (const QLabel *label : window.findChildren<QLabel *>())
        hint = label->text().contains(QStringLiteral("./awe_model")) ? label : hint;
    QVERIFY(hint);
    QTRY_VERIFY_WITH_TIMEOUT(hint->visibleRegion().boundingRect().height() >= 5 * hint->fontMetrics().lineSpacing(),
                             Program::patience);
    QString error;
    QVERIFY2(awe::writeScreenshot(&window, QStringLiteral(AWE_SCREENSHOTS "/awe_parts.png"), &error),
             qPrintable(error));
    QGuiApplication::clipboard()->clear();
    QVERIFY(click("Copy the commands"));
    const QStringList lines = QGuiApplication::clipboard()->text().split(QLatin1Char('\n'));
    QCOMPARE(lines.size(), 5);  // the folder, three programs, and the end of the last line
    QVERIFY2(lines.at(0).startsWith(QStringLiteral("cd ")), qPrintable(lines.at(0)));
    const char *const programs[] = {"./awe_master --real-time --stay --port=", "./awe_model --master=udp://127.0.0.1:",
                                    "./awe_autopilot --master=udp://127.0.0.1:"};
    for (int i = 0; i < 3; ++i)
        QVERIFY2(lines.at(i + 1).startsWith(QLatin1String(programs[i]))
                     && lines.at(i + 1).endsWith(QLatin1String(" &")),
                 qPrintable(lines.at(i + 1)));
    QVERIFY(!lines.at(1).contains(QStringLiteral("--port=0")));
}

void tst_DemoFlight::plantOfTheDemoIsForgottenWhenTheWindowCloses()
{
    QPlcControlCenter window;
    awe::DemoFlight demo(&window);
    QSignalSpy flying(&demo, &awe::DemoFlight::flying);
    window.show();
    QElapsedTimer clock;
    clock.start();
    demo.begin(clock);
    QVERIFY(flying.wait(Program::patience));
    QVERIFY(window.close());
    QCOMPARE(window.plants(), QStringList());
}

QTEST_MAIN(tst_DemoFlight)
#include "tst_DemoFlight.moc"
