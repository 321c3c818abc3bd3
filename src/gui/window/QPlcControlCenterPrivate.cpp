// SPDX-License-Identifier: Apache-2.0
#include "QPlcControlCenterPrivate.h"

#include "DesktopTheme.h"
#include "DoubleEscape.h"
#include "FaultBanner.h"
#include "InsecureNotice.h"
#include "LongPress.h"
#include "MissingNotice.h"
#include "PanelKeysFirst.h"
#include "QPlcSignalTree.h"
#include "RecorderNotice.h"
#include "SignalPlaceActions.h"
#include "StandardWidgets.h"
#include "gui/plant/PlantFeed.h"

#include <QtCore/QMetaMethod>
#include <QtWidgets/QAction>
#include <QtWidgets/QApplication>
#include <QtWidgets/QMenu>
#include <QtWidgets/QStackedWidget>
#include <QtWidgets/QVBoxLayout>

using namespace qplc;

QPlcControlCenter::Private::Private(QPlcControlCenter *window)
    : q(window)
    , factories(standardWidgets())
    , actions(new ControlCenterActions(window))
{
    makeCentre();
    makeBars();
    connectParts();
    connectPlantActions();
    connectViewActions();
    connectPlaybackActions();
    connectLayoutActions();
    startPage->addOwnAction(actions->connectTo);
    startPage->addOwnAction(actions->openRecording);
    startPage->setWayBack(actions->startPage);
    pages->setCurrentIndex(1);
    applyTheme();
    followPlants();
    showRecent();
}

QPlcControlCenter::Private::~Private()
{
    // Nothing that happens while the parts go is news for those that are left.
    selection.disconnect();
    context.plants()->disconnect(q);
    wiring.disconnect(q);
    delete palette;
    delete dock;
    delete view;
}

void QPlcControlCenter::Private::makeCentre()
{
    auto *centre = new QWidget(q);
    auto *column = new QVBoxLayout(centre);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    connectStrip = new ConnectStrip(&context, centre);
    noteStrip = new NoteStrip(&selection, &context, centre);
    hint = new HintLine(&context, centre);
    pages = new QStackedWidget(centre);
    startPage = new StartPage(&context);
    view = new LayoutView(&editor);
    auto *panels = new QWidget;
    auto *panelsColumn = new QVBoxLayout(panels);
    panelsColumn->setContentsMargins(4, 4, 4, 0);
    panelsColumn->addWidget(view);
    placer = new SignalPlacer(view);
    placer->setParent(q);
    search = new MasterSearch(q);
    search->watch(startPage);
    search->watch(connectStrip);
    connect(search, &MasterSearch::found, startPage, &StartPage::setFoundMasters);
    connect(search, &MasterSearch::found, connectStrip, &ConnectStrip::setFoundMasters);
    pages->addWidget(startPage);
    pages->addWidget(panels);
    latchBanner = new LatchBanner(&context, centre);
    column->addWidget(latchBanner);
    column->addWidget(new FaultBanner(&context, centre));
    stopQuestion = new StopQuestion(&selection, &context, centre);
    column->addWidget(stopQuestion);
    column->addWidget(connectStrip);
    column->addWidget(noteStrip);
    column->addWidget(new InsecureNotice(&context, centre));
    column->addWidget(new MissingNotice(&context, centre));
    stopNotice = new StopNotice(&context, centre);
    column->addWidget(stopNotice);
    column->addWidget(hint);
    column->addWidget(pages, 1);
    playbackBar = new PlaybackBar(&playback, &context, centre);
    column->addWidget(playbackBar);
    q->setCentralWidget(centre);
    connect(view, &LayoutView::widgetAdded, &wiring, [this](const QString &id, QPlcWidget *widget) {
        wiring.add(widget);
        panelPlants.add(view->frame(id), widget);
        connect(widget, &QPlcWidget::showRequested, placer, &SignalPlacer::show);
        if (auto *tree = qobject_cast<QPlcSignalTree *>(widget))
            new SignalPlaceActions(tree, view, placer);
    });
    connect(view, &LayoutView::widgetRemoved, &wiring,
            [this](const QString &, QPlcWidget *widget) { wiring.remove(widget); });
    for (QAction *action : view->actions())
        action->setShortcutContext(Qt::WindowShortcut);  // from the dock and the bars, too
    view->setFactories(factories);
}

void QPlcControlCenter::Private::makeBars()
{
    topBar = new TopBar(&selection, &context, q);
    q->addToolBar(Qt::TopToolBarArea, topBar);
    topBar->selector()->setMenuActions({actions->connectTo, actions->disconnectFrom});

    auto *bottomBar = new FlatToolBar(tr("Time"), &context, q);
    bottomBar->setObjectName(QStringLiteral("BottomBar"));
    timeBar = new TimeBar(&context);
    eventLine = new EventLine(&context);
    bottomBar->addWidget(timeBar);
    bottomBar->addSeparator();
    bottomBar->addWidget(new RecorderNotice(&selection, &context));
    bottomBar->addSeparator();
    bottomBar->addWidget(eventLine);
    q->addToolBar(Qt::BottomToolBarArea, bottomBar);

    dock = new SignalDock(&context, q);
    q->addDockWidget(Qt::LeftDockWidgetArea, dock);
    q->resizeDocks({dock}, {330}, Qt::Horizontal);
    q->setCorner(Qt::BottomLeftCorner, Qt::LeftDockWidgetArea);
    dock->toggleViewAction()->setText(tr("Signal tree"));
    dock->toggleViewAction()->setShortcut(tr("Ctrl+B"));
    actions->viewMenu->insertAction(actions->eventLog, dock->toggleViewAction());
    q->addAction(dock->toggleViewAction());
    palette = new CommandPalette(&context, q);
    keys = new KeysWindow(q);
    help = new HelpWindow(q);
    about = new AboutWindow(q);
}

void QPlcControlCenter::Private::connectParts()
{
    connect(context.plants(), &PlantList::added, q, [this] {
        isStartPageWanted = false;
        followPlants();
    });
    connect(context.plants(), &PlantList::removed, q, [this] { followPlants(); });
    connect(&selection, &PlantSelection::changed, q, [this] { followSelection(); });
    connect(&selection, &PlantSelection::commandFailed, q,
            [this](const QString &sentence) { hint->showText(sentence); });
    connect(connectStrip, &ConnectStrip::connectRequested, q, [this](const QString &address) { connectTo(address); });
    connect(noteStrip, &NoteStrip::refused, q, [this](const QString &sentence) { hint->showText(sentence); });
    connect(startPage, &StartPage::masterChosen, q, [this](const QString &address) { connectTo(address); });
    connect(dock->tree(), &QPlcWidget::showRequested, placer, &SignalPlacer::show);
    new SignalPlaceActions(dock->tree(), view, placer);
    connect(&editor, &LayoutEditor::layoutChanged, &panelPlants, &PanelPlants::showAll);
    connect(stopQuestion, &StopQuestion::answered, q,
            [this](const QVector<Plant *> &plants, const QString &how) { stopPlants(plants, how); });
    connect(&editor, &LayoutEditor::refused, q, [this](const QString &sentence) { hint->showText(sentence); });
    connect(eventLine, &QAbstractButton::clicked, q, [this] { actions->eventLog->trigger(); });
    connect(topBar, &TopBar::nextRequested, q, [this] {
        if (selection.plant() && selection.plant()->nextAction() != Plant::NoAction)
            perform(selection.plant()->nextAction());
    });
    connect(topBar, &TopBar::stopRequested, q, [this] { stop(tr("STOP")); });
    new PanelKeysFirst(q);
    LongPress::watch();
    connect(DesktopTheme::instance(), &DesktopTheme::changed, q, [this] {
        if (theme == SystemTheme)
            applyTheme();
    });
    connect(new DoubleEscape(q), &DoubleEscape::pressed, q, [this] { stop(tr("Esc Esc")); });
    connect(&wiring, &PanelWiring::outputsChanged, q,
            [this] { Q_EMIT q->outputSignalIndicesChanged(q->outputSignalIndices()); });
    connect(&wiring, &PanelWiring::initialOutputsChanged, q,
            [this] { Q_EMIT q->initialOutputSignalsChanged(q->initialOutputSignals()); });
    connect(&wiring, &PanelWiring::outputsSent, q, &QPlcControlCenter::sendNewOutputSignals);
}

// ---- plants ----

void QPlcControlCenter::Private::followPlants()
{
    showPages();
    followSelection();
}

void QPlcControlCenter::Private::showPages()
{
    const bool isStart = isStartPageWanted || context.plants()->size() == 0;
    if (isStart != (pages->currentIndex() == 0))
        showDock(isStart);
    pages->setCurrentIndex(isStart ? 0 : 1);
    const QStringList names = context.plants()->names();
    startPage->showWayBack(!names.isEmpty());
    actions->startPage->setEnabled(!names.isEmpty());
    actions->startPage->setText(!isStart || names.isEmpty() ? tr("Start &page")
                                    : names.size() == 1     ? tr("&Back to %1").arg(names.first())
                                                            : tr("&Back to the plants"));
    if (isStart && !connectStrip->isVisible())
        startPage->setFocus(Qt::OtherFocusReason);
    q->setWindowTitle(names.isEmpty() ? tr("Control Center")
                                      : tr("%1 - Control Center").arg(names.join(QStringLiteral(", "))));
}

/// The start page has no use for signals; behind it the dock is as a person left it.
void QPlcControlCenter::Private::showDock(bool isStart)
{
    if (isStart)
        isDockWanted = !dock->isHidden();
    dock->setVisible(!isStart && isDockWanted);
}

void QPlcControlCenter::Private::followSelection()
{
    const Plant *plant = selection.plant();
    const Plant::Action next = plant ? plant->nextAction() : Plant::NoAction;
    const bool isAtRest = plant && plant->isConnected() && !plant->status().isRunning() && !plant->status().isLatched();
    actions->initialize->setEnabled(isAtRest);
    actions->arm->setEnabled(next == Plant::Arm);
    actions->start->setEnabled(next == Plant::Start);
    actions->resetPlant->setEnabled(next == Plant::Reset);
    actions->disconnectFrom->setEnabled(plant != nullptr);
    actions->disconnectFrom->setText(!plant                   ? tr("&Disconnect")
                                         : plant->recording() ? tr("&Close %1").arg(plant->name())
                                                              : tr("&Disconnect from %1").arg(plant->name()));
    actions->nextPlant->setEnabled(context.plants()->size() > 1);
    const QString toStop = context.plants()->size() > 1 ? stopText(selection) : QString();
    actions->stop->setText(toStop.isEmpty() ? tr("S&top (Esc Esc)") : tr("S&top %1 (Esc Esc)").arg(toStop));
}

void QPlcControlCenter::Private::connectTo(const QString &address)
{
    recent.add(address);
    showRecent();
    if (q->isSignalConnected(QMetaMethod::fromSignal(&QPlcControlCenter::connectRequested))) {
        // The program connects a node of its own. Names are looked up in the background.
        auto *resolver = new AddressResolver(q);
        connect(resolver, &AddressResolver::resolved, q,
                [this, resolver, address](const QPlcUnderlyingProtocol &master) {
                    resolver->deleteLater();
                    requestedAddress = address;
                    Q_EMIT q->connectRequested(master);
                });
        connect(resolver, &AddressResolver::failed, q, [this, resolver](const QString &reason) {
            resolver->deleteLater();
            connectStrip->open();
            connectStrip->showError(reason);
        });
        resolver->resolve(address);
        return;
    }
    Plant *plant = plantAt(address);
    if (!plant)
        plant = context.plants()->find(q->connectToMaster(address));
    isStartPageWanted = false;
    followPlants();
    selection.select(plant);
}

/// The plant that is connected to \a address already, as after a click on a master that was found.
Plant *QPlcControlCenter::Private::plantAt(const QString &address)
{
    for (Plant *plant : context.plants()->all()) {
        if (!plant->feed() && !plant->recording() && plant->address() == address)
            return plant;
    }
    return nullptr;
}

void QPlcControlCenter::Private::openRecording(const QStringList &paths)
{
    QString error;
    const QString name = q->openRecording(paths, &error);
    if (name.isEmpty())
        return hint->showText(error);
    isStartPageWanted = false;
    followPlants();
    selection.select(context.plants()->find(name));
}

void QPlcControlCenter::Private::disconnectFrom()
{
    Plant *plant = selection.plant();
    if (!plant)
        return;
    if (plant->feed())
        Q_EMIT q->disconnectRequested();
    else
        q->disconnectFromMaster(plant->name());
}

void QPlcControlCenter::Private::perform(Plant::Action action)
{
    if (Plant *plant = selection.plant())
        plant->perform(action);
    else
        hint->showText(tr("There is no plant: connect to one first (Ctrl+O)."));
}

void QPlcControlCenter::Private::stop(const QString &how)
{
    const QVector<Plant *> plants = selection.plantsToStop();
    if (plants.size() > 1)
        stopQuestion->ask(how);
    else if (plants.isEmpty())
        perform(Plant::StopAction);
    else
        stopPlants(plants, how);
}

/// What was stopped is what the bar shows: the next command of the bar is for it, too.
void QPlcControlCenter::Private::stopPlants(const QVector<Plant *> &plants, const QString &how)
{
    for (Plant *plant : plants)
        plant->stop(how);
    if (!plants.contains(selection.plant()))
        selection.select(plants.first());
}

Plant *QPlcControlCenter::Private::wiredPlant()
{
    for (Plant *plant : context.plants()->all()) {
        if (plant->feed())
            return plant;
    }
    return nullptr;
}

/// The wired plant; a new one when there is none yet.
Plant *QPlcControlCenter::Private::takeWiredPlant()
{
    if (Plant *plant = wiredPlant())
        return plant;
    const QString name = !wiredName.isEmpty() ? wiredName : requestedAddress.isEmpty() ? tr("plant") : requestedAddress;
    Plant *plant = context.plants()->addFed(name);
    connect(plant->feed(), &PlantFeed::commanded, q, &QPlcControlCenter::sendMessage);
    return plant;
}

// ---- memory ----

void QPlcControlCenter::Private::showRecent()
{
    startPage->setRecentMasters(recent.addresses());
    connectStrip->setRecentMasters(recent.addresses());
}
