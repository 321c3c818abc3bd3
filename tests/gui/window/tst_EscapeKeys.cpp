// SPDX-License-Identifier: Apache-2.0
#include "../../common/Waiting.h"
#include "QPlcEventLog.h"
#include "QPlcSignalTree.h"
#include "QPlcTimePlot.h"
#include "QPlcValueTable.h"
#include "WindowFixtures.h"
#include "gui/layout/InlineEdit.h"
#include "gui/layout/PanelFrame.h"
#include "gui/layout/PanelTitleBar.h"
#include "gui/window/DoubleEscape.h"
#include "gui/window/StopNotice.h"

#include <QtWidgets/QComboBox>
#include <QtWidgets/QFileDialog>
#include <QtWidgets/QMenu>
#include <QtWidgets/QSlider>

#include <functional>
#include <random>

using namespace qplc;

namespace {

/// Something that a person opens, begins or enters, and leaves by Escape or by the mouse.
struct Thing
{
    QString name;
    std::function<bool()> open;  // false: not possible now
    std::function<bool()> isOpen;
    std::function<void()> let = {};  // of the mouse; empty: Escape ends it
};

bool isPopupOpen()
{
    return QApplication::activePopupWidget() != nullptr;
}

/// The window that has the keyboard. The window system of these tests leaves it with windows that
/// are closed.
QWindow *keyboardWindow()
{
    if (const QWidget *popup = QApplication::activePopupWidget())
        return popup->windowHandle();
    if (!QApplication::activeWindow()) {
        const QWidgetList windows = QApplication::topLevelWidgets();
        for (QWidget *each : windows) {
            if (qobject_cast<QPlcControlCenter *>(each)) {
                each->activateWindow();
                return each->windowHandle();
            }
        }
    }
    return QApplication::activeWindow()->windowHandle();
}

int escapes = 0;  // presses so far

/// A key as a keyboard sends it: to the window that has the focus, also through shortcuts.
/// \return when it was pressed [ms]
qint64 pressKey(Qt::Key key)
{
    QTest::qWait(2);  // presses of one millisecond would be one press
    escapes += key == Qt::Key_Escape ? 1 : 0;
    QElapsedTimer pressed;
    pressed.start();
    QTest::keyPress(keyboardWindow(), key);
    QCoreApplication::processEvents();
    QTest::keyRelease(keyboardWindow(), key);  // another one where the key has closed a window
    QCoreApplication::processEvents();
    return pressed.msecsSinceReference();
}

QAction *actionOf(QWidget *widget, const char *text)
{
    for (QAction *each : widget->actions()) {
        if (each->text().remove(QLatin1Char('&')) == QLatin1String(text))
            return each;
    }
    qFatal("there is no action '%s'", text);
    return nullptr;
}

/// Of a program that does nothing on Escape: the first one ends what a person was typing.
class ForeignField : public QLineEdit
{
public:
    using QLineEdit::QLineEdit;
    bool wasLeft = false;

protected:
    void keyPressEvent(QKeyEvent *event) override
    {
        wasLeft = wasLeft || event->key() == Qt::Key_Escape;
        QLineEdit::keyPressEvent(event);
    }
};

/// A window with a flying plant and panels in which there is much to open.
struct FlyingWindow : WindowFixture
{
    FlyingWindow()
        : stops(part<DoubleEscape>(), &DoubleEscape::pressed)
    {
        isReady = master.startRealTime();
        window.connectToMaster(master.address());
        isReady = isReady && waitUntil([this] { return plant()->status().isRunning(); });
        auto *editor = part<LayoutView>()->editor();
        editor->addTab();
        const LayoutTarget here = LayoutTarget::inTab(editor->layout().currentTab().id);
        const QString signal = QStringLiteral("setpoint");
        const auto add = [&](const char *type, const QJsonObject &settings = {}) {
            ids << editor->addPanel(QLatin1String(type), settings, here);
            return part<LayoutView>()->widget(ids.last());
        };
        add("Setter", {{QStringLiteral("signal"), signal}});
        number = part<LayoutView>()->widget(ids.last())->findChild<QLineEdit *>();
        slider
            = add("Setter", {{QStringLiteral("signal"), signal}, {QStringLiteral("style"), QStringLiteral("slider")}})
                  ->findChild<QSlider *>();
        events = add("Event log");
        values = add("Value table");
        plot = add("Time plot");
        tree = part<SignalDock>()->tree();
        makeThings();
        isReady = isReady && waitUntil([this] { return number->isEnabled() && slider->isEnabled(); });
    }

    bool pressEscapeTwice(int pause = 0);
    void makeThings();
    void makeEdits();
    void makeDrags();
    void addMenu(const QString &name, const std::function<void()> &open)
    {
        things.append({name,
                       [open] {
                           if (isPopupOpen())
                               return false;
                           open();
                           return isPopupOpen();
                       },
                       [] { return isPopupOpen(); }});
    }
    /// A field into which a person types. \param enter  gives it the keyboard
    void addEdit(const QString &name, const std::function<QLineEdit *()> &enter)
    {
        const auto field = std::make_shared<QPointer<QLineEdit>>();
        things.append({name,
                       [field, enter] {
                           if (isPopupOpen())
                               return false;
                           *field = enter();
                           QTest::keyClicks(field->data(), QStringLiteral("2"));
                           QCoreApplication::processEvents();
                           return QApplication::focusWidget() == field->data() && (*field)->isVisible();
                       },
                       [field] { return false; }});
        things.last().isOpen = [field] {
            return *field && (*field)->isVisible() && QApplication::focusWidget() == *field && (*field)->isModified()
                && (*field)->text().contains(QLatin1Char('2'));
        };
    }
    /// A mouse button that goes down on \a target and moves. The first Escape ends what is dragged.
    void addDrag(const QString &name, const std::function<QWidget *()> &target)
    {
        const auto dragged = std::make_shared<QPointer<QWidget>>();
        const auto begin = std::make_shared<int>(0);
        things.append({name,
                       [dragged, begin, target] {
                           if (isPopupOpen() || *dragged)
                               return false;
                           *begin = escapes;
                           *dragged = target();
                           const QPoint at = (*dragged)->rect().center();
                           QTest::mousePress(*dragged, Qt::LeftButton, Qt::NoModifier, at);
                           for (int step = 1; step < 5; ++step)
                               QTest::mouseMove(*dragged, at + QPoint(8 * step, 3 * step));
                           return true;
                       },
                       [dragged, begin] {
                           return *dragged && escapes == *begin && QGuiApplication::mouseButtons() != Qt::NoButton;
                       },
                       [dragged] {
                           if (*dragged)
                               QTest::mouseRelease(*dragged, Qt::LeftButton, Qt::NoModifier,
                                                   (*dragged)->rect().center());
                           dragged->clear();
                       }});
    }

    FlyingMaster master;
    QSignalSpy stops;
    QStringList ids;
    QLineEdit *number = nullptr;
    QSlider *slider = nullptr;
    QWidget *events = nullptr;
    QWidget *values = nullptr;
    QWidget *plot = nullptr;
    QWidget *tree = nullptr;
    QVector<Thing> things;
    bool isReady = false;
};

/// What stops the plant. \param pause  between the presses [ms]
/// \return whether the first one stopped nothing, and the second one the plant. A computer may be
///         too slow between two presses: then a person presses again
bool FlyingWindow::pressEscapeTwice(int pause)
{
    constexpr qint64 longestPause = 590;  // [ms], and some for the way of a press
    qint64 before = pressKey(Qt::Key_Escape);
    QTest::qWait(pause);
    if (!stops.isEmpty() || master.state() != QPlcMasterNode::RealTime)
        return false;
    for (bool isTooSlow = true; isTooSlow && stops.isEmpty();) {
        const qint64 now = pressKey(Qt::Key_Escape);
        isTooSlow = now - before > longestPause;
        before = now;
    }
    return !stops.isEmpty();
}

void FlyingWindow::makeThings()
{
    for (QMenu *menu : window.findChildren<QMenu *>()) {
        if (!menu->title().isEmpty())
            addMenu(QStringLiteral("menu ") + menu->title(),
                    [this, menu] { menu->popup(window.mapToGlobal(QPoint(100, 60))); });
    }
    addMenu(QStringLiteral("palette"), [this] { action("Commands...")->trigger(); });
    addMenu(QStringLiteral("new panel"), [this] { Q_EMIT part<LayoutView>()->addRequested(); });
    addMenu(QStringLiteral("list of severities"), [this] { events->findChild<QComboBox *>()->showPopup(); });
    addMenu(QStringLiteral("menu of a panel"), [this] {
        QContextMenuEvent event(QContextMenuEvent::Mouse, {}, window.mapToGlobal(QPoint(300, 200)));
        QCoreApplication::sendEvent(part<LayoutView>()->frame(ids.at(4)), &event);
    });
    addMenu(QStringLiteral("settings of a panel"),
            [this] { actionOf(part<LayoutView>()->frame(ids.at(4)), "Settings")->trigger(); });
    things.append({QStringLiteral("strip"),
                   [this] {
                       if (isPopupOpen())
                           return false;
                       action("Connect...")->trigger();
                       return part<ConnectStrip>()->isVisible();
                   },
                   [this] { return part<ConnectStrip>()->isVisible() && part<ConnectStrip>()->line()->hasFocus(); }});
    for (const char *text : {"Keys", "Open..."})
        things.append({QLatin1String(text),
                       [this, text] {
                           if (isPopupOpen() || QApplication::activeWindow() != &window
                               || QGuiApplication::mouseButtons() != Qt::NoButton)
                               return false;
                           action(text)->trigger();
                           return waitUntil(
                               [] { return qobject_cast<QDialog *>(QApplication::activeWindow()) != nullptr; }, 1000);
                       },
                       [] { return qobject_cast<QDialog *>(QApplication::activeWindow()) != nullptr; }});
    makeEdits();
    makeDrags();
}

void FlyingWindow::makeEdits()
{
    const auto focused = [](QLineEdit *line) {
        line->setFocus();
        line->selectAll();
        return line;
    };
    addEdit(QStringLiteral("number"), [this, focused] { return focused(number); });
    addEdit(QStringLiteral("search of signals"), [this, focused] { return focused(tree->findChild<QLineEdit *>()); });
    addEdit(QStringLiteral("search of events"),
            [this, focused] { return focused(events->findChild<QLineEdit *>(QStringLiteral("search"))); });
    addEdit(QStringLiteral("note"), [this] {
        part<NoteStrip>()->open();
        return part<NoteStrip>()->line();
    });
    addEdit(QStringLiteral("search of values"), [this] {
        actionOf(values, "Search in the table")->trigger();
        return qobject_cast<QLineEdit *>(QApplication::focusWidget());
    });
    addEdit(QStringLiteral("title of a panel"), [this] {
        auto *frame = part<LayoutView>()->frame(ids.at(4));
        frame->renameAction()->trigger();
        return static_cast<QLineEdit *>(frame->findChild<InlineEdit *>());
    });
    auto *foreign = new ForeignField(part<LayoutView>()->widget(ids.at(4)));
    foreign->resize(60, 20);
    foreign->show();
    addEdit(QStringLiteral("field of a program"), [focused, foreign] {
        foreign->wasLeft = false;
        return focused(foreign);
    });
    things.last().isOpen = [foreign] { return foreign->hasFocus() && !foreign->wasLeft; };
}

void FlyingWindow::makeDrags()
{
    addDrag(QStringLiteral("drag of a panel"),
            [this] { return part<LayoutView>()->frame(ids.at(3))->findChild<PanelTitleBar *>(); });
    addDrag(QStringLiteral("drag of a slider"), [this] { return slider; });
    addDrag(QStringLiteral("drag of a plot"), [this] { return plot; });
}

}  // namespace

/// Escape twice stops the plant, and Escape that leaves something does not.
class tst_EscapeKeys : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void init() { m_settings = std::make_unique<TestSettings>(); }
    void escapeTwiceWithNothingOpenStopsThePlantAndShowsIt();
    void noticeShowsWhichPersonStoppedThePlant();
    void withAnythingOpenEscapeNeverStops();
    void aListWithTheFocusKeepsNoEscape();
    void escapeEndsADragAndTwiceMoreStops();

private:
    std::unique_ptr<TestSettings> m_settings;
};

void tst_EscapeKeys::escapeTwiceWithNothingOpenStopsThePlantAndShowsIt()
{
    FlyingWindow fixture;
    QVERIFY(fixture.isReady);
    const auto *notice = fixture.part<StopNotice>();
    QVERIFY(!notice->isVisible());
    fixture.plot->setFocus();
    QVERIFY(fixture.pressEscapeTwice(50));
    const QDateTime before = QDateTime::currentDateTime();
    QTRY_COMPARE(fixture.master.state(), QPlcMasterNode::Off);
    QTRY_VERIFY(notice->isVisible());
    const QRegularExpression line(
        QStringLiteral("^Stopped by you \\(Esc Esc\\), (\\d\\d:\\d\\d:\\d\\d)\\. Start again: F5$"));
    const QRegularExpressionMatch match = line.match(notice->text());
    QVERIFY2(match.hasMatch(), qPrintable(notice->text()));
    QVERIFY(qAbs(QTime::fromString(match.captured(1)).secsTo(before.time())) <= 20);
    QTest::qWait(700);  // it stays, over polls of the state
    QVERIFY(notice->isVisible());
    pressKey(Qt::Key_F5);
    QTRY_COMPARE(fixture.master.state(), QPlcMasterNode::RealTime);
    QTRY_VERIFY(!notice->isVisible());
}

void tst_EscapeKeys::noticeShowsWhichPersonStoppedThePlant()
{
    FlyingWindow fixture;
    QVERIFY(fixture.isReady);
    const auto *notice = fixture.part<StopNotice>();
    QTest::mouseClick(fixture.topBar()->stopButton(), Qt::LeftButton);
    QTRY_VERIFY(notice->text().startsWith(QLatin1String("Stopped by you (STOP), ")));
    QVERIFY(fixture.master.startRealTime());
    QTRY_VERIFY(!notice->isVisible());

    Plant other(fixture.master.address(), QString(), QStringLiteral("Other"));
    other.open();
    QTRY_VERIFY(other.status().isRunning());
    other.stop(QStringLiteral("STOP"));
    const QString expected = QStringLiteral("Stopped by %1 (STOP), ").arg(PlantLeases::whoever());
    QTRY_VERIFY(notice->text().startsWith(expected));
    QTRY_VERIFY(other.status().master.stopped && other.status().master.stopped->yours);

    QVERIFY(fixture.master.startRealTime());
    QTRY_VERIFY(!notice->isVisible());
    fixture.master.stop();  // its program, and no person
    QTRY_VERIFY(!fixture.plant()->status().isRunning());
    QVERIFY(!notice->isVisible());
}

void tst_EscapeKeys::withAnythingOpenEscapeNeverStops()
{
    FlyingWindow fixture;
    QVERIFY(fixture.isReady);
    constexpr int sequences = 1000;
    QMap<QString, int> opened;
    for (uint seed = 0; seed < sequences; ++seed) {
        std::mt19937 random(seed);
        const auto below = [&](int limit) { return int(random() % uint(limit)); };
        QVector<Thing> open;
        if (below(3) == 0)
            pressKey(Qt::Key_Escape);  // deliberate, but alone
        for (int each = 1 + below(3); each > 0; --each) {
            const Thing &thing = fixture.things.at(below(fixture.things.size()));
            if (!thing.open())
                continue;
            open.append(thing);
            ++opened[thing.name];
        }
        QStringList names;
        for (const Thing &thing : qAsConst(open))
            names << thing.name;
        const QByteArray told = QStringLiteral("seed %1: %2").arg(seed).arg(names.join(QStringLiteral(", "))).toUtf8();
        const auto anythingOpen
            = [&] { return std::any_of(open.begin(), open.end(), [](const Thing &thing) { return thing.isOpen(); }); };
        for (int presses = 0; presses < 12 && anythingOpen(); ++presses) {
            pressKey(Qt::Key_Escape);
            QVERIFY2(fixture.stops.isEmpty(), told);
        }
        for (const Thing &thing : qAsConst(open)) {
            if (thing.let)
                thing.let();
        }
        for (const Thing &thing : qAsConst(open))
            QVERIFY2(!thing.isOpen(), told + " leaves " + thing.name.toUtf8());
        fixture.window.activateWindow();
        QVERIFY2(QTest::qWaitForWindowActive(&fixture.window), told);
        pressKey(Qt::Key_Shift);  // what follows is another sequence
        QVERIFY2(fixture.stops.isEmpty(), told);
    }
    for (const Thing &thing : qAsConst(fixture.things))
        QVERIFY2(opened.value(thing.name) > 0, qPrintable(thing.name));
    QCOMPARE(fixture.master.state(), QPlcMasterNode::RealTime);
    fixture.plot->setFocus();
    QVERIFY(fixture.pressEscapeTwice());
    QTRY_COMPARE(fixture.master.state(), QPlcMasterNode::Off);
}

/// A person who holds a slider in a fright and presses Escape again and again wants to stop.
void tst_EscapeKeys::escapeEndsADragAndTwiceMoreStops()
{
    for (const char *what : {"drag of a slider", "drag of a plot", "drag of a panel"}) {
        FlyingWindow fixture;
        QVERIFY(fixture.isReady);
        for (const Thing &thing : qAsConst(fixture.things)) {
            if (thing.name == QLatin1String(what))
                QVERIFY(thing.open());
        }
        QVERIFY(QGuiApplication::mouseButtons() != Qt::NoButton);
        pressKey(Qt::Key_Escape);
        QVERIFY(!fixture.slider->isSliderDown());
        const int place = fixture.slider->sliderPosition();
        QTest::mouseMove(fixture.slider, QPoint(2, fixture.slider->height() / 2));
        QCOMPARE(fixture.slider->sliderPosition(), place);
        QVERIFY(fixture.pressEscapeTwice());
        QTRY_COMPARE(fixture.master.state(), QPlcMasterNode::Off);
        QTest::mouseRelease(fixture.slider, Qt::LeftButton);
    }
}

/// Lists take every key for a search by letters.
void tst_EscapeKeys::aListWithTheFocusKeepsNoEscape()
{
    FlyingWindow fixture;
    QVERIFY(fixture.isReady);
    fixture.events->findChild<QAbstractItemView *>()->setFocus();
    QVERIFY(fixture.pressEscapeTwice());
    QTRY_COMPARE(fixture.master.state(), QPlcMasterNode::Off);
}

QTEST_MAIN(tst_EscapeKeys)
#include "tst_EscapeKeys.moc"
