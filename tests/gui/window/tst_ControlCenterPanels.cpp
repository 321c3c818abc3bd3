// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "QPlcPanelContext.h"
#include "QPlcSignalTree.h"
#include "QPlcWidgetFactoryOf.h"
#include "WindowFixtures.h"
#include "gui/layout/LayoutJson.h"
#include "gui/layout/LayoutTabBar.h"
#include "gui/layout/PanelFrame.h"
#include "gui/layout/PanelTitleBar.h"
#include "gui/models/ValueFormat.h"

#include <QtCore/QJsonArray>
#include <QtWidgets/QFileDialog>
#include <QtWidgets/QListWidget>
#include <QtWidgets/QMenu>
#include <QtWidgets/QTreeView>

using namespace qplc;

namespace {

/// Wants "count" and writes "setpoint", as a panel of a user.
class Listening : public QPlcWidget
{
public:
    using QPlcWidget::QPlcWidget;
    static QString typeName() { return QStringLiteral("Listening"); }
    QString kind() const override { return typeName(); }
    void contextChanged() override { hasContext = !context()->plants().isEmpty(); }
    void listen()
    {
        QPlcSignalIndexList list;
        list.insert(QStringLiteral("count"));
        setInputSignalIndices(list);
    }
    void write(double value)
    {
        QPlcSignalList list;
        list.insert(QStringLiteral("setpoint"), QPlcValue(value));
        Q_EMIT sendNewOutputSignals(list);
    }
    void realTimeout(const QList<QPlcSignalList> &signalValues) override
    {
        for (const QPlcSignalList &values : signalValues)
            counts.append(values.value(QStringLiteral("count")).toInt());
    }
    bool hasContext = false;
    QVector<int> counts;
};

bool isInAMenuOfAPanel(const QAction *action)
{
    for (const QWidget *each : action->associatedWidgets()) {
        for (const QWidget *widget = each; qobject_cast<const QMenu *>(each) && widget;
             widget = widget->parentWidget()) {
            if (qobject_cast<const PanelFrame *>(widget))
                return true;
        }
    }
    return false;
}

}  // namespace

/// Commands, keys, panels and layouts of the window, as a person uses them.
class tst_ControlCenterPanels : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { m_settings = std::make_unique<TestSettings>(); }
    void everyActionHasKeysOrIsInThePalette();
    void paletteRunsTheTypedCommand();
    void signalsOfTheTreeArePlottedByEnterAndUndone();
    void droppedSignalsAreSteps();
    void aDropOnAPanelIsOneStep_data();
    void aDropOnAPanelIsOneStep();
    void invalidLayoutFileIsReportedInTheWindow();
    void layoutsKeepUnknownKeysAndTypes();
    void aLayoutFromBeforeThePanelApiOpens();
    void unpaintedPanelHasThePanelColour();
    void valuesReachPanelsThatWantThem();
    void keysAreListed();
    void focusMovesByKeys();
    void keysOfTheFocusedPanelTakePrecedence();

private:
    std::unique_ptr<TestSettings> m_settings;
};

void tst_ControlCenterPanels::everyActionHasKeysOrIsInThePalette()
{
    RunningMaster master;
    WindowFixture fixture;
    fixture.window.connectToMaster(master.address());
    QTRY_VERIFY(fixture.plant()->table().size() > 0);
    fixture.press(Qt::Key_K, Qt::ControlModifier);
    auto *palette = fixture.part<CommandPalette>();
    QVERIFY(palette->isVisible());
    QMap<QString, QStringList> keys;
    for (const QAction *action : fixture.window.findChildren<QAction *>()) {
        const QString text = action->text().remove(QLatin1Char('&'));
        if (text.isEmpty() || action->menu() || !action->isEnabled() || isInAMenuOfAPanel(action))
            continue;
        palette->line()->setText(text);
        const bool isFound
            = palette->list()->count() > 0 && !palette->list()->findItems(text, Qt::MatchExactly).isEmpty();
        QVERIFY2(isFound || !action->shortcuts().isEmpty(), qPrintable(text));
        for (const QKeySequence &sequence : action->shortcuts()) {
            if (action->shortcutContext() == Qt::WindowShortcut)
                keys[sequence.toString()].append(text);
        }
    }
    for (auto each = keys.begin(); each != keys.end(); ++each)
        QVERIFY2(each.value().size() == 1,
                 qPrintable(each.key() + QLatin1String(": ") + each.value().join(QLatin1Char(','))));
    palette->line()->setText(QStringLiteral("setpoint"));
    QVERIFY(!palette->list()->findItems(QStringLiteral("setpoint"), Qt::MatchExactly).isEmpty());
}

void tst_ControlCenterPanels::paletteRunsTheTypedCommand()
{
    WindowFixture fixture;
    DummyFactories factories;
    for (QPlcWidgetFactory *factory : factories.all())
        fixture.window.addAvailableWidget(factory);
    fixture.press(Qt::Key_K, Qt::ControlModifier);
    fixture.type(QStringLiteral("dark theme"));
    fixture.press(Qt::Key_Return);
    QCOMPARE(fixture.window.theme(), QPlcControlCenter::DarkTheme);
    QVERIFY(fixture.part<CommandPalette>()->isHidden());
    const QByteArray before = fixture.window.layoutJson();
    fixture.press(Qt::Key_K, Qt::ControlModifier);
    fixture.type(QStringLiteral("add gauge"));
    fixture.press(Qt::Key_Return);
    QVERIFY(fixture.window.layoutJson() != before);
    QVERIFY(fixture.window.layoutJson().contains("\"Gauge\""));
    fixture.press(Qt::Key_Z, Qt::ControlModifier);
    QCOMPARE(fixture.window.layoutJson(), before);
    fixture.press(Qt::Key_K, Qt::ControlModifier);
    fixture.press(Qt::Key_Escape);
    QVERIFY(fixture.part<CommandPalette>()->isHidden());
}

void tst_ControlCenterPanels::signalsOfTheTreeArePlottedByEnterAndUndone()
{
    RunningMaster master;
    WindowFixture fixture;
    fixture.window.connectToMaster(master.address());
    QTRY_VERIFY(fixture.plant()->table().size() > 0);
    fixture.press(Qt::Key_F, Qt::ControlModifier);
    fixture.type(QStringLiteral("setpoint"));
    fixture.press(Qt::Key_Down);
    auto *tree = fixture.part<SignalDock>()->tree()->findChild<QTreeView *>();
    const auto selectSignal = [&] {
        fixture.press(Qt::Key_End);
        return fixture.part<SignalDock>()->tree()->selectedReferences() == QStringList{QStringLiteral("setpoint")};
    };
    QTRY_VERIFY(selectSignal());
    QVERIFY(tree->hasFocus());
    const QByteArray before = fixture.window.layoutJson();
    for (const auto &[key, type] :
         {std::pair(Qt::Key_Return, "Time plot"), std::pair(Qt::Key_G, "Gauge"), std::pair(Qt::Key_W, "Value table")}) {
        tree->setFocus();
        fixture.press(key);
        const Layout layout = *layoutFromJson(fixture.window.layoutJson());
        const LayoutPanel *added = nullptr;
        for (const LayoutPanel *panel : layout.panels()) {
            if (QJsonDocument(panel->settings).toJson().contains("setpoint"))
                added = panel;
        }
        QVERIFY2(added, type);
        QCOMPARE(added->type, QString::fromLatin1(type));
        fixture.press(Qt::Key_Z, Qt::ControlModifier);
        QCOMPARE(fixture.window.layoutJson(), before);
    }
}

void tst_ControlCenterPanels::droppedSignalsAreSteps()
{
    WindowFixture fixture;
    fixture.window.connectToMaster(QStringLiteral("127.0.0.1:%1").arg(freePort()));
    auto *view = fixture.part<LayoutView>();
    const QByteArray before = fixture.window.layoutJson();
    const std::unique_ptr<QMimeData> data = mimeDataOf({SignalReference::fromString(QStringLiteral("kite.elevation"))});
    PanelFrame *frame = view->findChildren<PanelFrame *>().first();
    const QPoint below(frame->width() / 2, frame->height() - 5);
    QDragEnterEvent enter(below, Qt::CopyAction, data.get(), Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(frame, &enter);
    QDropEvent drop(below, Qt::CopyAction, data.get(), Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(frame, &drop);
    QVERIFY(fixture.window.layoutJson().contains("kite.elevation"));
    fixture.press(Qt::Key_Z, Qt::ControlModifier);
    QCOMPARE(fixture.window.layoutJson(), before);
    fixture.press(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
    QVERIFY(fixture.window.layoutJson().contains("kite.elevation"));
}

void tst_ControlCenterPanels::aDropOnAPanelIsOneStep_data()
{
    QTest::addColumn<QString>("type");
    for (const char *type : {"Time plot", "Gauge", "Value table", "Setter"})
        QTest::newRow(type) << QString::fromLatin1(type);
}

void tst_ControlCenterPanels::aDropOnAPanelIsOneStep()
{
    QFETCH(QString, type);
    WindowFixture fixture;
    fixture.window.connectToMaster(QStringLiteral("127.0.0.1:%1").arg(freePort()));
    auto *view = fixture.part<LayoutView>();
    LayoutEditor *editor = view->editor();
    const QString id = editor->addPanel(type, {}, LayoutTarget::inTab(editor->layout().currentTab().id));
    QVector<QByteArray> states{fixture.window.layoutJson()};
    const int steps = editor->undoStack()->count();
    for (const char *signal : {"kite.elevation", "winch.speed", "kite.azimuth"}) {
        const std::unique_ptr<QMimeData> data = mimeDataOf({SignalReference::fromString(QString::fromLatin1(signal))});
        PanelFrame *frame = view->frame(id);
        QDragEnterEvent enter(frame->rect().center(), Qt::CopyAction, data.get(), Qt::LeftButton, Qt::NoModifier);
        QApplication::sendEvent(frame, &enter);
        QDropEvent drop(frame->rect().center(), Qt::CopyAction, data.get(), Qt::LeftButton, Qt::NoModifier);
        QApplication::sendEvent(frame, &drop);
        states.append(fixture.window.layoutJson());
        QVERIFY(states.last().contains(signal));
        QCOMPARE(editor->undoStack()->count(), steps + states.size() - 1);
    }
    while (states.size() > 1) {
        QCOMPARE(fixture.window.layoutJson(), states.takeLast());
        editor->undoStack()->undo();
    }
    QCOMPARE(fixture.window.layoutJson(), states.first());
    QCOMPARE(editor->layout().panel(id)->settings, QJsonObject());
}

void tst_ControlCenterPanels::invalidLayoutFileIsReportedInTheWindow()
{
    QTemporaryDir folder;
    const QString name = folder.filePath(QStringLiteral("broken.json"));
    QFile file(name);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("{\n  \"tabs\": nonsense\n}\n");
    file.close();
    WindowFixture fixture;
    const QByteArray before = fixture.window.layoutJson();
    fixture.press(Qt::Key_O, Qt::ControlModifier | Qt::ShiftModifier);
    auto *dialog = fixture.part<QFileDialog>();
    QVERIFY(dialog && !dialog->isModal());
    Q_EMIT dialog->fileSelected(name);
    QVERIFY2(fixture.hint().startsWith(name + QLatin1String(":2:")), qPrintable(fixture.hint()));
    QCOMPARE(fixture.window.layoutJson(), before);
    delete dialog;
    QString error;
    QVERIFY(!fixture.window.saveLayout(QStringLiteral("/nowhere/a.json"), &error));
    QVERIFY2(error.contains(QLatin1String("/nowhere/a.json")), qPrintable(error));
    fixture.window.showHint(QString());
    QCOMPARE(fixture.hint(), QString());
}

void tst_ControlCenterPanels::layoutsKeepUnknownKeysAndTypes()
{
    QTemporaryDir folder;
    WindowFixture fixture;
    QJsonObject json = QJsonDocument::fromJson(fixture.window.layoutJson()).object();
    json.insert(QStringLiteral("ofAnotherProgram"), 42);
    QByteArray wanted = QJsonDocument(json).toJson();
    QVERIFY(fixture.window.addLayout(QStringLiteral("Other"), wanted.replace("Jitter histogram", "Unheard of")));
    QVERIFY(fixture.window.showLayout(QStringLiteral("Other")));
    const QString name = folder.filePath(QStringLiteral("a.json"));
    QVERIFY(fixture.window.saveLayout(name));
    fixture.window.resetLayout();
    QVERIFY(fixture.window.openLayout(name));
    QVERIFY(fixture.window.layoutJson().contains("ofAnotherProgram"));
    QVERIFY(fixture.window.layoutJson().contains("Unheard of"));
    QVERIFY(!fixture.window.showLayout(QStringLiteral("nobody")));
}

/// Saved when each kind of panel had a number, and the wind window belonged to the library.
void tst_ControlCenterPanels::aLayoutFromBeforeThePanelApiOpens()
{
    WindowFixture fixture;
    QString error;
    const QString name = QStringLiteral(QTPLC_TEST_FOLDER "/layout_with_kite.json");
    QVERIFY2(fixture.window.openLayout(name, &error), qPrintable(error));
    QFile file(name);
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QByteArray saved = file.readAll();
    QCOMPARE(QJsonDocument::fromJson(fixture.window.layoutJson()), QJsonDocument::fromJson(saved));
    const auto *view = fixture.part<LayoutView>();
    QStringList missing;
    for (const LayoutPanel *panel : view->editor()->layout().panels()) {
        if (!view->widget(panel->id) && !missing.contains(panel->type))
            missing << panel->type;
    }
    QCOMPARE(missing, QStringList({QStringLiteral("3D view"), QStringLiteral("Wind window")}));
}

void tst_ControlCenterPanels::unpaintedPanelHasThePanelColour()
{
    QPlcWidgetFactoryOf<Listening> factory;
    WindowFixture fixture;
    fixture.window.addAvailableWidget(&factory);
    fixture.window.connectToMaster(QStringLiteral("127.0.0.1:%1").arg(freePort()));
    auto *view = fixture.part<LayoutView>();
    const QString id = view->editor()->addPanel(Listening::typeName(), {},
                                                LayoutTarget::inTab(view->editor()->layout().currentTab().id));
    QPlcWidget *panel = view->widget(id);
    QVERIFY(waitUntil([panel] { return panel->isVisible(); }));
    for (const QPlcControlCenter::Theme theme : {QPlcControlCenter::DarkTheme, QPlcControlCenter::LightTheme}) {
        fixture.window.setTheme(theme);
        const QImage picture = panel->parentWidget()->grab().toImage();
        QCOMPARE(picture.pixelColor(panel->geometry().center()), panel->context()->theme().surface);
    }
}

void tst_ControlCenterPanels::valuesReachPanelsThatWantThem()
{
    QPlcSignalIndexTable::setCurrent(testTable());
    RunningMaster master;
    QVERIFY(master.startRealTime());
    QPlcWidgetFactoryOf<Listening> factory;
    WindowFixture fixture;
    fixture.window.addAvailableWidget(&factory);
    fixture.window.connectToMaster(master.address());
    auto *view = fixture.part<LayoutView>();
    const QString id = view->editor()->addPanel(Listening::typeName(), {},
                                                LayoutTarget::inTab(view->editor()->layout().currentTab().id));
    auto *panel = static_cast<Listening *>(view->widget(id));
    QVERIFY(panel->hasContext);
    panel->listen();
    QTRY_VERIFY(panel->counts.size() > 30);
    for (int i = 1; i < panel->counts.size(); ++i)
        QVERIFY(panel->counts[i] > panel->counts[i - 1]);
    panel->write(3.25);
    QTRY_COMPARE(fixture.plant()->value(testTable().indexOf(QStringLiteral("setpoint"))).toReal(), 3.25);
    view->editor()->closePanel(id);
}

void tst_ControlCenterPanels::keysAreListed()
{
    WindowFixture fixture;
    fixture.press(Qt::Key_F1);
    auto *keys = fixture.part<KeysWindow>();
    QVERIFY(keys->isVisible() && !keys->isModal());
    const QStringList all = keys->keys();
    for (const char *wanted : {"F5", "Ctrl+K", "Ctrl+.", "L", "F6", "Return", "G", "Ctrl+Z"})
        QVERIFY2(all.contains(QString::fromLatin1(wanted)), wanted);
}

void tst_ControlCenterPanels::focusMovesByKeys()
{
    WindowFixture fixture;
    fixture.window.connectToMaster(QStringLiteral("127.0.0.1:%1").arg(freePort()));
    auto *view = fixture.part<LayoutView>();
    fixture.press(Qt::Key_F, Qt::ControlModifier);
    QVERIFY(fixture.part<SignalDock>()->tree()->findChild<QLineEdit *>()->hasFocus());
    fixture.press(Qt::Key_F6);
    const auto *first = qobject_cast<PanelTitleBar *>(QApplication::focusWidget());
    QVERIFY(first);
    fixture.press(Qt::Key_F6);
    QVERIFY(qobject_cast<PanelTitleBar *>(QApplication::focusWidget()));
    QVERIFY(QApplication::focusWidget() != first);
    QCOMPARE(view->tabBar()->currentIndex(), 0);
    fixture.press(Qt::Key_Tab, Qt::ControlModifier);
    QCOMPARE(view->tabBar()->currentIndex(), 1);
}

void tst_ControlCenterPanels::keysOfTheFocusedPanelTakePrecedence()
{
    QPlcWidgetFactoryOf<Listening> factory;
    WindowFixture fixture;
    fixture.window.addAvailableWidget(&factory);
    fixture.window.connectToMaster(QStringLiteral("127.0.0.1:%1").arg(freePort()));
    auto *view = fixture.part<LayoutView>();
    const QString id = view->editor()->addPanel(Listening::typeName(), {},
                                                LayoutTarget::inTab(view->editor()->layout().currentTab().id));
    QPlcWidget *panel = view->widget(id);
    panel->setFocusPolicy(Qt::StrongFocus);
    auto *own = new QAction(QStringLiteral("of the panel"), panel);
    own->setShortcut(Qt::Key_L);
    own->setShortcutContext(Qt::WidgetWithChildrenShortcut);
    panel->addAction(own);
    QSignalSpy triggered(own, &QAction::triggered);
    fixture.window.context()->timeAxis()->freeze();
    panel->setFocus();
    fixture.press(Qt::Key_L);
    QCOMPARE(triggered.count(), 1);
    QVERIFY(!fixture.window.context()->timeAxis()->isLive());
    fixture.part<SignalDock>()->tree()->findChild<QTreeView *>()->setFocus();
    fixture.press(Qt::Key_L);
    QCOMPARE(triggered.count(), 1);
    QVERIFY(fixture.window.context()->timeAxis()->isLive());
    view->editor()->closePanel(id);
}

QTEST_MAIN(tst_ControlCenterPanels)
#include "tst_ControlCenterPanels.moc"
