// SPDX-License-Identifier: Apache-2.0
#include "QPlcWidget.h"

#include "QPlcWidgetFactory.h"

#include <algorithm>
#include <vector>

namespace {

std::vector<std::unique_ptr<QPlcWidgetFactory>> &factories()
{
    static std::vector<std::unique_ptr<QPlcWidgetFactory>> all;
    return all;
}

const QString plantKey = QStringLiteral("plant");

template<typename Matches>
QPlcWidgetFactory *findFactory(Matches matches)
{
    const auto found = std::find_if(factories().begin(), factories().end(),
                                    [&](const std::unique_ptr<QPlcWidgetFactory> &each) { return matches(*each); });
    return found != factories().end() ? found->get() : nullptr;
}

}  // namespace

struct QPlcWidget::Private
{
    QString title;
    QString defaultTitle;
    QString pinnedPlant;
    QJsonObject settings;
    QPlcSignalIndexList inputs;
    QPlcSignalIndexList outputs;
    QPlcSignalList initialOutputs;
    qplc::WindowContext *context = nullptr;
};

QPlcWidget::QPlcWidget(QWidget *parent)
    : QWidget(parent)
    , d(std::make_unique<Private>())
{
}

QPlcWidget::~QPlcWidget() = default;

QPlcWidgetFactory *QPlcWidget::registerFactory(QPlcWidgetFactory *factory)
{
    const bool isKnown = findFactory([factory](const QPlcWidgetFactory &other) { return &other == factory; });
    if (!isKnown)
        factories().emplace_back(factory);
    return factory;
}

QPlcWidgetFactory *QPlcWidget::factory(int type)
{
    return findFactory([type](const QPlcWidgetFactory &each) { return each.type() == type; });
}

QPlcWidgetFactory *QPlcWidget::factory(const QString &name)
{
    return findFactory([&name](const QPlcWidgetFactory &each) { return each.name() == name; });
}

QString QPlcWidget::title() const
{
    if (!d->title.isEmpty())
        return d->title;
    return defaultTitle();
}

QString QPlcWidget::defaultTitle() const
{
    if (!d->defaultTitle.isEmpty())
        return d->defaultTitle;
    const QPlcWidgetFactory *maker = factory();
    return maker ? maker->name() : QString();
}

void QPlcWidget::setDefaultTitle(const QString &title)
{
    if (title == d->defaultTitle)
        return;
    d->defaultTitle = title;
    if (d->title.isEmpty())
        Q_EMIT titleChanged();
}

void QPlcWidget::setTitle(const QString &title)
{
    if (title == d->title)
        return;
    d->title = title;
    Q_EMIT titleChanged();
}

QString QPlcWidget::pinnedPlant() const
{
    return d->pinnedPlant;
}

void QPlcWidget::setPinnedPlant(const QString &plant)
{
    if (plant == d->pinnedPlant)
        return;
    d->pinnedPlant = plant;
    Q_EMIT pinnedPlantChanged();
}

QJsonObject QPlcWidget::settings() const
{
    QJsonObject all = d->settings;
    if (!d->pinnedPlant.isEmpty())
        all.insert(plantKey, d->pinnedPlant);
    if (!d->title.isEmpty())
        all.insert(QStringLiteral("title"), d->title);
    return all;
}

void QPlcWidget::applySettings(const QJsonObject &settings)
{
    setPinnedPlant(settings.value(plantKey).toString());
    for (auto entry = settings.begin(); entry != settings.end(); ++entry) {
        if (entry.key() == QLatin1String("title"))
            setTitle(entry.value().toString());
        else if (entry.key() != plantKey)
            d->settings.insert(entry.key(), entry.value());
    }
}

bool QPlcWidget::addSignals(const QStringList & /*references*/)
{
    return false;
}

qplc::WindowContext *QPlcWidget::context() const
{
    return d->context;
}

void QPlcWidget::setContext(qplc::WindowContext *context)
{
    d->context = context;
    contextChanged();
}

QPlcSignalIndexList QPlcWidget::inputSignalIndices() const
{
    return d->inputs;
}

QPlcSignalIndexList QPlcWidget::outputSignalIndices() const
{
    return d->outputs;
}

QPlcSignalList QPlcWidget::initialOutputSignals() const
{
    return d->initialOutputs;
}

void QPlcWidget::realTimeout(const QList<QPlcSignalList> & /*signalValues*/) {}

void QPlcWidget::setInputSignalIndices(const QPlcSignalIndexList &indices)
{
    d->inputs = indices;
    Q_EMIT inputSignalIndicesChanged();
}

void QPlcWidget::setOutputSignalIndices(const QPlcSignalIndexList &indices)
{
    d->outputs = indices;
    Q_EMIT outputSignalIndicesChanged();
}

void QPlcWidget::setInitialOutputSignals(const QPlcSignalList &signalValues)
{
    d->initialOutputs = signalValues;
    Q_EMIT initialOutputSignalsChanged();
}
