// SPDX-License-Identifier: Apache-2.0
#include "QPlcControlCenterPrivate.h"
#include "gui/layout/LayoutJson.h"
#include "gui/plant/PlantFeed.h"

#include <QtCore/QDateTime>
#include <QtCore/QMetaEnum>
#include <QtGui/QCloseEvent>
#include <QtWidgets/QAction>
#include <QtWidgets/QMenu>

using namespace qplc;

QPlcControlCenter::QPlcControlCenter(QWidget *parent)
    : QMainWindow(parent)
    , d(std::make_unique<Private>(this))
{
    d->resizeToScreen();
}

QPlcControlCenter::~QPlcControlCenter() = default;

// ---- plants ----

QString QPlcControlCenter::connectToMaster(const QString &address, const QString &name)
{
    QString plain = address.trimmed();
    if (plain.startsWith(QLatin1String("qtplc://")))
        plain.remove(0, 8);
    return d->context.plants()->add(plain, name)->name();
}

QString QPlcControlCenter::openRecording(const QStringList &paths, QString *error, const QString &name)
{
    QString ignored;
    const Plant *plant = d->context.plants()->addRecording(paths, name, error ? error : &ignored);
    if (plant)
        RecentRecordings().add(paths);
    return plant ? plant->name() : QString();
}

void QPlcControlCenter::disconnectFromMaster(const QString &plant)
{
    if (Plant *found = d->context.plants()->find(plant))
        d->context.plants()->remove(found);
}

QStringList QPlcControlCenter::plants() const
{
    return d->context.plants()->names();
}

bool QPlcControlCenter::isConnected(const QString &plant) const
{
    const Plant *found = d->context.plants()->find(plant);
    return found && found->isConnected();
}

// ---- panels and layouts ----

void QPlcControlCenter::addAvailableWidget(QPlcWidgetFactory *factory)
{
    if (d->factories.contains(factory))
        return;
    d->factories.append(factory);
    d->view->setFactories(d->factories);
}

bool QPlcControlCenter::addLayout(const QString &name, const QByteArray &json, QString *error)
{
    if (!d->shelf.add(name, json, error))
        return false;
    d->actions->showLayouts(d->shelf.names(), [this](const QString &chosen) { showLayout(chosen); });
    return true;
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
    if (!d->shelf.open(fileName, error))
        return false;
    d->layoutFile = fileName;
    return true;
}

bool QPlcControlCenter::saveLayout(const QString &fileName, QString *error)
{
    if (!d->shelf.save(fileName, error))
        return false;
    d->layoutFile = fileName;
    return true;
}

QByteArray QPlcControlCenter::layoutJson() const
{
    return layoutToJson(d->editor.layout());
}

void QPlcControlCenter::restoreView()
{
    d->isToBeSaved = true;
    d->restore();
}

// ---- start page and view ----

void QPlcControlCenter::addStartAction(QAction *action)
{
    d->startActions.append(action);
    d->startPage->addAction(action);
    if (isStartPageShown())
        d->startPage->setFocus(Qt::OtherFocusReason);
    addAction(action);
}

void QPlcControlCenter::showStartPage()
{
    d->isStartPageWanted = true;
    d->showPages();
}

bool QPlcControlCenter::isStartPageShown() const
{
    return d->startPage->isVisibleTo(const_cast<QPlcControlCenter *>(this));
}

void QPlcControlCenter::showHint(const QString &text)
{
    d->hint->showText(text);
}

QPlcControlCenter::Theme QPlcControlCenter::theme() const
{
    return d->theme;
}

void QPlcControlCenter::setTheme(Theme theme)
{
    d->theme = theme;
    d->applyTheme();
}

WindowContext *QPlcControlCenter::context() const
{
    return &d->context;
}

void QPlcControlCenter::closeEvent(QCloseEvent *event)
{
    if (d->isToBeSaved)
        d->save();
    QMainWindow::closeEvent(event);
}

QMenu *QPlcControlCenter::createPopupMenu()
{
    return nullptr;  // bars are always there
}

// ---- a wired node ----

void QPlcControlCenter::setPlantName(const QString &name)
{
    d->wiredName = name;
}

void QPlcControlCenter::signalIndexTableChanged()
{
    if (Plant *plant = d->wiredPlant(); plant && plant->isConnected())
        plant->feed()->connected(QPlcSignalIndexTable::current());
    Q_EMIT inputSignalIndicesChanged(inputSignalIndices());
}

QPlcSignalIndexList QPlcControlCenter::inputSignalIndices() const
{
    QPlcSignalIndexList all;
    const QPlcSignalTable table = QPlcSignalIndexTable::current();
    for (QPlcSignalIndex signal = 0; signal < table.size(); ++signal)
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

void QPlcControlCenter::realTimeout(const QList<QPlcSignalList> &signalValues)
{
    constexpr PlantValues::Time nanosecondsPerMillisecond = 1'000'000;
    if (Plant *plant = d->wiredPlant())
        plant->feed()->add(signalValues, QDateTime::currentMSecsSinceEpoch() * nanosecondsPerMillisecond);
}

void QPlcControlCenter::connectedToMaster()
{
    d->takeWiredPlant()->feed()->connected(QPlcSignalIndexTable::current());
}

void QPlcControlCenter::errorWithMaster(QPlcAbstractSocket::Error error, const QString &text)
{
    const QString name = QString::fromLatin1(QMetaEnum::fromType<QPlcAbstractSocket::Error>().valueToKey(error));
    const QString sentence = text.isEmpty() ? tr("The connection to the master failed: %1.").arg(name) : text;
    Plant *plant = d->wiredPlant();
    if (plant)
        plant->feed()->failed(sentence);
    if (plant && plant->isConnected()) {
        d->hint->showText(sentence);
        return;
    }
    d->connectStrip->open();
    d->connectStrip->showError(sentence);
}

void QPlcControlCenter::disconnectedFromMaster()
{
    if (Plant *plant = d->wiredPlant())
        plant->feed()->disconnected();
}

void QPlcControlCenter::initialize(const QPlcSignalList &signalValues)
{
    if (Plant *plant = d->wiredPlant())
        plant->feed()->initialize(signalValues);
}

void QPlcControlCenter::started()
{
    if (Plant *plant = d->wiredPlant())
        plant->feed()->started();
}

void QPlcControlCenter::stopped()
{
    if (Plant *plant = d->wiredPlant())
        plant->feed()->stopped();
}
