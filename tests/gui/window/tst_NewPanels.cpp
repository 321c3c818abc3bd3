// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "WindowFixtures.h"
#include "gui/layout/EmptyPage.h"
#include "gui/layout/PanelFrame.h"
#include "gui/window/CommandPalette.h"

#include <QtWidgets/QListWidget>

using namespace qplc;

/// New panels of the window: how they are chosen by typing, and where they come.
class tst_NewPanels : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { m_settings = std::make_unique<TestSettings>(); }
    void ctrlNFindsAPanelByTypingAPartOfItsName();
    void everyAddButtonOpensTheSearchableMenu();
    void everyNewPanelHasAReadableSize_data();
    void everyNewPanelHasAReadableSize();

private:
    std::unique_ptr<TestSettings> m_settings;
};

void tst_NewPanels::ctrlNFindsAPanelByTypingAPartOfItsName()
{
    RunningMaster master;
    WindowFixture fixture;
    fixture.window.connectToMaster(master.address());
    const int before = fixture.part<LayoutView>()->findChildren<QPlcWidget *>().size();
    fixture.press(Qt::Key_N, Qt::ControlModifier);
    auto *palette = fixture.part<CommandPalette>();
    QVERIFY(palette->isVisible());
    QVERIFY(palette->list()->count() > 10);
    fixture.type(QStringLiteral("gau"));
    QCOMPARE(palette->list()->item(0)->text(), QStringLiteral("Gauge"));
    fixture.press(Qt::Key_Return);
    QVERIFY(!palette->isVisible());
    const QList<QPlcWidget *> widgets = fixture.part<LayoutView>()->findChildren<QPlcWidget *>();
    QCOMPARE(widgets.size(), before + 1);
    QVERIFY(std::any_of(widgets.begin(), widgets.end(),
                        [](const QPlcWidget *each) { return each->title() == QLatin1String("Gauge"); }));
    // Escape adds nothing.
    fixture.press(Qt::Key_N, Qt::ControlModifier);
    fixture.type(QStringLiteral("table"));
    fixture.press(Qt::Key_Escape);
    QCOMPARE(fixture.part<LayoutView>()->findChildren<QPlcWidget *>().size(), before + 1);
}

void tst_NewPanels::everyAddButtonOpensTheSearchableMenu()
{
    RunningMaster master;
    WindowFixture fixture;
    fixture.window.connectToMaster(master.address());
    auto *palette = fixture.part<CommandPalette>();
    const auto offered = [&] {
        QStringList texts;
        for (int row = 0; palette->isVisible() && row < palette->list()->count(); ++row)
            texts << palette->list()->item(row)->text();
        fixture.press(Qt::Key_Escape);
        return texts;
    };
    fixture.press(Qt::Key_N, Qt::ControlModifier);
    const QStringList byKey = offered();
    QVERIFY(byKey.size() > 10);
    auto *view = fixture.part<LayoutView>();
    QTest::mouseClick(view->findChild<QToolButton *>(QStringLiteral("addPanel")), Qt::LeftButton);
    QCOMPARE(offered(), byKey);
    fixture.press(Qt::Key_T, Qt::ControlModifier);  // a tab without panels
    const QList<EmptyPage *> pages = view->findChildren<EmptyPage *>();
    const auto shown
        = std::find_if(pages.begin(), pages.end(), [](const EmptyPage *page) { return page->isVisible(); });
    QVERIFY(shown != pages.end());
    QTest::mouseClick((*shown)->addButton(), Qt::LeftButton);
    QCOMPARE(offered(), byKey);
}

void tst_NewPanels::everyNewPanelHasAReadableSize_data()
{
    QTest::addColumn<QString>("type");
    QTest::addColumn<QSize>("least");
    QTest::newRow("gauge") << "Gauge" << QSize(150, 120);
    QTest::newRow("setter") << "Setter" << QSize(200, 100);
    QTest::newRow("time plot") << "Time plot" << QSize(300, 180);
    QTest::newRow("event log") << "Event log" << QSize(380, 150);
    QTest::newRow("node table") << "Node table" << QSize(300, 130);
}

void tst_NewPanels::everyNewPanelHasAReadableSize()
{
    QFETCH(QString, type);
    QFETCH(QSize, least);
    RunningMaster master;
    WindowFixture fixture;
    fixture.window.connectToMaster(master.address());
    auto *view = fixture.part<LayoutView>();
    QTRY_VERIFY(view->isVisible());
    QStringList added;
    for (int i = 0; i < 3; ++i) {
        added << view->addPanel(type);
        QCoreApplication::processEvents();
    }
    for (const QString &id : qAsConst(added)) {
        const QSize size = view->frame(id)->size();
        const QString text = QStringLiteral("%1 is %2 x %3 in %4 x %5")
                                 .arg(id)
                                 .arg(size.width())
                                 .arg(size.height())
                                 .arg(view->width())
                                 .arg(view->height());
        QVERIFY2(size.width() >= least.width() && size.height() >= least.height(), qPrintable(text));
        QVERIFY2(size.height() < view->height() * 8 / 10, qPrintable(text));  // no column of the whole page
    }
}

QTEST_MAIN(tst_NewPanels)
#include "tst_NewPanels.moc"
