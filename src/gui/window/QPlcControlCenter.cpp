// SPDX-License-Identifier: Apache-2.0
#include "QPlcControlCenter.h"

#include "LayoutShelf.h"
#include "PanelWiring.h"
#include "StandardWidgets.h"
#include "gui/layout/LayoutJson.h"
#include "gui/layout/LayoutView.h"
#include "gui/plant/PlantFeed.h"

#include <QtGui/QCloseEvent>
#include <QtWidgets/QAction>
#include <QtWidgets/QMenu>

using namespace qplc;

struct QPlcControlCenter::Private
{
    explicit Private(QPlcControlCenter *window);

    Plant *wiredPlant() const;

    QPlcControlCenter *q;
    WindowContext context;
    LayoutEditor editor;
    LayoutShelf shelf{&editor};
    PanelWiring wiring{&context};
    LayoutView *view;
    QList<QPlcWidgetFactory *> factories = standardWidgets();
    Theme theme = SystemTheme;
};

QPlcControlCenter::Private::Private(QPlcControlCenter *window)
    : q(window)
    , view(new LayoutView(&editor, window))
{
    connect(view, &LayoutView::widgetAdded, &wiring,
            [this](const QString &, QPlcWidget *widget) { wiring.add(widget); });
    connect(view, &LayoutView::widgetRemoved, &wiring,
            [this](const QString &, QPlcWidget *widget) { wiring.remove(widget); });
    view->setFactories(factories);
    window->setCentralWidget(view);
}

QPlcControlCenter::QPlcControlCenter(QWidget *parent)
    : QMainWindow(parent)
    , d(std::make_unique<Private>(this))
{
    connect(&d->wiring, &PanelWiring::outputsChanged, this,
            [this] { Q_EMIT outputSignalIndicesChanged(outputSignalIndices()); });
    connect(&d->wiring, &PanelWiring::initialOutputsChanged, this,
            [this] { Q_EMIT initialOutputSignalsChanged(initialOutputSignals()); });
    connect(&d->wiring, &PanelWiring::outputsSent, this, &QPlcControlCenter::sendNewOutputSignals);
}

QPlcControlCenter::~QPlcControlCenter()
{
    delete takeCentralWidget();
}

QString QPlcControlCenter::connectToMaster(const QString &address, const QString &name)
{
    return d->context.plants()->add(address, name)->name();
}

void QPlcControlCenter::disconnectFromMaster(const QString &plant)
{
    d->context.plants()->remove(d->context.plants()->find(plant));
}

QStringList QPlcControlCenter::plants() const
{
    QStringList names;
    for (int place = 0; place < d->context.plants()->size(); ++place)
        names.append(d->context.plants()->at(place)->name());
    return names;
}

bool QPlcControlCenter::isConnected(const QString &plant) const
{
    const Plant *found = d->context.plants()->find(plant);
    return found && found->isConnected();
}

void QPlcControlCenter::addAvailableWidget(QPlcWidgetFactory *factory)
{
    if (d->factories.contains(factory))
        return;
    d->factories.append(factory);
    d->view->setFactories(d->factories);
}

bool QPlcControlCenter::addLayout(const QString &name, const QByteArray &json, QString *error)
{
    return d->shelf.add(name, json, error);
}
bool QPlcControlCenter::showLayout(const QString &name)
{
    return d->shelf.show(name);
}
void QPlcControlCenter::resetLayout()
{
    d->shelf.reset();
}
bool QPlcControlCenter::openLayout(const QString &fileName, QString *error)
{
    return d->shelf.open(fileName, error);
}
bool QPlcControlCenter::saveLayout(const QString &fileName, QString *error)
{
    return d->shelf.save(fileName, error);
}
QByteArray QPlcControlCenter::layoutJson() const
{
    return layoutToJson(d->editor.layout());
}
void QPlcControlCenter::restoreView() {}
void QPlcControlCenter::addStartAction(QAction *action)
{
    addAction(action);
}
void QPlcControlCenter::showStartPage() {}
bool QPlcControlCenter::isStartPageShown() const
{
    return false;
}
void QPlcControlCenter::showHint(const QString &) {}
QPlcControlCenter::Theme QPlcControlCenter::theme() const
{
    return d->theme;
}
void QPlcControlCenter::setTheme(Theme theme)
{
    d->theme = theme;
    d->context.setTheme(qplc::Theme::byName(qplc::Theme::Name(theme)));
}
WindowContext *QPlcControlCenter::context() const
{
    return &d->context;
}

// ---- a wired node ----

Plant *QPlcControlCenter::Private::wiredPlant() const
{
    for (int place = 0; place < const_cast<WindowContext &>(context).plants()->size(); ++place) {
        Plant *plant = const_cast<WindowContext &>(context).plants()->at(place);
        if (plant->feed())
            return plant;
    }
    return nullptr;
}

void QPlcControlCenter::setSignalIndexTable(const QPlcSignalIndexTable &)
{
    Q_EMIT inputSignalIndicesChanged(inputSignalIndices());
}
QPlcSignalIndexList QPlcControlCenter::inputSignalIndices() const
{
    QPlcSignalIndexList all;
    for (QPlcSignalIndex signal = 0; signal < QPlcSignalIndexTable::current().size(); ++signal)
        all.insert(signal);
    return all;
}
QPlcSignalIndexList QPlcControlCenter::outputSignalIndices() const
{
    return d->wiring.outputs();
}
QPlcSignalList QPlcControlCenter::initialOutputSignals() const
{
    return d->wiring.initialOutputs();
}
void QPlcControlCenter::realTimeout(const QList<QPlcSignalList> &) {}
void QPlcControlCenter::connectedToMaster() {}
void QPlcControlCenter::disconnectedFromMaster() {}
void QPlcControlCenter::initialize(const QPlcSignalList &) {}
void QPlcControlCenter::started() {}
void QPlcControlCenter::stopped() {}
void QPlcControlCenter::closeEvent(QCloseEvent *event)
{
    QMainWindow::closeEvent(event);
}
QMenu *QPlcControlCenter::createPopupMenu()
{
    return nullptr;
}
