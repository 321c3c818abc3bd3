// SPDX-License-Identifier: Apache-2.0
// QPlcControlCenter::Private: what its commands do to the view, and what the window remembers.
#include "DesktopTheme.h"
#include "Documentation.h"
#include "QPlcControlCenterPrivate.h"
#include "QPlcSignalTree.h"
#include "QPlcWidgetFactory.h"
#include "RecordingDrop.h"
#include "TouchStyle.h"
#include "VideoCommand.h"
#include "WindowSettings.h"
#include "gui/layout/LayoutJson.h"
#include "gui/layout/PanelFrame.h"

#include <QtCore/QDir>
#include <QtCore/QFileInfo>
#include <QtCore/QJsonArray>
#include <QtCore/QJsonDocument>
#include <QtGui/QScreen>
#include <QtWidgets/QAction>
#include <QtWidgets/QApplication>
#include <QtWidgets/QFileDialog>
#include <QtWidgets/QMenu>

#include <algorithm>

using namespace qplc;

// ---- first size ----

/// That of a laptop, and smaller where the screen, in its scale, has less room.
void QPlcControlCenter::Private::resizeToScreen()
{
    constexpr QSize usual(1366, 740);
    constexpr QSize frame(8, 36);  // what a window manager adds, as long as the window has no frame
    const QSize room = QGuiApplication::primaryScreen()->availableSize() - frame;
    q->resize(usual.boundedTo(room));
}

// ---- commands ----

void QPlcControlCenter::Private::connectPlantActions()
{
    connect(actions->connectTo, &QAction::triggered, connectStrip, &ConnectStrip::open);
    connect(actions->openRecording, &QAction::triggered, q, [this] { askForRecording(); });
    new VideoCommand(actions->saveVideo, &playback, q);
    connect(actions->recentRecordings, &QMenu::aboutToShow, q, [this] { fillRecentRecordings(); });
    connect(actions->disconnectFrom, &QAction::triggered, q, [this] { disconnectFrom(); });
    connect(actions->nextPlant, &QAction::triggered, &selection, &PlantSelection::selectNext);
    connect(actions->initialize, &QAction::triggered, q, [this] { perform(Plant::Initialize); });
    connect(actions->arm, &QAction::triggered, q, [this] { perform(Plant::Arm); });
    connect(actions->start, &QAction::triggered, q, [this] { perform(Plant::Start); });
    connect(actions->resetPlant, &QAction::triggered, q, [this] { perform(Plant::Reset); });
    connect(latchBanner, &LatchBanner::resetRequested, q, [](Plant *plant) { plant->perform(Plant::Reset); });
    connect(actions->stop, &QAction::triggered, q, [this] { stop({}); });
    connect(actions->giveBack, &QAction::triggered, q, [this] { giveBackControl(*context.plants()); });
    connect(topBar->controlNotice(), &ControlNotice::factsChanged, actions->giveBack,
            [this] { actions->giveBack->setEnabled(topBar->controlNotice()->isToGiveBack()); });
    connect(actions->startPage, &QAction::triggered, q, [this] {
        isStartPageWanted = !isStartPageWanted;
        showPages();
    });
    connect(actions->quit, &QAction::triggered, q, &QWidget::close);
}

void QPlcControlCenter::Private::connectViewActions()
{
    connect(actions->palette, &QAction::triggered, q, [this] { openPalette(); });
    connect(actions->search, &QAction::triggered, dock, &SignalDock::startSearch);
    connect(actions->goLive, &QAction::triggered, context.timeAxis(), &QPlcTimeAxis::goLive);
    connect(actions->freeze, &QAction::triggered, context.timeAxis(), &QPlcTimeAxis::freeze);
    connect(actions->shorterSpan, &QAction::triggered, timeBar, [this] { timeBar->stepSpan(-1); });
    connect(actions->longerSpan, &QAction::triggered, timeBar, [this] { timeBar->stepSpan(1); });
    for (const ControlCenterActions::Rate &each : qAsConst(actions->rates))
        connect(each.action, &QAction::triggered, q, [this, each] { setRate(each.timesPerSecond); });
    connect(actions->eventLog, &QAction::triggered, placer, [this] { placer->showPanel(QStringLiteral("Event log")); });
    connect(actions->note, &QAction::triggered, noteStrip, &NoteStrip::open);
    connect(actions->acknowledge, &QAction::triggered, context.events(), &EventLogModel::acknowledgeAll);
    connect(actions->fullScreen, &QAction::toggled, q, [this](bool isFull) {
        q->setWindowState(isFull ? q->windowState() | Qt::WindowFullScreen : q->windowState() & ~Qt::WindowFullScreen);
    });
    connect(actions->touch, &QAction::toggled, q, &TouchStyle::setOn);
    connect(actions->alarmSound, &QAction::toggled, q, [this](bool isOn) { alarmSound.setOn(isOn); });
    actions->touch->setChecked(TouchStyle::isUseful());
    for (int each = 0; each < actions->themes.size(); ++each)
        connect(actions->themes.at(each), &QAction::triggered, q, [this, each] { q->setTheme(Theme(each)); });
    connect(actions->keys, &QAction::triggered, q, [this] { openKeys(); });
    connect(actions->documentation, &QAction::triggered, q,
            [this] { openDocument(QStringLiteral("control-center.md")); });
    connect(actions->about, &QAction::triggered, about, &QWidget::show);
    connect(about, &AboutWindow::licencesRequested, q, [this] { openDocument(QStringLiteral("design/licences.md")); });
}

void QPlcControlCenter::Private::connectPlaybackActions()
{
    connect(actions->play, &QAction::triggered, &playback, &Playback::toggle);
    connect(actions->cycleBack, &QAction::triggered, q, [this] { playback.step(-1); });
    connect(actions->cycleOn, &QAction::triggered, q, [this] { playback.step(1); });
    connect(actions->slower, &QAction::triggered, q, [this] { playbackBar->stepSpeed(-1); });
    connect(actions->faster, &QAction::triggered, q, [this] { playbackBar->stepSpeed(1); });
    const auto follow = [this] {
        for (QAction *action : {actions->play, actions->cycleBack, actions->cycleOn, actions->slower, actions->faster})
            action->setEnabled(playback.plant() != nullptr);
    };
    connect(&playback, &Playback::changed, q, follow);
    follow();
    new RecordingDrop(q, [this](const QStringList &paths) { openRecording(paths); });
}

void QPlcControlCenter::Private::connectLayoutActions()
{
    QUndoStack *stack = editor.undoStack();
    actions->undo = stack->createUndoAction(q, tr("Undo"));
    actions->redo = stack->createRedoAction(q, tr("Redo"));
    actions->undo->setShortcut(tr("Ctrl+Z"));
    actions->redo->setShortcuts({QKeySequence(tr("Ctrl+Shift+Z")), QKeySequence(tr("Ctrl+Y"))});
    actions->layoutMenu->insertActions(actions->addPanel, {actions->undo, actions->redo});
    q->addActions({actions->undo, actions->redo});
    connect(actions->open, &QAction::triggered, q, [this] { askForLayoutFile(false); });
    connect(actions->saveAs, &QAction::triggered, q, [this] { askForLayoutFile(true); });
    connect(actions->save, &QAction::triggered, q, [this] {
        if (layoutFile.isEmpty())
            askForLayoutFile(true);
        else
            saveLayoutTo(layoutFile);
    });
    connect(actions->reset, &QAction::triggered, q, [this] { q->resetLayout(); });
    connect(actions->newTab, &QAction::triggered, q, [this] { editor.addTab(); });
    connect(actions->addPanel, &QAction::triggered, q, [this] { openPanelPalette(); });
    connect(view, &LayoutView::addRequested, q, [this] { openPanelPalette(); });
}

void QPlcControlCenter::Private::fillRecentRecordings()
{
    QMenu *menu = actions->recentRecordings;
    menu->clear();
    const QVector<QStringList> recordings = RecentRecordings().all();
    for (const QStringList &paths : recordings) {
        const QString text = RecentRecordings::textOf(paths).replace(QLatin1Char('&'), QStringLiteral("&&"));
        QAction *action = menu->addAction(text, q, [this, paths] { openRecording(paths); });
        action->setToolTip(paths.join(QLatin1Char('\n')));
    }
    menu->setToolTipsVisible(true);
    if (recordings.isEmpty())
        menu->addAction(tr("None yet"))->setEnabled(false);
}

void QPlcControlCenter::Private::askForRecording()
{
    auto *dialog = new QFileDialog(q, tr("Open a recording"), QString(), tr("Recordings (*.mcap);;All files (*)"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setFileMode(QFileDialog::ExistingFiles);
    dialog->setModal(false);
    connect(dialog, &QFileDialog::filesSelected, q, [this](const QStringList &paths) { openRecording(paths); });
    dialog->show();
}

void QPlcControlCenter::Private::askForLayoutFile(bool isToSave)
{
    auto *dialog = new QFileDialog(q, isToSave ? tr("Save the layout") : tr("Open a layout"), layoutFile,
                                   tr("Layouts (*.json);;All files (*)"));
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->setAcceptMode(isToSave ? QFileDialog::AcceptSave : QFileDialog::AcceptOpen);
    dialog->setFileMode(isToSave ? QFileDialog::AnyFile : QFileDialog::ExistingFile);
    dialog->setDefaultSuffix(QStringLiteral("json"));
    dialog->setModal(false);
    connect(dialog, &QFileDialog::fileSelected, q, [this, isToSave](const QString &fileName) {
        QString error;
        if (isToSave)
            saveLayoutTo(fileName);
        else if (!q->openLayout(fileName, &error))
            hint->showText(error);
    });
    dialog->show();
}

void QPlcControlCenter::Private::saveLayoutTo(const QString &fileName)
{
    QString error;
    if (q->saveLayout(fileName, &error))
        eventLine->say(tr("Layout saved: %1").arg(QDir::toNativeSeparators(QFileInfo(fileName).absoluteFilePath())));
    else
        hint->showText(error);
}

// ---- view ----

void QPlcControlCenter::Private::applyTheme()
{
    DesktopTheme *desktop = DesktopTheme::instance();
    const qplc::Theme chosen
        = theme == SystemTheme ? desktop->theme() : qplc::Theme::byName(qplc::Theme::Name(int(theme)));
    desktop->givePalette(chosen.palette());
    q->setPalette(chosen.palette());
    context.setTheme(chosen);
    actions->showTheme(int(theme));
}

void QPlcControlCenter::Private::setRate(double timesPerSecond)
{
    rate = timesPerSecond;
    context.plants()->setRate(rate);
    actions->showRate(rate);
}

void QPlcControlCenter::Private::openDocument(const QString &name)
{
    if (!help->showDocument(documentationFolder(documentationStarts()), name))
        hint->showText(
            tr("The documents are not installed. Install the package qtplc-doc, or read them in the folder docs "
               "of the sources."));
}

void QPlcControlCenter::Private::openKeys()
{
    QVector<KeysWindow::Group> groups = actions->groups();
    groups.append({tr("Panels and tabs"), view->actions()});
    groups.append({tr("Tree of signals"), dock->tree()->actions()});
    if (const PanelFrame *frame = focusedFrame())
        groups.append({tr("Panel '%1'").arg(frame->accessibleName()), actionsOf(*frame)});
    keys->showKeys(groups);
}

const PanelFrame *QPlcControlCenter::Private::focusedFrame() const
{
    for (QWidget *widget = q->focusWidget(); widget; widget = widget->parentWidget()) {
        if (auto *frame = qobject_cast<PanelFrame *>(widget))
            return frame;
    }
    return nullptr;
}

/// What the panel itself can do, and what is done with it.
QList<QAction *> QPlcControlCenter::Private::actionsOf(const PanelFrame &frame)
{
    const QList<QAction *> own = frame.widget() ? frame.widget()->actions() : QList<QAction *>();
    return own + frame.actions();
}

void QPlcControlCenter::Private::openPalette()
{
    palette->open(paletteItems(), tr("What to do? Commands, panels, layouts, signals"));
}

/// What can be added, found by typing a part of its name.
void QPlcControlCenter::Private::openPanelPalette()
{
    QVector<PaletteItem> items;
    for (const QPlcWidgetFactory *factory : qAsConst(factories)) {
        const QString type = factory->name();
        items.append({factory->title(), tr("Panel"), {}, [this, type] { view->addPanel(type); }});
    }
    items.append({tr("New tab"), tr("Tab"), QKeySequence(tr("Ctrl+T")).toString(QKeySequence::NativeText),
                  [this] { editor.addTab(); }});
    palette->open(items, tr("Which panel? Type a part of its name"));
}

void QPlcControlCenter::Private::appendActions(QVector<PaletteItem> *items, const QString &group,
                                               const QList<QAction *> &all) const
{
    for (QAction *action : all) {
        if (action->menu()) {
            appendActions(items, action->text(), action->menu()->actions());
            continue;
        }
        const QString text = action->text().remove(QLatin1Char('&'));
        if (!action->isEnabled() || action->isSeparator() || text.isEmpty() || action == actions->palette)
            continue;
        items->append(
            {text, group, action->shortcut().toString(QKeySequence::NativeText), [action] { action->trigger(); }});
    }
}

void QPlcControlCenter::Private::appendPanels(QVector<PaletteItem> *items)
{
    for (const QPlcWidgetFactory *factory : qAsConst(factories)) {
        const QString type = factory->name();
        items->append(
            {tr("Add panel: %1").arg(factory->title()), tr("Panel"), {}, [this, type] { view->addPanel(type); }});
    }
}

void QPlcControlCenter::Private::appendSignals(QVector<PaletteItem> *items)
{
    PlantList *plants = context.plants();
    for (const Plant *plant : plants->all()) {
        for (QPlcSignalIndex signal = 0; signal < plant->table().size(); ++signal) {
            const QString reference = plants->reference(plant, signal).toString();
            items->append({reference, tr("Plot signal"), {}, [this, reference] {
                               placer->show({reference}, QStringLiteral("Time plot"));
                           }});
        }
    }
}

QVector<PaletteItem> QPlcControlCenter::Private::paletteItems()
{
    QVector<PaletteItem> items;
    for (const KeysWindow::Group &group : actions->groups())
        appendActions(&items, group.name, group.actions);
    if (const PanelFrame *frame = focusedFrame())
        appendActions(&items, frame->accessibleName(), actionsOf(*frame));
    appendActions(&items, tr("Start"), startActions);
    appendActions(&items, tr("Panels"), view->actions());
    appendActions(&items, tr("Signals"), dock->tree()->actions());
    appendPanels(&items);
    appendSignals(&items);
    return items;
}

// ---- memory ----

namespace {

QString keyOf(const char *what)
{
    return QStringLiteral("ControlCenter/") + QLatin1String(what);
}

}  // namespace

void QPlcControlCenter::Private::save()
{
    QStringList plants;
    for (const Plant *plant : context.plants()->all()) {
        if (!plant->feed() && !plant->recording())
            plants << plant->address() << plant->name();
    }
    const bool isStart = q->isStartPageShown();
    if (isStart)
        dock->setVisible(isDockWanted);
    WindowSettings settings;
    settings.setValue(keyOf("geometry"), q->saveGeometry());
    settings.setValue(keyOf("state"), q->saveState());
    settings.setValue(keyOf("signalTree"), QJsonDocument(dock->tree()->settings()).toJson(QJsonDocument::Compact));
    settings.setValue(keyOf("layout"), layoutToJson(editor.layout()));
    settings.setValue(keyOf("theme"), qplc::Theme::nameText(qplc::Theme::Name(int(theme))));
    settings.setValue(keyOf("rate"), rate);
    settings.setValue(keyOf("touch"), actions->touch->isChecked());
    settings.setValue(keyOf("alarmSound"), actions->alarmSound->isChecked());
    settings.setValue(keyOf("plants"), plants);
    settings.sync();
    if (isStart)
        dock->hide();
}

void QPlcControlCenter::Private::restore()
{
    const WindowSettings settings;
    q->restoreGeometry(settings.value(keyOf("geometry")).toByteArray());
    if (q->restoreState(settings.value(keyOf("state")).toByteArray()) && q->isStartPageShown())
        showDock(true);
    dock->tree()->applySettings(QJsonDocument::fromJson(settings.value(keyOf("signalTree")).toByteArray()).object());
    q->setTheme(Theme(int(qplc::Theme::nameOf(settings.value(keyOf("theme")).toString()))));
    setRate(std::clamp(settings.value(keyOf("rate")).toDouble(), 0.0, 1e6));
    actions->touch->setChecked(settings.value(keyOf("touch"), TouchStyle::isUseful()).toBool());
    actions->alarmSound->setChecked(settings.value(keyOf("alarmSound"), true).toBool());
    const QByteArray layout = settings.value(keyOf("layout")).toByteArray();
    if (!layout.isEmpty() && !shelf.restore(layout))
        hint->showText(tr("The layout of the last time cannot be read; this is the default one."));
    const QStringList plants = settings.value(keyOf("plants")).toStringList();
    for (int i = 0; i + 1 < plants.size(); i += 2)
        q->connectToMaster(plants[i], plants[i + 1]);
}
