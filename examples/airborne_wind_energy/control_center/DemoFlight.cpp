// SPDX-License-Identifier: Apache-2.0
#include "DemoFlight.h"

#include "PlantConfiguration.h"

#include <QtCore/QEvent>
#include <QtGui/QClipboard>

namespace awe {

namespace {

constexpr int Patience = 20000;  // [ms] until the kite flies, far more than a loaded machine needs
constexpr int Watch = 20;        // [ms]

}  // namespace

DemoFlight::DemoFlight(QPlcControlCenter *window)
    : m_window(*window)
    , m_flyAction(tr("Fly the demo kite"))
    , m_restartAction(tr("Restart the demo kite"))
    , m_partsAction(tr("What is this built of?"))
    , m_copyAction(tr("Copy the commands"))
{
    m_flyAction.setToolTip(tr("Three programs on this computer: nothing real moves"));
    m_restartAction.setToolTip(tr("Ends the programs of the demo and starts them again."));
    m_restartAction.setEnabled(false);
    m_partsAction.setToolTip(tr("The programs of the demo, and how to start them by hand"));
    m_partsAction.setEnabled(false);
    connect(&m_flyAction, &QAction::triggered, this, [this] { fly({}); });
    connect(&m_restartAction, &QAction::triggered, this, [this] {
        m_clock.start();
        m_plant.restart();
    });
    connect(&m_partsAction, &QAction::triggered, this, &DemoFlight::showParts);
    connect(&m_copyAction, &QAction::triggered, this, &DemoFlight::copyCommands);
    connect(&m_plant, &DemoPlant::listening, this, &DemoFlight::connectWindow);
    connect(&m_plant, &DemoPlant::failed, this, &DemoFlight::showFailure);
    connect(&m_watch, &QTimer::timeout, this, &DemoFlight::watch);
    m_window.addStartAction(&m_flyAction);
    addPlants();
    m_window.addHelpAction(&m_partsAction);
    m_window.installEventFilter(this);
}

/// The demo kite is that of the thesis.
void DemoFlight::addPlants()
{
    const QStringList names = PlantConfiguration::names();
    for (const QString &name : names) {
        if (name == QLatin1String("thesis"))
            continue;
        auto action = std::make_unique<QAction>(tr("Fly the plant '%1'").arg(name));
        action->setToolTip(PlantConfiguration::description(name));
        connect(action.get(), &QAction::triggered, this, [this, name] { fly(name); });
        m_window.addStartAction(action.get());
        m_plantActions.push_back(std::move(action));
    }
}

void DemoFlight::fly(const QString &plant)
{
    m_clock.start();
    m_plant.setPlant(plant);
    m_plant.start();
}

void DemoFlight::begin(const QElapsedTimer &clock)
{
    m_clock = clock;
    m_plant.start();
}

void DemoFlight::connectWindow(const QString &address)
{
    m_restartAction.setEnabled(true);
    m_partsAction.setEnabled(true);
    if (m_address != address)
        disconnectWindow();
    if (!m_window.plants().contains(m_name))
        m_name = m_window.connectToMaster(address, tr("demo"));
    m_address = address;
    m_window.showHint(tr("Not real time: the demo shares the processors with all other programs. "
                         "'qtplc doctor' says how to cure that."),
                      &m_partsAction);
    m_watch.start(Watch);
}

void DemoFlight::disconnectWindow()
{
    if (m_window.plants().contains(m_name))
        m_window.disconnectFromMaster(m_name);
    m_name.clear();
    m_address.clear();
}

void DemoFlight::watch()
{
    if (m_window.isLive(m_name)) {
        m_watch.stop();
        Q_EMIT flying(double(m_clock.elapsed()) / 1000.0);
    } else if (m_clock.elapsed() > Patience) {
        showFailure(tr("The kite of the demo does not fly after %1 s.").arg(Patience / 1000));
    }
}

void DemoFlight::showFailure(const QString &sentence)
{
    m_watch.stop();
    m_window.showHint(sentence, &m_restartAction);
    Q_EMIT failed(sentence);
}

void DemoFlight::showParts()
{
    m_window.showTab(QStringLiteral("Real time"));
    m_window.showHint(
        tr("A master and its nodes, ordinary programs that know each other by the names of signals only. By hand:\n%1")
            .arg(m_plant.commands()),
        &m_copyAction);
}

void DemoFlight::copyCommands()
{
    QGuiApplication::clipboard()->setText(m_plant.commands() + QLatin1Char('\n'));
    m_window.showHint(tr("The commands are in the clipboard: paste them into a terminal."));
}

/// The plant of the demo ends with the program: the window is not to look for it the next time.
bool DemoFlight::eventFilter(QObject *watched, QEvent *event)
{
    if (watched == &m_window && event->type() == QEvent::Close)
        disconnectWindow();
    return QObject::eventFilter(watched, event);
}

}  // namespace awe
